#pragma once

#include "harness/contract/frame.h"
#include "harness/contract/wheel_track.h"
#include "harness/ros/drawing.h"

namespace aisle {

/// Rows without gaps. Grey masks as mono8, depth as 16UC1. Throws std::invalid_argument for another
/// kind of pixel.
ros::Image ImageMessage(const ros::Header& header, const cv::Mat& image);

/// A colour picture (B, G, R) as rgb8.
ros::Image ColourMessage(const ros::Header& header, const cv::Mat3b& picture);

/// Of a rectified pair: side 0 is left. -p[3] / p[0] gives the baseline back to the bit.
ros::CameraInfo CameraInfoMessage(const ros::Header& header, const StereoCalibration& calibration,
                                  int side);

/// What an odometer says of the body `base`, in the header's frame.
ros::Odometry OdometryMessage(const ros::Header& header, const std::string& base,
                              const OdometryReading& reading);

/// The objects' boxes in space, red where they move; those of frames before are deleted. Objects
/// whose box is not known are left out.
ros::MarkerArray BoxMarkers(const ros::Header& header, const std::vector<ObjectTruth>& objects);

/// What shows of them in the left image, as one list of lines.
ros::ImageMarker ImageBoxes(const ros::Header& header, const std::vector<ObjectTruth>& objects);

}  // namespace aisle
