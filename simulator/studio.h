#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>

#include "simulator/camera/pixel_rays.h"
#include "simulator/camera/stereo_camera.h"
#include "simulator/shade/shader.h"
#include "simulator/truth/moving_now.h"

namespace aisle::sim {

/// When and from where a picture is taken.
struct Moment {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
};

/// The parts that take pictures, for those who judge these part by part: what Pipeline is made of,
/// or a test. All must outlive it.
struct Studio {
  const World& world;
  const Tracer& tracer;
  const Shader& shader;
  const StereoCamera& camera;
  const PixelRays& rays;  ///< of `camera`
  MovingOptions moving;
  float exposure = 1;  ///< from radiance to shares of the sensor's white
  /// The left camera's sensor without noise, at one exposure.
  std::function<cv::Mat1b(const cv::Mat1f& radiance)> expose = {};

  Instant At(const Moment& moment) const { return tracer.Pose(world.At(moment.stamp_ns)); }
  /// Left and right.
  std::array<CameraView, 2> Views(const Moment& moment) const {
    return {CameraView(rays, CameraPose(camera, moment.T_world_rig, StereoSide::kLeft)),
            CameraView(rays, CameraPose(camera, moment.T_world_rig, StereoSide::kRight))};
  }
};

}  // namespace aisle::sim
