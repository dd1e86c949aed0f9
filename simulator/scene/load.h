#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/scene/bag_poses.h"
#include "simulator/scene/floor_way.h"
#include "simulator/scene/scene.h"

namespace aisle::sim {

/// A scene file with mistakes. what() is all of them, one a line.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<std::string> messages);
  /// Each "file:line:column: key: what was expected, what was found; an example".
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

// `bags` reads the way of a rig that follows poses in a bag. Without it such a scene has a mistake.

/// Reads and checks a scene file, laid over the one it extends if it does; actors of every level
/// are in it. Throws SceneError with every mistake that was found.
Scene LoadScene(const std::filesystem::path& file, const BagPoseReader& bags = {});
/// The same from text; `file` is for the messages.
Scene ParseScene(const std::string& text, const std::string& file, const BagPoseReader& bags = {});

/// What the file says as far as it can be read, held to nothing.
Scene ReadSceneLoosely(const std::filesystem::path& file, const BagPoseReader& bags = {});

/// The file and those it extends, nearest first, then those it names: what decides the scene. Of a
/// file with mistakes, as far as they can be followed.
std::vector<std::string> SceneFiles(const std::filesystem::path& file,
                                    const BagPoseReader& bags = {});

/// Every mistake in the file and those it extends; empty: it is good. Never throws for what the
/// file holds.
std::vector<std::string> CheckScene(const std::filesystem::path& file,
                                    const BagPoseReader& bags = {});

/// What goes wrong in a good scene when its actors move as this seed has them. The usual seeds are
/// part of CheckScene already. Of who moves as recorded only the start is looked at, unless `ways`
/// says where they go.
std::vector<std::string> CheckSeed(const Scene& scene, std::uint64_t seed,
                                   const FloorWays& ways = {});

/// What goes wrong in a good scene, as written or with one of the usual seeds, where people go as
/// they were recorded.
std::vector<std::string> CheckWays(const Scene& scene, const FloorWays& ways);

/// The JSON Schema (draft 7) of scene files, made from the same description the reader uses.
std::string SceneSchema();

}  // namespace aisle::sim
