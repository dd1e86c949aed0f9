#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "simulator/frames.h"
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

/// Reads the labels off the hits. `moving` is asked about the surface point of each.
CameraTruth LabelHits(const World& world, const Instant& instant, const HitImage& image,
                      const MovingNow& moving);

/// Every mover that has a pixel in the image, or would have if it stood alone; by instance.
std::vector<ObjectTruth> DescribeMovers(const Instant& instant, const CameraView& view,
                                        const CameraTruth& truth);

}  // namespace aisle::sim
