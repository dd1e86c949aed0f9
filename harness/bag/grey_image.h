#pragma once

#include <opencv2/core.hpp>

#include "harness/ros/sensor.h"

namespace aisle {

/// An image of a bag as 8-bit grey: mono8 and mono16 (its upper byte), rgb8, bgr8, rgba8, bgra8,
/// bayer_*8, uyvy and yuyv. Rows may have gaps. Throws ros::CdrError: an encoding that is not read,
/// fewer bytes than the size asks for, or rows that begin within a value.
cv::Mat1b GreyImage(const ros::Image& message);

/// The same of a PNG or JPEG. Where `format` says what was packed ("bayer_rggb8; png compressed"),
/// that counts; else the picture's own channels. Throws ros::CdrError for every other kind of
/// picture, and before it decodes one whose header states more than 64 Mi pixels.
cv::Mat1b GreyImage(const ros::CompressedImage& message);

}  // namespace aisle
