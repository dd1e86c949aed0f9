#pragma once

#include <string>
#include <vector>

#include "simulator/camera/stereo_camera.h"
#include "simulator/frames.h"
#include "simulator/scene/scene.h"

namespace aisle::sim {

/// The camera that a scene describes, as rays are made for it and as the face describes it.
StereoCamera CameraOf(const CameraSpec& spec);
RigInfo RigOf(const CameraSpec& spec);

/// A message for each of the scene's cameras whose lens leaves a pixel without a ray:
/// "file:line:column: key: what is wrong".
std::vector<std::string> LensErrors(const Scene& scene);

}  // namespace aisle::sim
