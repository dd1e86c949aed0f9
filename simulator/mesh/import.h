#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>

#include "simulator/mesh/model.h"

namespace aisle::sim {

/// A model file that cannot be used; what() is "file: what is wrong".
class ImportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Which one band of a coloured material is kept.
enum class Band { kLuminance, kRed, kGreen, kBlue };

/// Which of a file's axes points up.
enum class UpAxis {
  kAsStated,  ///< what the file or its format says; y of an OBJ file, which says nothing
  kX,
  kY,
  kZ,
};

/// The frame of an imported model.
enum class ModelFrame {
  kZUp,       ///< z up: y-up (x, y, z) becomes (x, -z, y), x-up (-z, y, x)
  kAsStored,  ///< y up, as glTF stores it
};

struct ImportOptions {
  ModelFrame frame = ModelFrame::kZUp;
  Band band = Band::kLuminance;
  bool colour = false;  ///< also fills Model::colour
  /// Metres of the file's unit; 0: what the file or its format says, a metre where neither does.
  float unit_m = 0;
  UpAxis up = UpAxis::kAsStated;
  /// A file whose unit or upward axis nobody states is refused rather than taken as metres, y up.
  bool must_state = false;
  /// A glTF model that names other files is refused: all of it is in the one whose bytes stand for
  /// it, as in the key of what is kept from run to run.
  bool one_file = false;
  /// Files the model refers to must lie inside this folder. Empty: the model's own.
  std::filesystem::path root;
  std::size_t max_triangles = 5'000'000;
  int max_texture_px = 8192;  ///< per side
  std::size_t max_file_bytes = 256u << 20;
  float max_reach_m = 10'000;  ///< of a vertex at rest from the model's origin, along each axis
};

/// Reads a .glb, .gltf, .obj or .dae file; what it holds must be what it is named. Files come from
/// outside, so everything is checked: numbers finite and within reach, indices in range, sizes
/// within the options, nothing opened outside the root, only PNG and JPEG textures. Throws
/// ImportError, and std::system_error where there is no memory for it.
Model ImportModel(const std::filesystem::path& file, const ImportOptions& options = {});

/// One band of an 8-bit sRGB image (grey, BGR or BGRA), sRGB-encoded again: for kLuminance the
/// Rec. 709 weights are applied to linear light.
cv::Mat1b GreyOf(const cv::Mat& image, Band band);

/// The same of one linear colour.
float GreyOf(const Eigen::Vector3f& linear_rgb, Band band);

/// The linear light of an 8-bit sRGB value, as a share of full.
float LinearOf(std::uint8_t srgb);

/// Decodes a PNG or JPEG file from memory after checking the size its header states. Throws
/// ImportError.
cv::Mat DecodeImage(const std::vector<std::uint8_t>& bytes, const std::string& name,
                    int max_side_px);

}  // namespace aisle::sim
