#pragma once

#include <memory>
#include <utility>

#include "harness/loop/drive_scene.h"

namespace aisle {

/// Another world, which it owns: what a decorator does not change.
class ForwardingDriveScene : public DriveScene {
 public:
  explicit ForwardingDriveScene(std::unique_ptr<DriveScene> to) : to_(std::move(to)) {}

  const Course& course() const override { return to_->course(); }
  StereoCalibration calibration() const override { return to_->calibration(); }
  double rate_hz() const override { return to_->rate_hz(); }
  std::int64_t Stamp(std::int64_t frame) const override { return to_->Stamp(frame); }
  Capsule ActorAt(std::size_t actor, std::int64_t time_ns) const override {
    return to_->ActorAt(actor, time_ns);
  }
  Eigen::Isometry3d RigAt(const FloorPose& vehicle, std::int64_t stamp_ns) const override {
    return to_->RigAt(vehicle, stamp_ns);
  }
  SequenceFrame Take(const Exposure& exposure) const override { return to_->Take(exposure); }

 private:
  const std::unique_ptr<DriveScene> to_;
};

}  // namespace aisle
