#include "harness/plugs/systems.h"

#include "harness/io/input_error.h"
#include "harness/plugs/place_vocabulary.h"
#include "harness/plugs/stereo_slam_estimator.h"

namespace aisle {
namespace {

template <Rejection kRejection>
std::unique_ptr<Estimator> OurSlamWith(const StereoCalibration& calibration,
                                       const SystemOptions& options) {
  return MakeStereoSlamEstimator(calibration, {.threads = options.threads,
                                               .rejection = kRejection,
                                               .vocabulary_file = VocabularyFile(),
                                               .load_map = options.load_map,
                                               .localise_only = options.localise_only,
                                               .free_running = options.free_running,
                                               .draw_stages = options.draw_stages});
}

}  // namespace

const std::vector<System>& Systems() {
  static const std::vector<System> systems = {
      {"orbslam2", "our stereo SLAM, nothing rejected: the ORB-SLAM2 row", MaskSource::kNone,
       OurSlamWith<Rejection::kNone>},
      {"semantic", "no features on any person or vehicle, moving or not: the DynaSLAM row",
       MaskSource::kActors, OurSlamWith<Rejection::kNone>},
      {"paper", "our SLAM with the paper's rejection of dynamic regions, as written",
       MaskSource::kNone, OurSlamWith<Rejection::kPaper>},
      {"robust", "our SLAM with our best rejection of dynamic regions", MaskSource::kNone,
       OurSlamWith<Rejection::kRobust>},
      {"oracle", "no features on what truth says moves now: the best any rejection could do",
       MaskSource::kDynamic, OurSlamWith<Rejection::kNone>},
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
