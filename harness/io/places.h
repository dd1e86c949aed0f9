#pragma once

#include <filesystem>
#include <string>

namespace aisle {

/// The source tree this program was built from.
std::filesystem::path SourceDir();

/// Meshes and textures: $AISLE_ASSETS, or assets/ of the source tree this program was built from.
/// Throws InputError when there is no such folder.
std::filesystem::path AssetsDir();

/// The scenes that come with the program: beside the assets.
std::filesystem::path ScenesDir();

/// A scene given by its file, or by its name in the tree: "paper/scene2".
std::string SceneFile(const std::string& file_or_name);

/// Rendered frames shared between runs: $AISLE_CACHE, or .cache/ of the source tree.
std::filesystem::path CacheDir();

/// This very program.
std::filesystem::path OwnExecutable();

/// Now, UTC: "2026-01-31T02:00:00Z".
std::string NowIso8601();

}  // namespace aisle
