#include "harness/plugs/wheel_odometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/io/input_error.h"
#include "slam/stereo_slam.h"

namespace aisle {
namespace {

/// T_body_rig axes: the body's x ahead, y left, z up; the rig's z ahead, x right, y down.
FloorPose BodyBeneath(const Eigen::Isometry3d& T_world_rig) {
  const Eigen::Vector3d ahead = T_world_rig.linear().col(2);
  return {T_world_rig.translation().head<2>(), std::atan2(ahead.y(), ahead.x())};
}

/// Deviations of one step, in the body's frame: translation, then rotation.
slam::Matrix6d BodyCovariance(double way_m, double turn_rad, const OdometryOptions& options,
                              const PlantOptions& plant) {
  // Of what wheels do not see: the body heaves, nods and slips aside on an uneven floor.
  constexpr double kUneven_m = 0.002, kUneven_rad = 0.002, kAside_m = 0.0005;
  constexpr double kFresh_m = 5, kFresh_rad = 3;  // a calibration's error as if drawn anew
  const double count_m = 2 * std::numbers::pi * options.wheel_radius_m / options.counts_per_rev;
  const double way = std::abs(way_m), turn = std::abs(turn_rad);
  const auto squared = [](double x) { return x * x; };
  const double of_wheel = options.noise_m * way + squared(count_m) / 6;
  const double ahead = squared(options.radius_error) * kFresh_m * way + of_wheel;
  const double heading = squared(options.track_error) * kFresh_rad * turn +
                         squared(options.inequality / plant.track_m) * kFresh_m * way +
                         2 * of_wheel / squared(plant.track_m);
  slam::Vector6d variances;
  variances << ahead, squared(kAside_m), squared(kUneven_m), squared(kUneven_rad),
      squared(kUneven_rad), heading;
  return variances.asDiagonal();
}

/// A motion of the body as one of the rig. `way_m` and `turn_rad` are all that the body rolled and
/// turned in it.
MotionMeasurement MotionOfRig(const FloorPose& moved, double way_m, double turn_rad,
                              const Eigen::Isometry3d& T_body_rig, const OdometryOptions& options,
                              const PlantOptions& plant) {
  MotionMeasurement motion;
  motion.T_now_before = T_body_rig.inverse() * InSpace(moved).inverse() * T_body_rig;
  const slam::Matrix6d to_rig = slam::Adjoint(T_body_rig.inverse());
  motion.covariance = to_rig * BodyCovariance(way_m, turn_rad, options, plant) * to_rig.transpose();
  motion.covariance = (motion.covariance + motion.covariance.transpose()).eval() / 2;
  return motion;
}

/// Hands the frames of another sequence on, with what the wheels measured.
class SequenceWithOdometry : public Sequence {
 public:
  SequenceWithOdometry(std::unique_ptr<Sequence> sequence, std::vector<MotionMeasurement> measured)
      : sequence_(std::move(sequence)), measured_(std::move(measured)) {}

  std::string name() const override { return sequence_->name(); }
  StereoCalibration calibration() const override { return sequence_->calibration(); }
  double rate_hz() const override { return sequence_->rate_hz(); }
  std::vector<FrameRequest> Schedule() const override { return sequence_->Schedule(); }
  SequenceFrame At(const FrameRequest& request) const override {
    SequenceFrame frame = sequence_->At(request);
    const auto step = static_cast<std::size_t>(request.id - 1);
    if (request.id > 0 && step < measured_.size()) frame.images.motion = measured_[step];
    return frame;
  }

 private:
  std::unique_ptr<Sequence> sequence_;
  std::vector<MotionMeasurement> measured_;
};

/// Hands the pictures of another drive on, with what the wheels measured.
class DriveWithOdometry : public DriveScene {
 public:
  explicit DriveWithOdometry(std::unique_ptr<DriveScene> scene) : scene_(std::move(scene)) {}

  const Course& course() const override { return scene_->course(); }
  StereoCalibration calibration() const override { return scene_->calibration(); }
  double rate_hz() const override { return scene_->rate_hz(); }
  std::int64_t Stamp(std::int64_t frame) const override { return scene_->Stamp(frame); }
  Capsule ActorAt(std::size_t actor, std::int64_t time_ns) const override {
    return scene_->ActorAt(actor, time_ns);
  }
  Eigen::Isometry3d RigAt(const FloorPose& vehicle, std::int64_t stamp_ns) const override {
    return scene_->RigAt(vehicle, stamp_ns);
  }
  SequenceFrame Take(const Exposure& exposure) const override {
    SequenceFrame frame = scene_->Take(exposure);
    if (!exposure.wheels_before) return frame;
    const Reckoning &before = *exposure.wheels_before, &now = exposure.wheels;
    const Course& course = scene_->course();
    frame.images.motion = MotionOfRig(before.pose.inverse() * now.pose, now.way_m - before.way_m,
                                      now.turn_rad - before.turn_rad, course.T_vehicle_rig,
                                      course.odometry, course.plant);
    return frame;
  }

 private:
  std::unique_ptr<DriveScene> scene_;
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
          "The system is handed what the vehicle's wheels measure from frame to frame.",
          0,
          0,
          {}};
}

std::string CheckOdometry(const std::string& value) {
  if (value == "true" || value == "false") return {};
  return fmt::format("option {} = {}: expected true or false", kOdometryOption, Printable(value));
}

std::vector<MotionMeasurement> MeasureByWheels(const std::vector<FrameRequest>& schedule,
                                               const OdometryOptions& options, std::uint64_t seed) {
  std::vector<MotionMeasurement> measured;
  if (schedule.empty()) return measured;
  const PlantOptions plant;
  Odometer odometer(options, plant, seed);
  const Eigen::Isometry3d T_body_rig =
      InSpace(BodyBeneath(schedule.front().T_world_rig)).inverse() * schedule.front().T_world_rig;
  double speed_mps = 0;
  for (std::size_t i = 1; i < schedule.size(); ++i) {
    const FloorPose moved =
        BodyBeneath(schedule[i - 1].T_world_rig).inverse() * BodyBeneath(schedule[i].T_world_rig);
    const double seconds =
        static_cast<double>(schedule[i].stamp_ns - schedule[i - 1].stamp_ns) * 1e-9;
    PlantStep step;
    step.way_m = moved.position.x();
    step.turn_rad = WrapAngle(moved.heading_rad);
    step.state.acceleration_mps2 = (step.way_m / seconds - speed_mps) / seconds;
    speed_mps = step.way_m / seconds;
    if (i == 1) step.state.acceleration_mps2 = 0;  // the drive begins in motion
    // The rig stands off the axle: what the wheels err is what their arc errs.
    const FloorPose arc = AlongArc({}, step.way_m, step.turn_rad);
    const FloorPose said = moved * arc.inverse() * odometer.Measure(step);
    measured.push_back(MotionOfRig(said, step.way_m, step.turn_rad, T_body_rig, options, plant));
  }
  return measured;
}

std::vector<MotionMeasurement> MeasureByWheels(const Sequence& sequence, std::uint64_t seed) {
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  const bool stands = std::ranges::all_of(schedule, [](const FrameRequest& frame) {
    return frame.T_world_rig.matrix() == Eigen::Matrix4d::Identity();
  });
  if (stands && !schedule.empty()) {
    throw InputError(sequence.name() +
                     ": a system is to be handed odometry, but nobody knows the way here: take a "
                     "scene, or a recording with truth");
  }
  return MeasureByWheels(schedule, {}, seed);
}

std::unique_ptr<Sequence> WithOdometry(std::unique_ptr<Sequence> sequence, std::uint64_t seed) {
  std::vector<MotionMeasurement> measured = MeasureByWheels(*sequence, seed);
  return std::make_unique<SequenceWithOdometry>(std::move(sequence), std::move(measured));
}

std::unique_ptr<DriveScene> WithOdometry(std::unique_ptr<DriveScene> scene) {
  return std::make_unique<DriveWithOdometry>(std::move(scene));
}

}  // namespace aisle
