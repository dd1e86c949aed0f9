#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "simulator/camera/stereo_camera.h"
#include "simulator/trace/hit_image.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// The rig's pose so many seconds after a picture's stamp: T_world_rig.
using RigAround = std::function<Eigen::Isometry3d(double offset_s)>;

/// How far the image of a camera goes while the rig moves as `rig_at` says, for `duration_s` around
/// the stamp, pixels, there and back counted both: what all but one in two hundred of the hits
/// (every fourth pixel either way) stay below, when their surfaces move on at the velocity they
/// have now.
double ImageMotion(const World& world, const Instant& instant, const StereoCamera& camera,
                   const CameraView& view, const HitImage& hits, const RigAround& rig_at,
                   double duration_s);

/// The same of the light on what is seen: a beam that turns is taken to sweep the image as one that
/// shines from the camera would. Infinite where a light is switched, or changes its strength.
double LightMotion(const World& world, const Snapshot& now, const StereoCamera& camera,
                   double duration_s);

}  // namespace aisle::sim
