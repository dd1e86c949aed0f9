#pragma once

#include "slam/base/tracking_policy.h"
#include "slam/track/orbslam2_track.h"

namespace aisle::slam {

/// The tracking of the published ORB-SLAM2, stereo: a pose is believed for its inliers alone, and
/// close points that are not in the map bring keyframes, wherever they are and whether or not the
/// rig moves.
class OrbSlam2Tracking final : public TrackingPolicy {
 public:
  OrbSlam2Tracking(const StereoCamera& camera, const SlamOptions& options)
      : camera_(camera), levels_(options.feature.levels), options_(options.orbslam2) {}

  std::optional<FramePose> Find(const std::shared_ptr<const Frame>& frame,
                                const DriveState& drive) override;
  KeyframeVerdict NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                                const MapperState& mapper) const override;
  MapEdit MakeKeyframe(const Map& map, const std::shared_ptr<const Frame>& frame,
                       const FramePose& pose) const override;
  std::optional<NewPart> Begin(const std::shared_ptr<const Frame>& frame,
                               const DriveState& drive) const override;
  /// Never: the published system has nothing but its images.
  std::optional<MapEdit> Extend(const std::shared_ptr<const Frame>&,
                                const DriveState&) const override {
    return std::nullopt;
  }
  bool BeginsParts() const override { return false; }
  bool GivesUp(const Map& map) const override;
  void Note(const std::shared_ptr<const Frame>& frame, const FramePose* pose,
            std::optional<KeyframeId> keyframe, const DriveState& drive) override;
  void CarryOver(const Map& before, const Map& now) override;

 private:
  struct Instant {
    std::int64_t frame_number = 0;
    std::int64_t stamp_ns = 0;
  };

  const StereoCamera camera_;
  const int levels_;
  const OrbSlam2Options options_;
  OrbSlam2Memory memory_;
  Instant found_;  // after the last loss, or where the drive began
  std::int64_t keyframe_stamp_ns_ = 0;
};

}  // namespace aisle::slam
