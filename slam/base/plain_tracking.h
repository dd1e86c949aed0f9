#pragma once

#include "slam/base/tracking_policy.h"

namespace aisle::slam {

/// Our own tracker: a pose that explains little of what should be seen gives way to one that
/// explains enough, a lost rig is looked for where its steady motion leads, and no keyframe is made
/// at rest or while another is worked in.
class PlainTracking final : public TrackingPolicy {
 public:
  PlainTracking(const StereoCamera& camera, const SlamOptions& options)
      : camera_(camera), options_(options) {}

  std::optional<FramePose> Find(const std::shared_ptr<const Frame>& frame,
                                const DriveState& drive) override;
  KeyframeVerdict NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                                const MapperState& mapper) const override;
  MapEdit MakeKeyframe(const Map& map, const std::shared_ptr<const Frame>& frame,
                       const FramePose& pose) const override;
  std::optional<NewPart> Begin(const std::shared_ptr<const Frame>& frame,
                               const DriveState& drive) const override;
  std::optional<MapEdit> Extend(const std::shared_ptr<const Frame>& frame,
                                const DriveState& drive) const override;
  bool BeginsParts() const override { return true; }
  bool GivesUp(const Map&) const override { return false; }
  void Note(const std::shared_ptr<const Frame>&, const FramePose*, std::optional<KeyframeId>,
            const DriveState&) override {}
  void CarryOver(const Map&, const Map&) override {}

 private:
  const StereoCamera camera_;
  const SlamOptions options_;
};

}  // namespace aisle::slam
