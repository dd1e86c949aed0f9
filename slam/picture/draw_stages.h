#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace aisle::slam {

struct DynamicStages;

/// What really moves in the left image, where the caller knows it.
struct StageTruth {
  cv::Mat1b moving = {};             ///< 255 = moves now; empty: not known
  std::vector<cv::Rect> boxes = {};  ///< of the objects that move
};

/// One stage as people read it: a title above the picture, a legend and numbers below.
struct StagePicture {
  std::string name;  ///< "epipolar", "boundaries", …: fit for a file name
  cv::Mat3b image;   ///< BGR; all pictures of a frame have one size
};

/// The stages of one frame in the order in which they ran, always the same ones for one method;
/// none where the method had no past to compare with. Pure.
std::vector<StagePicture> DrawStages(const DynamicStages& stages, const StageTruth& truth);

}  // namespace aisle::slam
