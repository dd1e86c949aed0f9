#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace aisle {

/// A mesh of the user's own that is to be taken in.
struct UserModelRequest {
  std::string file;      ///< .glb, .gltf, .obj or .dae
  std::string output;    ///< .aislemesh
  std::string licence;   ///< recorded as it is
  double unit_m = 0;     ///< metres of its unit; 0: what the file says
  char up = 0;           ///< x, y or z; 0: what the file says
  bool skinned = false;  ///< with its skeleton and animations
};

struct UserModel {
  std::array<double, 3> low_m = {0, 0, 0}, high_m = {0, 0, 0};  ///< bounds, z up
  std::size_t triangles = 0, materials = 0, textures = 0;
  std::vector<std::string> nodes;     ///< that show something
  std::vector<std::string> clips;     ///< animations that were kept
  std::vector<std::string> left_out;  ///< phrases
  cv::Mat1b picture;
  double grid_m = 1;  ///< between the lines of the picture's floor
};

/// Writes the model and its record. Throws InputError with one sentence.
UserModel TakeInUserModel(const UserModelRequest& request);

/// A line about each mesh of the user's own in a good scene: its licence and source.
std::vector<std::string> DescribeMeshes(const std::string& scene_file);

}  // namespace aisle
