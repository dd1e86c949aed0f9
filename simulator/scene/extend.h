#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "simulator/scene/issues.h"
#include "simulator/scene/yaml_tree.h"

namespace aisle::sim {

/// The key by which a scene names the one it extends.
inline constexpr const char* kExtendKey = "extend";

/// Keys by which a scene takes its hall from a file: hall.use, or vary.hall; and those of where a
/// hall is looked at from.
inline constexpr const char* kHallKey = "hall";
inline constexpr const char* kUseKey = "use";
inline constexpr const char* kVaryKey = "vary";
inline constexpr const char* kViewsKey = "views";

/// What a scene's text amounts to with all the files it names.
struct SceneTrees {
  YamlValue top;                 ///< with the hall of seed 1
  std::vector<YamlValue> dealt;  ///< the same with each hall of vary.hall; empty: none varies
};

/// The file that one file of a scene names: from its own folder or, where nothing is there, among
/// the scenes that come with the program. ".yaml" may be left out. Where there is none, the former.
std::filesystem::path NamedSceneFile(const std::string& by, std::filesystem::path name);

/// The text of a scene file; where there is none, nothing and why in `problem`. Throws
/// std::system_error where the machine fails the file: too many are open, a broken disk.
std::optional<std::string> ReadSceneText(const std::filesystem::path& file, std::string* problem);

/// One file's text as a tree, a map; its name is the last that `issues` has. Nothing where it is
/// none.
std::optional<YamlValue> ReadTree(const std::string& text, Issues* issues);

/// The tree of a scene's text, laid over those of the scenes that it extends. A hall that one of
/// them names lies below that file and takes the place of all that the files further down say of
/// theirs. Every file is read and checked as YAML; their names go to `issues`, in whose order marks
/// count them. Nothing where something is wrong, with the mistakes in `issues`.
std::optional<SceneTrees> ReadExtended(const std::string& text, Issues* issues);

}  // namespace aisle::sim
