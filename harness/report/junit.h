#pragma once

#include <string>

#include "harness/record/results.h"

namespace aisle {

/// JUnit for CI: one suite, a test case per verdict, numbers in the failure text. Control bytes
/// that XML cannot hold are dropped.
std::string ToJunit(const Results& results);

}  // namespace aisle
