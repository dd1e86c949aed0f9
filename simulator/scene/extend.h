#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "simulator/scene/issues.h"
#include "simulator/scene/yaml_tree.h"

namespace aisle::sim {

/// The key by which a scene names the one it extends: a path from its own folder.
inline constexpr const char* kExtendKey = "extend";

/// The text of a scene file; where there is none, nothing and why in `problem`.
std::optional<std::string> ReadSceneText(const std::filesystem::path& file, std::string* problem);

/// The tree of a scene's text, laid over those of the scenes that it extends. Every file is read
/// and checked as YAML; their names go to `issues`, in whose order marks count them. Nothing where
/// something is wrong, with the mistakes in `issues`.
std::optional<YamlValue> ReadExtended(const std::string& text, Issues* issues);

}  // namespace aisle::sim
