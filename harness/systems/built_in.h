#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/contract/estimator.h"

namespace aisle {

/// A system under test that runs inside this program: our SLAM with these options.
struct System {
  std::string name;         ///< as suites and reports call it
  std::string description;  ///< one sentence
  MaskSource mask_source = MaskSource::kNone;
  std::map<std::string, std::string> options = {};  ///< where it departs from the SLAM's defaults
};

/// Every system, in the order in which reports list them. A new one is a line of this table: all
/// else that is known of a system by its name follows from it (traits.h).
const std::vector<System>& Systems();

/// Throws InputError naming the known systems.
const System& FindSystem(const std::string& name);

/// The system with a variant's options over its own.
System Varied(System system, const std::map<std::string, std::string>& options);

}  // namespace aisle
