#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "simulator/trace/hit_image.h"
#include "simulator/truth/moving_now.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// Exact truth of one camera, at the pixel centres.
struct CameraTruth {
  cv::Mat1f depth;         ///< z in metres along the optical axis, infinity where nothing was hit
  cv::Mat1w instance;      ///< index into World::instances(), 0 where nothing was hit
  cv::Mat1b object_class;  ///< ObjectClass values
  cv::Mat1b dynamic;       ///< 255 where the surface itself moves now, see MovingNow
  cv::Mat1b actor;         ///< 255 on every instance that may move, moving or not
};

/// Truth of one moving thing as one camera sees it.
struct MoverTruth {
  std::uint16_t instance = 0;
  cv::Rect2d box_visible;  ///< pixels; encloses the pixels that show it, empty if none does
  cv::Rect2d box_full;     ///< pixels; as if nothing stood in front, cut at the image border
  Eigen::Isometry3d T_world_object = Eigen::Isometry3d::Identity();
  Eigen::Vector3d extent_m = Eigen::Vector3d::Zero();  ///< sizes of the 3-D box along its own axes
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  ///< of the 3-D box, world
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  double visible_fraction = 0;  ///< pixels that show it / pixels that would if it were alone
  int visible_pixels = 0;
  int dynamic_pixels = 0;  ///< of them, on a surface that moves now
};

/// Reads the labels off the hits. `moving` is asked about the surface point of each.
CameraTruth LabelHits(const World& world, const Instant& instant, const HitImage& image,
                      const MovingNow& moving);

/// Every mover that has a pixel in the image, or would have if it stood alone; by instance.
std::vector<MoverTruth> DescribeMovers(const Instant& instant, const CameraView& view,
                                       const CameraTruth& truth);

}  // namespace aisle::sim
