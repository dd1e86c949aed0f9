#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/feature/corners.h"
#include "slam/feature/feature_options.h"
#include "slam/feature/features.h"
#include "slam/feature/pyramid.h"

namespace aisle::slam {

/// Where one camera could have features: known before anybody says what moves.
struct ImageCorners {
  Pyramid pyramid;
  std::vector<std::vector<Corner>> levels;  ///< of each level of the pyramid, by rising (y, x)
};

/// What one camera sees.
struct ImageFeatures {
  Pyramid pyramid;
  Features features;  ///< by rising level, then (y, x)
};

/// Oriented FAST corners with rotated BRIEF descriptors, spread over the image and its pyramid.
///
/// `mask`, 255 = reject, is either empty or of the image's size. No feature lies on a rejected
/// pixel or within the options' margin of one, and what the mask costs is spent elsewhere: the
/// budget is distributed only after the mask has been applied.
ImageFeatures ExtractFeatures(const cv::Mat1b& image, const cv::Mat1b& mask,
                              const FeatureOptions& options);

/// The same in two steps, the first of which needs no mask.
ImageCorners FindCorners(const cv::Mat1b& image, const FeatureOptions& options);
ImageFeatures ChooseFeatures(ImageCorners corners, const cv::Mat1b& mask,
                             const FeatureOptions& options);

/// Splits `budget` over levels: geometrically as the sides of their images shrink (by `scale` each,
/// not by its square as their areas do), never more than a level has, and what one level cannot use
/// goes to the others.
std::vector<int> ShareBudget(const std::vector<int>& available, int budget, double scale);

}  // namespace aisle::slam
