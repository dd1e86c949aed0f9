#pragma once

#include <filesystem>
#include <stdexcept>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"

namespace aisle {

/// What an estimator wants to be told besides the images.
enum class MaskSource {
  kNone,
  kDynamic,  ///< truth's mask of what moves now (`oracle`)
  kActors,   ///< every person and vehicle, moving or not (`semantic`)
};

/// The socket for a system under test: frames in, poses out. Truth never passes through it.
class Estimator {
 public:
  virtual ~Estimator() = default;
  virtual FrameEstimate Process(const StereoFrame& frame, const ExternalMask& mask) = 0;
  /// Ends the run; the final track over all frames the system stands by.
  virtual Trajectory Finish() = 0;
  /// Writes the map for a later drive. Throws std::runtime_error where it cannot: apart from
  /// Finish, so that the trajectory is safe by then.
  virtual void SaveMap(const std::filesystem::path& file) {
    throw std::runtime_error(file.string() + ": this system keeps no map");
  }
};

}  // namespace aisle
