#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "simulator/mesh/gltf_value.h"
#include "simulator/mesh/import.h"

namespace aisle::sim {

using Bytes = std::vector<std::uint8_t>;

/// A .gltf or .glb file: its JSON and the bytes of its buffers.
struct GltfDocument {
  nlohmann::json json;
  std::vector<Bytes> buffers;

  GltfValue root() const { return {&json, ""}; }
};

/// Takes a file's bytes apart: the chunks of a .glb or the text of a .gltf (glTF 2.0, 4), and the
/// buffers in it, in data URIs or in files inside the options' root. Throws ImportError, also for
/// another version than 2 and for a required extension that would change the geometry unread.
GltfDocument ParseGltf(const Bytes& file_bytes, const std::filesystem::path& file,
                       const ImportOptions& options);

/// The bytes that bufferViews[index] covers; checked to lie in their buffer.
std::span<const std::uint8_t> ViewBytes(const GltfDocument& document, std::size_t index);

/// The bytes that a "uri" stands for: a data URI's own, or those of a file inside the options'
/// root, unless these want one file alone. `value` holds the uri and is named in errors.
Bytes UriBytes(const GltfValue& value, const std::filesystem::path& file,
               const ImportOptions& options);

}  // namespace aisle::sim
