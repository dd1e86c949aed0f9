#include "harness/plugs/systems.h"

#include "harness/io/input_error.h"
#include "harness/plugs/stereo_slam_estimator.h"

namespace aisle {
namespace {

std::unique_ptr<Estimator> OurSlam(const StereoCalibration& calibration, int threads) {
  return MakeStereoSlamEstimator(calibration, {.threads = threads});
}

template <Rejection kRejection>
std::unique_ptr<Estimator> OurSlamThatRejects(const StereoCalibration& calibration, int threads) {
  return MakeStereoSlamEstimator(calibration, {.threads = threads, .rejection = kRejection});
}

}  // namespace

const std::vector<System>& Systems() {
  static const std::vector<System> systems = {
      {"orbslam2", "our stereo SLAM, nothing rejected: the ORB-SLAM2 row", MaskSource::kNone,
       OurSlam},
      {"semantic", "no features on any person or vehicle, moving or not: the DynaSLAM row",
       MaskSource::kActors, OurSlam},
      {"paper", "our SLAM with the paper's rejection of dynamic regions, as written",
       MaskSource::kNone, OurSlamThatRejects<Rejection::kPaper>},
      {"robust", "our SLAM with our best rejection of dynamic regions", MaskSource::kNone,
       OurSlamThatRejects<Rejection::kRobust>},
      {"oracle", "no features on what truth says moves now: the best any rejection could do",
       MaskSource::kDynamic, OurSlam},
  };
  return systems;
}

const System& FindSystem(const std::string& name) {
  std::string known;
  for (const System& system : Systems()) {
    if (system.name == name) return system;
    known += (known.empty() ? "" : ", ") + system.name;
  }
  throw InputError("system '" + Printable(name) + "' is not known: expected one of " + known);
}

}  // namespace aisle
