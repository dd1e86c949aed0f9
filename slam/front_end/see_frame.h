#pragma once

#include <map>
#include <memory>
#include <string>

#include "slam/camera/measured_motion.h"
#include "slam/camera/stereo_camera.h"
#include "slam/feature/extract.h"
#include "slam/frames.h"
#include "slam/map/frame.h"
#include "slam/options/slam_options.h"

namespace aisle::slam {

/// Throws std::invalid_argument that names the image where one is not of the camera's size, or the
/// pixel whose confidence is not finite.
void CheckImages(const StereoImages& images, const ExternalMask& mask, const StereoCamera& camera);

/// Throws std::invalid_argument where a measured motion is none: not finite, or its covariance not
/// symmetric and positive definite.
void CheckMotion(const MeasuredMotion& motion);

/// Whether the mask says of the right image what it says of the left one: what it tells of the left
/// one alone, a mover or how far a pixel is trusted, is not known where the right camera sees it.
bool TellsOfBoth(const ExternalMask& mask);

/// What either mask rejects; an empty one rejects nothing.
cv::Mat1b Union(const cv::Mat1b& a, const cv::Mat1b& b);

/// The corners of both cameras, found in parallel.
struct StereoCorners {
  ImageCorners left, right;
};
StereoCorners FindStereoCorners(const StereoImages& images, const FeatureOptions& options);

/// What the left camera alone sees outside the mask: no depths. Enough to find landmarks by.
Frame SeeLeft(const StereoImages& images, ImageCorners corners, const ExternalMask& mask,
              const SlamOptions& options);

/// What both cameras see.
struct StereoSight {
  std::shared_ptr<const Frame> frame;  ///< the left camera's features, with depths by the right one
  /// All features of the right camera by themselves (Measurement::right), without patches; null for
  /// Base::kOrbSlam2, which does not ask it.
  std::shared_ptr<const Frame> right = nullptr;
};

/// The front end: features of both cameras outside the mask, and what they measure. The deviations
/// grow as the confidence in the pixel falls: information times confidence. Runs both cameras in
/// parallel; times go to `stage_ms`.
StereoSight SeeFrame(const StereoImages& images, StereoCorners corners, const ExternalMask& mask,
                     const StereoCamera& camera, const SlamOptions& options,
                     std::map<std::string, double>& stage_ms);

}  // namespace aisle::slam
