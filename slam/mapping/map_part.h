#pragma once

#include <memory>
#include <optional>

#include "slam/camera/stereo_camera.h"
#include "slam/map/create_landmarks.h"
#include "slam/map/map.h"

namespace aisle::slam {

/// The first keyframe of a part of the map.
struct NewPart {
  MapEdit edit;
  bool anew = false;  ///< the world begins with it: what map there was is given up
};

struct NewPartOptions {
  CreateLandmarksOptions create;
  int least_points = 60;     ///< stereo points of the frame
  int least_keyframes = 5;   ///< of the map that there is; a smaller one is not worth keeping ...
  bool keeps_world = false;  ///< ... unless it must stay where it is, as that of a map file
};

/// Begins a part of the map with a frame at a pose. A map of a few keyframes that was lost so soon
/// is not worth keeping: the world begins anew. Nothing where the frame shows too little depth.
std::optional<NewPart> BeginPart(const Map& map, const std::shared_ptr<const Frame>& frame,
                                 const Eigen::Isometry3d& T_world_rig, const StereoCamera& camera,
                                 const NewPartOptions& options);

/// Whether keyframe `id`, present or former, is of the first part of the map (that of a map file,
/// if there is one): that part is where the world is.
bool IsInFirstPart(const Map& map, KeyframeId id);

}  // namespace aisle::slam
