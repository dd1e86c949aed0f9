#pragma once

#include "slam/dynamic/dynamic_stages.h"
#include "slam/picture/draw_stages.h"

namespace aisle::slam::picture {

/// What was rejected beside what moves: pixels of both, of one alone, and rectangles with their
/// overlap. Without truth the rejected ones alone.
StagePicture DrawRegions(const DynamicStages& stages, const StageTruth& truth, int number);

/// Largest overlap (IoU) of a rectangle with any of the others; 0 where there are none.
double BestOverlap(const cv::Rect& box, const std::vector<cv::Rect>& others);

}  // namespace aisle::slam::picture
