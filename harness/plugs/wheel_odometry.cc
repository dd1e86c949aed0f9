#include "harness/plugs/wheel_odometry.h"

#include <algorithm>
#include <cmath>

#include "harness/common/seconds.h"
#include "harness/contract/forwarding_sequence.h"
#include "harness/io/input_error.h"
#include "harness/loop/forwarding_drive_scene.h"
#include "harness/plugs/wheel_motion.h"

namespace aisle {
namespace {

/// T_body_rig axes: the body's x ahead, y left, z up; the rig's z ahead, x right, y down.
FloorPose BodyBeneath(const Eigen::Isometry3d& T_world_rig) {
  const Eigen::Vector3d ahead = T_world_rig.linear().col(2);
  return {T_world_rig.translation().head<2>(), std::atan2(ahead.y(), ahead.x())};
}

/// What wheels measured of a body that rolled `way_m` and turned `turn_rad` in all.
MotionMeasurement Rolled(const FloorPose& moved, double way_m, double turn_rad,
                         const Eigen::Isometry3d& T_body_rig, const OdometryOptions& options,
                         const PlantOptions& plant) {
  return OfRig({InSpace(moved).inverse(), RollingCovariance(way_m, turn_rad, options, plant)},
               T_body_rig);
}

/// A step of a vehicle whose axle goes along an arc, as its wheels go it.
PlantStep StepAlong(double way_m, double turn_rad, const PlantOptions& plant) {
  PlantStep step;
  step.way_m = way_m;
  step.turn_rad = turn_rad;
  // The wheel ahead of the axle goes across by what the turn carries it, and steers accordingly.
  const double across_m = turn_rad * plant.wheelbase_m;
  const double ahead = way_m < 0 ? -1 : 1;
  step.wheel_way_m = ahead * std::hypot(way_m, across_m);
  step.steering_rad = std::atan2(ahead * across_m, ahead * way_m);
  return step;
}

/// Hands the frames of another sequence on, with what the wheels measured.
class SequenceWithOdometry : public ForwardingSequence {
 public:
  SequenceWithOdometry(std::unique_ptr<Sequence> sequence, WheelMotions measured)
      : ForwardingSequence(*sequence),
        sequence_(std::move(sequence)),
        measured_(std::move(measured)) {}

  SequenceFrame At(const FrameRequest& request) const override {
    SequenceFrame frame = ForwardingSequence::At(request);
    const auto step = static_cast<std::size_t>(request.id - 1);
    if (request.id > 0 && step < measured_.size()) frame.images.motion = measured_[step];
    return frame;
  }

 private:
  std::unique_ptr<Sequence> sequence_;
  WheelMotions measured_;
};

/// Hands the pictures of another drive on, with what the wheels measured.
class DriveWithOdometry : public ForwardingDriveScene {
 public:
  using ForwardingDriveScene::ForwardingDriveScene;

  SequenceFrame Take(const Exposure& exposure) const override {
    SequenceFrame frame = ForwardingDriveScene::Take(exposure);
    if (!exposure.wheels_before) return frame;
    const Reckoning &before = *exposure.wheels_before, &now = exposure.wheels;
    const Course& course = this->course();
    frame.images.motion =
        Rolled(before.pose.inverse() * now.pose, now.way_m - before.way_m,
               now.turn_rad - before.turn_rad, course.T_vehicle_rig, course.odometry, course.plant);
    return frame;
  }
};

}  // namespace

bool WantsOdometry(const SystemSpec& system) {
  const auto said = system.options.find(kOdometryOption);
  return said != system.options.end() && said->second == "true";
}

SystemOption DescribeOdometry() {
  return {kOdometryOption,
          SystemOption::Kind::kFlag,
          "false",
          "",
          "The system receives what the vehicle's wheels measure from frame to frame.",
          0,
          0,
          {}};
}

std::string CheckOdometry(const std::string& value) {
  if (value == "true" || value == "false") return {};
  return fmt::format("option {} = {}: expected true or false", kOdometryOption, Printable(value));
}

WheelMotions MeasureByWheels(const std::vector<FrameRequest>& schedule, const Wheels& wheels,
                             std::uint64_t seed) {
  WheelMotions measured;
  const auto first = std::ranges::find_if(schedule, &FrameRequest::pose_known);
  if (first == schedule.end()) return WheelMotions(schedule.empty() ? 0 : schedule.size() - 1);
  Odometer odometer(wheels.odometry, wheels.plant, seed);
  const Eigen::Isometry3d T_body_rig =
      InSpace(BodyBeneath(first->T_world_rig)).inverse() * first->T_world_rig;
  double speed_mps = 0;
  bool knows_speed = false;  // not at first: the drive begins in motion
  for (std::size_t i = 1; i < schedule.size(); ++i) {
    if (!schedule[i - 1].pose_known || !schedule[i].pose_known) {
      measured.push_back(std::nullopt);
      knows_speed = false;
      continue;
    }
    const FloorPose moved =
        BodyBeneath(schedule[i - 1].T_world_rig).inverse() * BodyBeneath(schedule[i].T_world_rig);
    const double seconds = ToSeconds(schedule[i].stamp_ns - schedule[i - 1].stamp_ns);
    PlantStep step = StepAlong(moved.position.x(), WrapAngle(moved.heading_rad), wheels.plant);
    const double now_mps = step.way_m / seconds;
    step.state.acceleration_mps2 = knows_speed ? (now_mps - speed_mps) / seconds : 0;
    speed_mps = now_mps;
    knows_speed = true;
    // The rig stands off the axle: what the wheels err is what their arc errs.
    const FloorPose arc = AlongArc({}, step.way_m, step.turn_rad);
    const FloorPose said = moved * arc.inverse() * odometer.Measure(step);
    measured.push_back(
        Rolled(said, step.way_m, step.turn_rad, T_body_rig, wheels.odometry, wheels.plant));
  }
  return measured;
}

WheelMotions MeasureByWheels(const Sequence& sequence, std::uint64_t seed, const Wheels& wheels) {
  if (std::optional<WheelMotions> recorded = sequence.ReadWheels()) return *std::move(recorded);
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  const auto first = std::ranges::find_if(schedule, &FrameRequest::pose_known);
  if (first == schedule.end()) {
    throw InputError(
        sequence.name() +
        ": a system asks for odometry, but the source has none: use a scene, a recording with "
        "truth, or one with recorded wheel odometry (for a bag, name its topic: slam --odometry "
        "/odom, or the key odometry of the file that describes the recording)");
  }
  constexpr double kUpright = 0.5;  // of a camera tilted by 60 degrees
  if (-first->T_world_rig.linear()(2, 1) < kUpright) {
    throw InputError(sequence.name() +
                     ": a system asks for odometry, which needs a floor, but the z axis of the "
                     "truth does not point up: rotate its poses into a world whose z axis does");
  }
  return MeasureByWheels(schedule, wheels, seed);
}

std::unique_ptr<Sequence> WithOdometry(std::unique_ptr<Sequence> sequence, std::uint64_t seed,
                                       const Wheels& wheels) {
  WheelMotions measured = MeasureByWheels(*sequence, seed, wheels);
  return std::make_unique<SequenceWithOdometry>(std::move(sequence), std::move(measured));
}

std::unique_ptr<DriveScene> WithOdometry(std::unique_ptr<DriveScene> scene) {
  return std::make_unique<DriveWithOdometry>(std::move(scene));
}

}  // namespace aisle
