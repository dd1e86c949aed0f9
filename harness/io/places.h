#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace aisle {

/// Where a program of ours finds what comes with it.
struct OwnPlace {
  std::filesystem::path folder;  ///< holds assets/ and scenes/; empty: neither is around it
  bool installed = false;        ///< PREFIX/share/aisle, and no source tree
};

/// What is around a program's or a module's file: PREFIX/share/aisle, or the tree from which the
/// build folder it stands in was made. The build writes aisle-built-from there, so that no path of
/// a machine is in the program itself.
OwnPlace FindOwnPlace(const std::filesystem::path& executable);

/// What comes with this program: PREFIX/share/aisle where it is installed, the source tree where it
/// was built. Throws InputError where neither is around it.
std::filesystem::path OwnFolder();

/// Installed, and not run from a build folder.
bool IsInstalled();

/// How one calls this program: "aisle" where it is installed, the launcher of a tree otherwise.
std::string OwnCommand();

/// Meshes and textures: $AISLE_ASSETS, or assets/ of what comes with this program. Throws
/// InputError when there is no such folder.
std::filesystem::path AssetsDir();

/// The scenes that come with the program: beside the assets.
std::filesystem::path ScenesDir();

/// A scene, a suite or a folder of them, given by its file or by its name among those that come
/// with the program: "paper/scene2", "quickstart" (of suites/), "scenes/suites/smoke.yaml". What is
/// none of these is handed back as it is.
std::string SceneFile(const std::string& file_or_name);

/// The names that SceneFile knows: scenes as "paper/scene2", suites as "quickstart", in order.
std::vector<std::string> NamesOfScenes();

/// Rendered frames shared between runs: $AISLE_CACHE; .cache/ of the source tree; of an installed
/// program aisle/ of $XDG_CACHE_HOME or ~/.cache.
std::filesystem::path CacheDir();

/// What users set and keep, of an installed program: aisle/ of $XDG_DATA_HOME or ~/.local/share.
std::filesystem::path UserDataDir();

/// This very program.
std::filesystem::path OwnExecutable();

/// The file that this code was loaded from: the program's, or a module's within a program of others
/// (Python's).
std::filesystem::path OwnFile();

/// Now, UTC: "2026-01-31T02:00:00Z".
std::string NowIso8601();

}  // namespace aisle
