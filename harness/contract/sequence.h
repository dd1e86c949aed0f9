#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/frame.h"

namespace aisle {

/// Which frame is wanted: at a time and from a rig pose, the planned one or, of a vehicle that
/// steers by the estimate, the one that it has reached.
struct FrameRequest {
  std::int64_t id = 0;        ///< number of the frame, from 0 on
  std::int64_t stamp_ns = 0;  ///< nanoseconds; the middle of the exposure
  /// Metres; world right-handed with z up, rig = left rectified camera (x right, y down, z
  /// forward).
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
  /// Whether anybody knows it: where a recording has no truth it is identity, and means nothing.
  bool pose_known = true;
};

struct SequenceFrame {
  StereoFrame images;
  std::optional<FrameTruth> truth;  ///< absent where nobody knows it, in parts where some is known
};

/// What wheels measured: of every frame but the first, the rig's motion since the frame before, or
/// nothing where they were silent.
using WheelMotions = std::vector<std::optional<MotionMeasurement>>;

/// The socket for a source of stereo frames: a simulation, a recording. At is pure and may be
/// called from several threads at once, in any order: the same request gives the same pixels. It
/// throws std::runtime_error where a frame cannot be had; that is the source's failure, not the
/// system's.
class Sequence {
 public:
  virtual ~Sequence() = default;
  virtual std::string name() const = 0;  ///< as reports call it, "paper/scene2"
  /// Of the rectified pair; does not change.
  virtual StereoCalibration calibration() const = 0;
  virtual double rate_hz() const = 0;  ///< frames a second as planned, more than 0
  /// The frames as planned: ids count from 0, stamps rise. A recording's poses are its truth.
  virtual std::vector<FrameRequest> Schedule() const = 0;
  /// One frame; the images belong to the caller. A recording ignores the pose and refuses stamps it
  /// does not have.
  virtual SequenceFrame At(const FrameRequest& request) const = 0;
  /// What the wheels of a recorded vehicle measured; nothing at all where nobody recorded them.
  /// Frames of At come without. Throws std::runtime_error where they make no sense.
  virtual std::optional<WheelMotions> ReadWheels() const { return std::nullopt; }
};

}  // namespace aisle
