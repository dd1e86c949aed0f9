#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulator/frames.h"
#include "simulator/scene/bag_poses.h"
#include "simulator/scene/drive_spec.h"

namespace aisle::sim {

// What a scene's file says, without building the scene. `bags` is as SimulatorOptions has it.

/// Every mistake in a scene file, one message each (empty: the file is good). Where `assets_dir` is
/// given, models that its manifest does not have are mistakes too; none is opened. Never throws for
/// what the file holds.
std::vector<std::string> CheckSceneFile(const std::string& scene_file,
                                        const std::string& assets_dir = "",
                                        const BagPoseReader& bags = {});

/// A good scene at a glance.
struct SceneInfo {
  int frames = 1;
  DriveSpec drive;  ///< `there` is false where the scene has none
  /// The hall that the seed is in, by its file's name ("cold_store"); empty where the scene says
  /// itself what is there.
  std::string hall;
};

/// Reads the file once. Throws as Simulator::Load does for a file with mistakes.
SceneInfo ReadSceneInfo(const std::string& scene_file, std::uint64_t seed = 1,
                        const BagPoseReader& bags = {});

/// Of each mesh of a user's own that a scene names: "FILE: licence X, from Y"; of one that is used
/// as it is: that nothing is recorded. Throws likewise.
std::vector<std::string> DescribeSceneMeshes(const std::string& scene_file,
                                             const BagPoseReader& bags = {});

/// A scene's file and those it extends, nearest first, then those it names: the scene is what they
/// hold. Of a file with mistakes, as far as they can be followed.
std::vector<std::string> FilesOfScene(const std::string& scene_file,
                                      const BagPoseReader& bags = {});

/// All of a scene that decides the frames of that twin, as text, without `about` and without actors
/// that are not seen. Scenes of equal essence have equal frames for the same seed, assets and
/// program. Throws as Simulator::Load does where the file cannot be read as YAML; other mistakes
/// are not looked for.
std::string EssenceOfScene(const std::string& scene_file, Twin twin,
                           const BagPoseReader& bags = {});

}  // namespace aisle::sim
