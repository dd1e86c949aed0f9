#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace aisle {

/// What one stage of a small drive made, as a hash of its bytes.
struct StageBits {
  std::string stage;
  std::uint64_t hash = 0;
};

struct StageBitsOptions {
  std::string scene_file, assets_dir;
  int threads = 0;           ///< 0: as many as the machine has; never changes a bit
  int frames = 8;            ///< driven through, the first of the scene
  int hashed_frames = 2;     ///< of them, those whose stages up to the pictures are hashed
  double light_spacing = 8;  ///< the static light's points lie this much further apart than usual
  bool drive = true;         ///< with the stages of the SLAM; else those of the simulator alone
};

/// Renders the first frames of a scene, its static light solved anew, drives the SLAM through them,
/// and hashes what every stage made, in the order in which they feed each other: where two
/// machines first differ is where their processors part. Throws InputError for a bad scene.
std::vector<StageBits> HashStages(const StageBitsOptions& options);

}  // namespace aisle
