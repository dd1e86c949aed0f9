#pragma once

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>

namespace aisle::test {

/// YAML as JSON, for validators of others; scalars that read as JSON values are those.
inline nlohmann::json ToJson(const YAML::Node& node) {
  nlohmann::json json;
  if (node.IsMap()) {
    json = nlohmann::json::object();
    for (const auto& entry : node) json[entry.first.Scalar()] = ToJson(entry.second);
  } else if (node.IsSequence()) {
    json = nlohmann::json::array();
    for (const auto& item : node) json.push_back(ToJson(item));
  } else if (node.IsScalar()) {
    json = nlohmann::json::parse(node.Scalar(), nullptr, false);
    if (json.is_discarded()) json = node.Scalar();
  }
  return json;
}

}  // namespace aisle::test
