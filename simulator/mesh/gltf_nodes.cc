#include "simulator/mesh/gltf_nodes.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

namespace aisle::sim {
namespace {

constexpr int kDeepest = 500;

/// The JSON text of a file: all of a .gltf, the first chunk of a .glb (magic, version, length;
/// chunk length, "JSON").
std::string JsonText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  constexpr std::size_t kHeader = 20;
  if (!bytes.starts_with("glTF") || bytes.size() < kHeader) return bytes;
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  return bytes.substr(kHeader, length);
}

/// Parent of every node, -1 for roots; empty and a message where there is none.
std::vector<int> ParentsOf(const nlohmann::json& nodes, std::string* error) {
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].is_object() || !nodes[i].contains("children")) continue;
    for (const nlohmann::json& child : nodes[i]["children"]) {
      if (!child.is_number_unsigned() || child.get<std::size_t>() >= nodes.size()) {
        *error = fmt::format("node {} names a child that does not exist", i);
        return {};
      }
      int& parent = parents[child.get<std::size_t>()];
      if (parent >= 0) {
        *error = fmt::format("node {} is a child of node {} and of node {}",
                             child.get<std::size_t>(), parent, i);
        return {};
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

}  // namespace

std::string GltfNodeError(const std::filesystem::path& file) {
  const nlohmann::json json = nlohmann::json::parse(JsonText(file), nullptr, false);
  if (!json.is_object() || !json.contains("nodes") || !json["nodes"].is_array()) return "";
  std::string error;
  const std::vector<int> parents = ParentsOf(json["nodes"], &error);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    int above = 0;
    for (int node = parents[i]; node >= 0; node = parents[static_cast<std::size_t>(node)]) {
      if (node == static_cast<int>(i)) return fmt::format("node {} hangs below itself", i);
      if (++above > kDeepest)
        return fmt::format("more than {} nodes hang one below another", kDeepest);
    }
  }
  return error;
}

}  // namespace aisle::sim
