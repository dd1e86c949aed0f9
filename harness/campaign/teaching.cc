#include "harness/campaign/teaching.h"

#include <map>

#include "harness/contract/system_fault.h"
#include "harness/loop/localiser.h"
#include "harness/vehicle/taught_way.h"

namespace aisle {
namespace {

/// Below this share of frames with a pose nothing has been taught.
constexpr double kLeastShare = 0.5;
/// Pictures' noise hangs on the frame's number: these are of no drive.
constexpr std::int64_t kFirstTaughtFrame = 1'000'000;

/// Shows the system what the led vehicle's camera sees; asks it nothing.
class Looking : public Localiser {
 public:
  Looking(const DriveScene& scene, Estimator& estimator, const MaskMaker& masks)
      : scene_(scene), estimator_(estimator), masks_(masks) {}

  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    Exposure taught = exposure;
    taught.id += kFirstTaughtFrame;
    const SequenceFrame frame = scene_.Take(taught);
    estimator_.Process(frame.images, masks_(frame));
    T_site_rig_[exposure.stamp_ns] = exposure.T_world_rig;
    return std::nullopt;
  }

  const std::map<std::int64_t, Eigen::Isometry3d>& T_site_rig() const { return T_site_rig_; }

 private:
  const DriveScene& scene_;
  Estimator& estimator_;
  const MaskMaker& masks_;
  std::map<std::int64_t, Eigen::Isometry3d> T_site_rig_;  ///< by stamp
};

}  // namespace

TaughtCourse Teach(const DriveScene& scene, Estimator& estimator, const MaskMaker& masks,
                   std::uint64_t seed, const std::filesystem::path& map_file) {
  Looking looking(scene, estimator, masks);
  const LoopOptions led{.steering = {.steered_by_truth = true}, .seed = seed};
  const DriveTrack track = DriveClosed(scene, &looking, led);
  const Trajectory said = estimator.Finish();
  const std::size_t shown = looking.T_site_rig().size();
  if (track.end != DriveEnd::kArrived ||
      static_cast<double>(said.size()) < kLeastShare * static_cast<double>(shown) || said.empty()) {
    throw SystemFault(RunStatus::kLost,
                      fmt::format("its way could not be taught: led along it the system had a pose "
                                  "for {} of {} frames",
                                  said.size(), shown));
  }
  // Where the teaching began the map is the site's.
  const Course& course = scene.course();
  const auto T_site_rig = [&](const StampedPose& pose) {
    return looking.T_site_rig().at(pose.stamp_ns);
  };
  TaughtCourse taught;
  taught.T_site_slam = T_site_rig(said.front()) * said.front().T_world_rig.inverse();
  const Eigen::Isometry3d T_rig_vehicle = course.T_vehicle_rig.inverse();
  std::vector<TaughtPose> poses;
  for (const StampedPose& pose : said) {
    poses.push_back({FromAbove(T_site_rig(pose) * T_rig_vehicle),
                     FromAbove(taught.T_site_slam * pose.T_world_rig * T_rig_vehicle)});
  }
  taught.way = TaughtWay(course.way, poses);
  try {
    estimator.SaveMap(map_file);
  } catch (const std::runtime_error& error) {
    throw SystemFault(RunStatus::kCrashed, error.what());
  }
  return taught;
}

}  // namespace aisle
