#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "harness/contract/drive_log.h"

namespace aisle {

/// The floor around a vehicle of a closed drive: what stands, who walks, the planned route, the
/// true way and the believed one, the true footprint and, as an outline, where it takes itself to
/// be. North is up; BGR.
class DriveView {
 public:
  DriveView(const DriveLog& log, cv::Size size, double px_per_m);

  cv::Mat3b At(std::size_t sample) const;

 private:
  const DriveLog& log_;
  const cv::Size size_;
  const double px_per_m_;
};

/// A film of a closed drive: the camera's picture beside the floor from above. What happens on the
/// floor is known in full when the drive is over, so that pictures wait until then, packed.
class DriveFilm {
 public:
  /// A picture of the camera, at its stamp; all of one size, with even sides.
  void Keep(std::int64_t stamp_ns, const cv::Mat3b& picture);
  /// True if the film is whole and stands under its name. `rate_hz`: pictures a second.
  bool Write(const DriveLog& log, const std::filesystem::path& file, double rate_hz) const;

 private:
  std::vector<std::pair<std::int64_t, std::vector<unsigned char>>> pictures_;
};

}  // namespace aisle
