#pragma once

#include <Eigen/Geometry>

#include "simulator/camera/stereo_camera.h"
#include "simulator/trace/hit_image.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// How far the image of an camera moves while the camera goes from `T_world_first` to
/// `T_world_last` in `duration_s`, pixels: what all but one in two hundred of the hits (every
/// fourth pixel either way) stay below, when their surfaces move on at the velocity they have now.
double ImageMotion(const World& world, const Instant& instant, const StereoCamera& camera,
                   const CameraView& view, const HitImage& hits,
                   const Eigen::Isometry3d& T_world_first, const Eigen::Isometry3d& T_world_last,
                   double duration_s);

}  // namespace aisle::sim
