#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace aisle {

/// A file's JSON, keys in the order of the alphabet. An ordered_json that is parsed as such looks
/// through all keys it has for each that comes: 40 000 of them would take seconds. Throws
/// nlohmann's parse_error, and std::invalid_argument where it is nested deeper than any file of
/// ours.
inline nlohmann::ordered_json ParseJson(const std::string& text) {
  constexpr int kMostLevels = 64;  // the copy below goes down by calls
  return nlohmann::ordered_json(nlohmann::json::parse(
      text, [](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
        if (depth > kMostLevels) throw std::invalid_argument("nested deeper than 64 levels");
        return true;
      }));
}

}  // namespace aisle
