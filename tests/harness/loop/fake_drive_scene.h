#pragma once

#include "harness/loop/drive_scene.h"
#include "harness/loop/localiser.h"

namespace aisle {

/// A floor without pictures: a straight aisle along x, racks on both sides, whoever is put there.
class FakeDriveScene : public DriveScene {
 public:
  explicit FakeDriveScene(double length_m = 8, double speed_mps = 0.8) {
    WayLeg leg{.kind = WayLeg::Kind::kDrive, .duration_s = length_m / speed_mps + 2};
    for (int k = 0; k <= static_cast<int>(length_m / 0.02 + 0.5); ++k) {
      leg.points.push_back(
          {.distance_m = 0.02 * k, .position = {0.02 * k, 0}, .speed_mps = speed_mps});
    }
    course_.way = {{.kind = WayLeg::Kind::kPause, .duration_s = 0.5}, leg};
    course_.planned_s = leg.duration_s + 0.5;
    course_.footprint = {{-0.3, -0.3}, {0.7, -0.3}, {0.7, 0.3}, {-0.3, 0.3}};
    course_.T_vehicle_rig.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    course_.T_vehicle_rig.translation() << 0.35, 0, 0.85;
  }

  /// Somebody who goes along a line from time 0 on, an actor of radius 0.25 m.
  void Add(const CourseActor& actor, const Eigen::Vector2d& from, const Eigen::Vector2d& velocity) {
    course_.actors.push_back(actor);
    from_.push_back(from);
    velocity_.push_back(velocity);
  }
  Course& edit() { return course_; }

  const Course& course() const override { return course_; }
  StereoCalibration calibration() const override { return {8, 8, 10, 10, 4, 4, 0.1}; }
  double rate_hz() const override { return 20; }
  std::int64_t Stamp(std::int64_t frame) const override { return frame * 50'000'000; }
  Capsule ActorAt(std::size_t actor, std::int64_t time_ns) const override {
    const Eigen::Vector2d at =
        from_[actor] + 1e-9 * static_cast<double>(time_ns) * velocity_[actor];
    return {at, at, 0.25};
  }
  Eigen::Isometry3d RigAt(const FloorPose& vehicle, std::int64_t) const override {
    return InSpace(vehicle) * course_.T_vehicle_rig;
  }
  SequenceFrame Take(const Exposure& exposure) const override {
    SequenceFrame frame;
    frame.images = {exposure.id, exposure.stamp_ns, cv::Mat1b(8, 8), cv::Mat1b(8, 8)};
    frame.truth.emplace();
    frame.truth->T_world_rig = exposure.T_world_rig;
    return frame;
  }

 private:
  Course course_;
  std::vector<Eigen::Vector2d> from_, velocity_;
};

/// Says where the rig is in a world of its own, drifting as it is told.
class DriftingLocaliser : public Localiser {
 public:
  /// `sideways`: metres to the vehicle's left that it believes to have gone, per metre gone.
  explicit DriftingLocaliser(double sideways = 0) : sideways_(sideways) {
    T_own_world_.linear() =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    T_own_world_.translation() << 5, -3, 2;
  }

  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    seen.push_back(exposure.id);
    if (exposure.stamp_ns >= lost_from_ns && exposure.stamp_ns < lost_to_ns) return std::nullopt;
    Eigen::Isometry3d T = exposure.T_world_rig;
    T.translation().y() += sideways_ * T.translation().x();
    return T_own_world_ * T;
  }
  std::int64_t lost_from_ns = 0, lost_to_ns = 0;
  std::vector<std::int64_t> seen;

 private:
  const double sideways_;
  Eigen::Isometry3d T_own_world_ = Eigen::Isometry3d::Identity();
};

}  // namespace aisle
