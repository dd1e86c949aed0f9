#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace aisle::sim {

/// When each row of a picture gathers its light. Off by default: a picture is then one instant.
struct ShutterOptions {
  bool motion_blur = false;  ///< integrate over the exposure time
  double readout_ms = 0;    ///< rolling shutter: last row starts so much after the first; 0: global
  double spacing_px = 1.5;  ///< image motion from one instant to the next, at most
  int most_instants = 25;   ///< a faster image shows steps instead; odd

  /// The first rule broken, with name, value and bound; empty if none is.
  std::string Validate() const;
  /// Whether a picture is more than one instant at all.
  bool IsOpenFor(double exposure_ms) const {
    return readout_ms > 0 || (motion_blur && exposure_ms > 0);
  }
};

/// The instants to render, and how much of each every row gets.
struct ShutterPlan {
  /// Seconds from the picture's stamp, rising, equally spaced, an odd number; the middle one is 0.
  std::vector<double> offsets_s;
  cv::Mat1f weights;  ///< rows of the image × instants; each row sums to 1

  /// The rows [first, last) that use an instant.
  cv::Range RowsOf(int instant) const;
};

/// From the opening of the first row to the closing of the last, seconds.
double OpenTime(const ShutterOptions& options, double exposure_ms);

/// Row r of `rows` is exposed for exposure_ms around stamp + ((r + 1/2) / rows - 1/2) · readout:
/// the stamp is the middle of the middle row's exposure. Between neighbouring instants light is
/// taken to change linearly, so that a row's share of an instant is the integral of a hat function
/// over the row's exposure. `motion_px` is how far the image moves while any row is open; where it
/// stays below a quarter of the spacing one instant will do.
ShutterPlan PlanShutter(const ShutterOptions& options, double exposure_ms, int rows,
                        double motion_px);

/// sum(y, ·) += weights(y, instant) · image(y - first_row, ·), for the rows that use the instant.
void AddInstant(const ShutterPlan& plan, int instant, const cv::Mat1f& image, int first_row,
                cv::Mat1f* sum);

}  // namespace aisle::sim
