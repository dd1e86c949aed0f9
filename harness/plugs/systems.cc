#include "harness/plugs/systems.h"

#include "harness/io/input_error.h"
#include "harness/loop/closed_drive.h"
#include "harness/plugs/place_vocabulary.h"
#include "harness/plugs/steering_options.h"
#include "harness/plugs/stereo_slam_estimator.h"
#include "harness/plugs/wheel_odometry.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

/// The options that are the SLAM's own.
std::map<std::string, std::string> OptionsOfSlam(std::map<std::string, std::string> options) {
  options.erase(kOdometryOption);
  return WithoutSteering(options);
}

}  // namespace

std::vector<SystemOption> OptionsOf(const System& system) {
  std::vector<SystemOption> options = DescribeSlamOptions(system.options);
  for (SystemOption& option : DescribeSteering({})) options.push_back(std::move(option));
  if (TraitsOf(system).base == "plain") options.push_back(DescribeOdometry());
  return options;
}

std::string CheckOption(const std::string& path, const std::string& value) {
  if (IsSteeringOption(path)) return CheckSteeringOption(path, value);
  if (path == kOdometryOption) return CheckOdometry(value);
  return CheckSlamOption(path, value);
}

std::string CheckOptions(const System& like, const std::map<std::string, std::string>& options) {
  const System variant = Varied(like, options);
  if (options.contains(kOdometryOption) && TraitsOf(variant).base == "orbslam2") {
    return fmt::format("option {}: the published ORB-SLAM2 only uses images: {}", kOdometryOption,
                       "choose a system like plain or robust, or set base to plain");
  }
  if (const std::string wrong = Validate(SteeringOf(options)); !wrong.empty()) return wrong;
  return CheckSlamOptions(OptionsOfSlam(variant.options));
}

std::pair<std::string, std::string> OptionFromText(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw InputError(fmt::format("'{}': expected PATH=VALUE, for example feature.features=800",
                                 Printable(assignment)));
  }
  const std::string path = assignment.substr(0, equals), value = assignment.substr(equals + 1);
  if (const std::string wrong = CheckOption(path, value); !wrong.empty()) throw InputError(wrong);
  return {path, value};
}

std::map<std::string, std::string> OptionsFromText(const std::vector<std::string>& assignments,
                                                   const System& like) {
  std::map<std::string, std::string> options;
  for (const std::string& text : assignments) {
    const auto [path, value] = OptionFromText(text);
    options[path] = value;
  }
  if (const std::string wrong = CheckOptions(like, options); !wrong.empty()) {
    throw InputError(wrong);
  }
  return options;
}

std::map<std::string, std::string> OptionsOfSpec(const SystemSpec& spec) {
  if (spec.external) {
    throw InputError("system '" + spec.name +
                     "' is a command: it does not run inside this program");
  }
  return OptionsOfSlam(Varied(FindSystem(spec.like), spec.options).options);
}

std::unique_ptr<Estimator> MakeSystem(const SystemSpec& spec, const StereoCalibration& calibration,
                                      const SystemSetup& setup) {
  return MakeStereoSlamEstimator(calibration, {.threads = setup.threads,
                                               .options = OptionsOfSpec(spec),
                                               .vocabulary_file = VocabularyFile(),
                                               .load_map = setup.load_map,
                                               .localise_only = setup.localise_only,
                                               .free_running = setup.free_running,
                                               .draw_stages = setup.draw_stages});
}

}  // namespace aisle
