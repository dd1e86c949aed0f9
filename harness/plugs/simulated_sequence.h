#pragma once

#include <memory>
#include <string>

#include "harness/contract/sequence.h"
#include "harness/io/dataset.h"

namespace aisle {

struct SimulatedSequenceOptions {
  std::string scene_file;
  std::string scene_name;  ///< for reports, e.g. "paper/scene2"
  std::string assets_dir;
  std::string twin = "live";  ///< live, empty or frozen
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has; never changes a pixel
  std::string isa = "avx2";
};

/// The names a suite may use; the same order as in the reports.
const std::vector<std::string>& TwinNames();

/// A scene as a sequence. `content_hash` and `path` may be null; `path` becomes the pose of the rig
/// at any time, valid while the sequence lives. Throws InputError with the simulator's own message
/// (file:line:column) for a bad scene.
std::unique_ptr<Sequence> OpenSimulation(const SimulatedSequenceOptions& options,
                                         std::uint64_t* content_hash = nullptr,
                                         PathOfRig* path = nullptr);

/// Every mistake in a scene file, one message each.
std::vector<std::string> CheckScene(const std::string& scene_file);

}  // namespace aisle
