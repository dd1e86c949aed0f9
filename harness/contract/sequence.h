#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/frame.h"

namespace aisle {

/// Which frame is wanted: at a time and from a rig pose. The run asks for the planned pose today;
/// a vehicle steered by the estimate would ask for another.
struct FrameRequest {
  std::int64_t id = 0;
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
};

struct SequenceFrame {
  StereoFrame images;
  std::optional<FrameTruth> truth;
};

/// The socket for a source of stereo frames: a simulation, a recording.
class Sequence {
 public:
  virtual ~Sequence() = default;
  virtual std::string name() const = 0;
  virtual StereoCalibration calibration() const = 0;
  virtual double rate_hz() const = 0;
  /// The frames as planned, in time order. A recording's poses are its truth or identity.
  virtual std::vector<FrameRequest> Schedule() const = 0;
  /// One frame; pure. A recording ignores the pose and refuses stamps it does not have.
  virtual SequenceFrame At(const FrameRequest& request) const = 0;
};

}  // namespace aisle
