#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/contract/estimator.h"

namespace aisle {

/// A system under test that runs inside this program.
struct System {
  std::string name;         ///< as suites and reports call it
  std::string description;  ///< one sentence
  MaskSource mask_source = MaskSource::kNone;
  std::function<std::unique_ptr<Estimator>(const StereoCalibration&, int threads)> make;
};

/// Every system, in the order in which reports list them.
const std::vector<System>& Systems();

/// Throws InputError naming the known systems.
const System& FindSystem(const std::string& name);

}  // namespace aisle
