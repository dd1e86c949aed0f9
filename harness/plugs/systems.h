#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/contract/estimator.h"

namespace aisle {

struct SystemOptions {
  int threads = 0;                      ///< 0: as many as the machine has; never changes a result
  std::filesystem::path load_map = {};  ///< of an earlier drive with the same rig; empty: none
  bool localise_only = false;           ///< the loaded map stays as it is
  bool draw_stages = false;   ///< estimates can draw how the movers were found; changes no result
  bool free_running = false;  ///< NOT REPEATABLE: background work as threads happen to run
};

/// A system under test that runs inside this program.
struct System {
  std::string name;         ///< as suites and reports call it
  std::string description;  ///< one sentence
  MaskSource mask_source = MaskSource::kNone;
  std::function<std::unique_ptr<Estimator>(const StereoCalibration&, const SystemOptions&)> make;
};

/// Every system, in the order in which reports list them.
const std::vector<System>& Systems();

/// Throws InputError naming the known systems.
const System& FindSystem(const std::string& name);

}  // namespace aisle
