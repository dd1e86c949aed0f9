#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/camera/measured_motion.h"
#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/ego_motion.h"
#include "slam/dynamic/robust/label_memory.h"
#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {

/// Noise as measured while running, by slot of the gap.
struct LearnedNoise {
  std::array<MeasurementNoise, kSlots> match = {
      MeasurementNoise(0.17, 0.17, 0.5), MeasurementNoise(0.17, 0.17, 0.5),
      MeasurementNoise(0.25, 0.25, 0.5), MeasurementNoise(0.25, 0.25, 0.5)};
  std::array<double, kSlots> flow = {0.1, 0.12, 0.15, 0.15};  ///< half-size pixels
};

/// The deviation of one disparity, half-size pixels: the shortest gap, whose flow errs least, tells
/// it best.
inline double DisparityNoise(const LearnedNoise& noise) { return noise.match[0].z() / 2; }

/// All that the method remembers between frames. A value: copies are cheap, as images are shared
/// and never written again.
struct RobustState {
  std::int64_t stamp_ns = 0;  ///< of the newest frame kept
  /// The latest ones and keyframes before them, newest last; see WithFrame.
  std::vector<DenseFrame> frames;
  std::optional<EgoMotion> motion;  ///< the latest of the rig
  double step_s = 0;                ///< its duration
  /// How the rig has gone on since the newest frame kept, as was expected, over frames that showed
  /// nothing, or nothing new; nothing if there was none.
  std::optional<MeasuredMotion> unseen_way;
  /// The picture that the camera has been seen to repeat, up to now; nothing else.
  std::optional<DenseFrame> stuck_at;
  LearnedNoise noise;
  LabelMemory memory;
  std::size_t long_slot = 0;  ///< of the longer gap compared last; 0: none was
};

/// How many frames before the current one a kept frame was.
inline int GapTo(const DenseFrame& frame, const RobustState& before) {
  return before.frames.back().number + 1 - frame.number;
}

/// The frame `gap` frames before the current one, which must be one of those kept.
const DenseFrame& FrameAgo(const RobustState& before, int gap);

/// The frames kept when a new one has come: of the latest, all that kGaps lead back to; of those
/// before, up to kLongestGap, one in kKeyframeEvery. The new one is given the next number.
std::vector<DenseFrame> WithFrame(std::vector<DenseFrame> frames, DenseFrame now);

/// The rig's motion since the frame a gap ago, if the latest step was T_now_before.
inline Eigen::Isometry3d MotionOver(int gap, const RobustState& before,
                                    const Eigen::Isometry3d& T_now_before) {
  return T_now_before * before.frames.back().T_world_rig.inverse() *
         FrameAgo(before, gap).T_world_rig;
}

}  // namespace aisle::slam::dynamic
