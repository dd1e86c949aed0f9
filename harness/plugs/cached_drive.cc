#include "harness/plugs/cached_drive.h"

#include "harness/plugs/cached_frame.h"

namespace aisle {
namespace {

class DriveWithKeptFrames : public DriveScene {
 public:
  DriveWithKeptFrames(std::unique_ptr<DriveScene> scene, FrameStore store)
      : scene_(std::move(scene)), store_(std::move(store)) {}

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
    if (std::optional<SequenceFrame> kept = store_.Read(exposure.id)) {
      const bool is_it = kept->images.stamp_ns == exposure.stamp_ns && kept->truth &&
                         kept->truth->T_world_rig.matrix() == exposure.T_world_rig.matrix();
      if (is_it) return *std::move(kept);
    }
    return MakeAndKeep(store_, [&] { return scene_->Take(exposure); });
  }

 private:
  const std::unique_ptr<DriveScene> scene_;
  const FrameStore store_;
};

}  // namespace

std::unique_ptr<DriveScene> WithKeptFrames(std::unique_ptr<DriveScene> scene, FrameStore store) {
  return std::make_unique<DriveWithKeptFrames>(std::move(scene), std::move(store));
}

}  // namespace aisle
