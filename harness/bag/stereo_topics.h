#pragma once

#include <string>
#include <vector>

#include "harness/bag/bag.h"

namespace aisle {

struct StereoTopics {
  std::string left, right;
};

/// True for the types that hold a picture.
bool IsImageType(const std::string& type);

/// Which topics of a bag are the left and the right image: those asked for (two, or one whose
/// partner its name tells), else the only pair whose names differ in left/right, cam0/cam1,
/// infra1/infra2 or the like; of an image and its compressed copy the image. Throws InputError that
/// lists what there is.
StereoTopics FindStereoTopics(const Bag& bag, const std::vector<std::string>& asked,
                              const std::string& file);

/// "/left/image_raw", "/left/image_raw/compressed" -> "/left/camera_info".
std::string CameraInfoTopicOf(const std::string& image_topic);

}  // namespace aisle
