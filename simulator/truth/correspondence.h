#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "simulator/camera/stereo_camera.h"
#include "simulator/trace/hit_image.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// Where each left pixel's surface point appears in another picture.
struct Correspondence {
  cv::Mat1f disparity;  ///< fx · baseline / z: left u - right u of a pinhole pair, pixels; 0 where
                        ///< nothing was hit
  cv::Mat1b occluded;   ///< 255 where something hides the point from the right camera, or it lies
                        ///< outside the right image, or nothing was hit
  cv::Mat2f flow;       ///< displacement to the next frame's left image, pixels; NaN where the
                        ///< point is not in front of the camera then or beyond what its lens
                        ///< shows, has come round (MoverState::rounds), or nothing was hit
  cv::Mat3f scene_flow;  ///< displacement of the surface point itself until then, metres, world;
                         ///< NaN where it has come round
};

/// Exact correspondences of the hits in the left image. The surface point of a mover is followed by
/// its barycentrics on the posed mesh of `next`; the camera is then at `T_world_rig_next`.
Correspondence FindCorrespondence(const World& world, const Instant& instant,
                                  const StereoCamera& camera, const CameraView& left,
                                  const HitImage& hits, const Snapshot& next,
                                  const Eigen::Isometry3d& T_world_rig_next);

/// How well a picture's geometry, carried along correspondences, meets the other picture's own.
struct WarpCheck {
  double median_px = 0;  ///< error, as disparity at the camera's own baseline
  double p95_px = 0;
  int compared = 0;  ///< pixels that are seen in both and not at a silhouette
};

/// Left against right: the disparity of a left pixel, against the one that the right image's own
/// depth gives where it lands.
WarpCheck CheckStereo(const StereoCamera& camera, const PixelRays& rays,
                      const cv::Mat1f& depth_left, const cv::Mat1f& depth_right,
                      const Correspondence& correspondence);

/// Frame against next frame: the depth that a point has then, against the next image's own depth
/// where the flow lands. `z_next` comes with the flow: the point's depth in the next left camera.
WarpCheck CheckFlow(const StereoCamera& camera, const cv::Mat1f& z_next,
                    const cv::Mat1f& depth_next, const cv::Mat2f& flow);

/// Depth z that each left pixel's point has in the next left camera, NaN where unknown.
cv::Mat1f DepthInNextCamera(const CameraView& left, const HitImage& hits,
                            const Correspondence& correspondence,
                            const Eigen::Isometry3d& T_world_rig_next);

}  // namespace aisle::sim
