#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

namespace aisle {

/// The keypoints of one left image, as a foreign system tells them.
struct FrameFeatures {
  std::vector<cv::Point2f> points;  ///< the centre of pixel (0, 0) is u = 0, v = 0
  std::vector<bool> used;           ///< one each: took part in the pose
};

/// Reads "frame,u,v,used": a row a keypoint, frames counted from 0 in the order of the dataset, u
/// and v in pixels of the left image, used 1 or 0 (1 where the column is missing). A first line of
/// names is passed over, as are lines that begin with '#'. Throws InputError with file and line.
std::map<std::int64_t, FrameFeatures> ReadFeatures(const std::filesystem::path& file);

}  // namespace aisle
