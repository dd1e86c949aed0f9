#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace aisle::sim {

/// How a mesh of a user's own is taken in.
struct ModelImport {
  std::string file;      ///< .glb, .gltf, .obj or .dae
  std::string output;    ///< ends with .aislemesh; a record is written beside it
  std::string licence;   ///< under which the user has it, in the user's words; recorded
  double unit_m = 0;     ///< metres of the file's unit; 0: what the file or its format says
  char up = 0;           ///< 'x', 'y' or 'z'; 0: what the file or its format says
  bool skinned = false;  ///< keeps skeleton and animations; otherwise it stands as at rest
};

/// What came of it.
struct ImportedModel {
  std::array<double, 3> low_m = {0, 0, 0}, high_m = {0, 0, 0};  ///< bounds at rest, z up
  std::size_t triangles = 0, materials = 0, textures = 0;
  std::vector<std::string> nodes;     ///< names of those that show something, as labels see them
  std::vector<std::string> clips;     ///< names of the animations that were kept
  std::vector<std::string> left_out;  ///< phrases: "2 cameras"
  cv::Mat1b picture;                  ///< as the renderer shows it, on a floor with a grid
  double grid_m = 1;                  ///< between the lines of that floor
};

/// Reads a foreign mesh in a process of its own, checks it, writes it as this project's own file
/// with its record, and photographs it. Throws std::runtime_error: one sentence, with the file.
ImportedModel ImportUserModel(const ModelImport& request);

}  // namespace aisle::sim
