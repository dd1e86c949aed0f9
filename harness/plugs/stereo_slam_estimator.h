#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/contract/estimator.h"
#include "harness/contract/system_option.h"

namespace aisle {

struct StereoSlamEstimatorOptions {
  int threads = 0;  ///< 0: as many as the machine has; never changes a result
  /// Options that differ from the SLAM's defaults, by path, as text; where `base` is among them,
  /// from what that base sets.
  std::map<std::string, std::string> options = {};
  std::filesystem::path vocabulary_file = {};  ///< empty: loops are not closed
  std::filesystem::path load_map = {};         ///< empty: a new map; else goes on in this one
  bool localise_only = false;                  ///< load_map stays as it is
  bool free_running = false;  ///< not repeatable: background results are taken when ready
  bool draw_stages = false;   ///< estimates can draw how the movers were found; changes no result
};

/// Every option of our SLAM that its base looks at; its value where `options` are set, by path.
/// Throws InputError for one that cannot be.
std::vector<SystemOption> DescribeSlamOptions(const std::map<std::string, std::string>& options);

/// What is wrong with one option and its value, or an empty string.
std::string CheckSlamOption(const std::string& path, const std::string& value);

/// What is wrong with options together, each of which is good alone, or an empty string: a broken
/// rule, or one that their base does not look at.
std::string CheckSlamOptions(const std::map<std::string, std::string>& options);

/// Our SLAM behind the Estimator socket. Throws InputError for options that are none.
std::unique_ptr<Estimator> MakeStereoSlamEstimator(const StereoCalibration& calibration,
                                                   const StereoSlamEstimatorOptions& options);

}  // namespace aisle
