#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace aisle::sim {

/// One picture of a sequence without sensor noise, and what truth says of its points.
struct PictureWithFlow {
  cv::Mat1f grey;      ///< 0 to 255
  cv::Mat1f depth;     ///< z in metres
  cv::Mat1w instance;  ///< label by pixel
  cv::Mat1b mover;     ///< 255 where the pixel shows an actor
  cv::Mat1b shadow;    ///< 255 where a resting surface lies in a moving shadow
  cv::Mat2f flow;      ///< to the next picture, pixels; NaN where unknown
  cv::Mat1f z_next;    ///< depth that the point has in the next picture, metres; NaN where unknown
};

/// How much brightness changes along the true flow, in grey levels: of what is a point's own, only
/// light that really changes is left, and whatever the renderer deals anew for each frame.
struct PictureChange {
  double rms = 0;  ///< of the change from one picture to the next, of means over 9 × 9 pixels
  /// Deviation of the change of that change over √3, from the upper quartile of its amount: as
  /// large as `rms` where the light of each picture has noise of its own, small where light changes
  /// smoothly, and where a shadow really sweeps over less than a quarter of what is seen.
  double flicker = 0;
  int compared = 0;  ///< windows
};

/// By what the pixels show: things at rest outside moving shadows, movers, moving shadows.
struct PictureChanges {
  PictureChange statics, movers, shadows;
};

/// The sentence that says what changed more than light on surfaces does, or empty. Bounds, in grey
/// levels: things at rest 2.5 from picture to picture, movers and moving shadows a flicker of 2;
/// what fewer than five hundred windows show is not judged.
std::string FailureOf(const PictureChanges& changes);

/// Grey of `next` where the points of `now` are then, less their grey now; NaN where something else
/// is seen then or an outline lies within two pixels (a pixel there mixes two surfaces that move
/// apart).
cv::Mat1f ChangeAlongFlow(const PictureWithFlow& now, const PictureWithFlow& next);

/// Compares three successive pictures.
PictureChanges CompareInTime(const PictureWithFlow& first, const PictureWithFlow& second,
                             const PictureWithFlow& third);

}  // namespace aisle::sim
