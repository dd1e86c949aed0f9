#include "harness/plugs/cached_drive.h"

#include "harness/loop/forwarding_drive_scene.h"
#include "harness/plugs/cached_frame.h"

namespace aisle {
namespace {

class DriveWithKeptFrames : public ForwardingDriveScene {
 public:
  DriveWithKeptFrames(std::unique_ptr<DriveScene> scene, FrameStore store)
      : ForwardingDriveScene(std::move(scene)), store_(std::move(store)) {}

  SequenceFrame Take(const Exposure& exposure) const override {
    if (std::optional<SequenceFrame> kept = store_.Read(exposure.id)) {
      const bool is_it = kept->images.stamp_ns == exposure.stamp_ns && kept->truth &&
                         kept->truth->T_world_rig.matrix() == exposure.T_world_rig.matrix();
      if (is_it) return *std::move(kept);
    }
    return MakeAndKeep(store_, [&] { return ForwardingDriveScene::Take(exposure); });
  }

 private:
  const FrameStore store_;
};

}  // namespace

std::unique_ptr<DriveScene> WithKeptFrames(std::unique_ptr<DriveScene> scene, FrameStore store) {
  return std::make_unique<DriveWithKeptFrames>(std::move(scene), std::move(store));
}

}  // namespace aisle
