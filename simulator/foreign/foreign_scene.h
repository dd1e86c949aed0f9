#pragma once

#include <array>
#include <filesystem>
#include <stdexcept>

#include "simulator/camera/stereo_camera.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// A foreign scene that cannot be read; what() is "file: key: what is wrong".
class ForeignSceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A scene of another renderer, still and in colour.
struct ForeignScene {
  StereoCamera camera;  ///< its left camera's is the picture
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::array<WorldParts, 3> bands;  ///< red, green, blue: alike but for albedo and radiance
};

/// Reads a scene in the JSON dialect in which the Cornell box is handed around: a perspective
/// `camera` (row-major camera-to-world `transform`: x to the left, y up, z ahead; `fov` across the
/// width in degrees), `film.size`, diffuse `bsdfs`, `shapes` from OBJ files inside the scene's
/// folder with row-major transforms, `entities` that join a shape and a bsdf, and area `lights` on
/// entities that are one parallelogram. Clip distances have no meaning to rays. Anything else is an
/// error, as a picture that left it out would be another one.
///
/// The world is scaled so that its farthest coordinate is 10 m, as rays' margins are made for
/// metres; radiance does not depend on it. Throws ForeignSceneError.
ForeignScene LoadForeignScene(const std::filesystem::path& file);

}  // namespace aisle::sim
