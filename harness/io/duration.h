#pragma once

#include <string>

namespace aisle {

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string Duration(double seconds);

}  // namespace aisle
