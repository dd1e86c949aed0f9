#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/contract/estimator.h"
#include "harness/contract/system_option.h"
#include "harness/contract/system_spec.h"
#include "harness/systems/built_in.h"

namespace aisle {

/// Every option of a built-in system that has an effect there, with its value.
std::vector<SystemOption> OptionsOf(const System& system);

/// What is wrong with one option and its value, or an empty string.
std::string CheckOption(const std::string& path, const std::string& value);

/// What is wrong with a variant's options together, each of which is good alone, or an empty
/// string. One that has no effect in the variant is wrong.
std::string CheckOptions(const System& like, const std::map<std::string, std::string>& options);

/// An option and its value from a word of a command line, "PATH=VALUE". Throws InputError where
/// there is no such option or it cannot have that value.
std::pair<std::string, std::string> OptionFromText(const std::string& assignment);

/// All options of a command line, which must be good together. Throws InputError.
std::map<std::string, std::string> OptionsFromText(const std::vector<std::string>& assignments,
                                                   const System& like);

/// Every option of a built-in system or of a variant of one that differs from the SLAM's defaults.
/// Throws InputError for a foreign one.
std::map<std::string, std::string> OptionsOfSpec(const SystemSpec& spec);

/// What a process decides, and no result depends on, or what a drive brings with it.
struct SystemSetup {
  int threads = 0;                      ///< 0: as many as the machine has; never changes a result
  std::filesystem::path load_map = {};  ///< of an earlier drive with the same rig; empty: none
  bool localise_only = false;           ///< the loaded map stays as it is
  bool draw_stages = false;   ///< estimates can draw how the movers were found; changes no result
  bool free_running = false;  ///< NOT REPEATABLE: background work as threads happen to run
};

/// A built-in system or a variant of one, ready for its first frame. Throws InputError for a
/// foreign one and for options that do not fit together.
std::unique_ptr<Estimator> MakeSystem(const SystemSpec& spec, const StereoCalibration& calibration,
                                      const SystemSetup& setup = {});

}  // namespace aisle
