#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace aisle::sim {

enum class ModelFormat { kGlb, kGltf, kObj, kCollada };

/// The format that a file's bytes are in, whatever it is named: the magic of a .glb, the brace of a
/// .gltf's JSON, the root element of COLLADA, or the grammar of OBJ. Throws ImportError when it is
/// none of them, or another than the extension of `file` says; names both and what would help.
ModelFormat FormatOf(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& file);

}  // namespace aisle::sim
