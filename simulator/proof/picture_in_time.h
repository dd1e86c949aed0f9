#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>

#include "simulator/camera/pixel_rays.h"
#include "simulator/camera/stereo_camera.h"
#include "simulator/proof/picture_change.h"
#include "simulator/shade/shader.h"
#include "simulator/truth/moving_shadow.h"

namespace aisle::sim {

/// When and from where a picture is taken.
struct Moment {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
};

/// A world that can be photographed. All must outlive it.
struct Studio {
  const World& world;
  const Tracer& tracer;
  const Shader& shader;
  const StereoCamera& camera;
  const PixelRays& rays;
  MovingOptions moving;
  std::function<cv::Mat1b(const cv::Mat1f& radiance)> expose;  ///< without noise
};

/// The left picture of a moment, and where its points are at the next.
PictureWithFlow TakeWithFlow(const Studio& studio, const Moment& now, const Moment& next);

}  // namespace aisle::sim
