#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace aisle {

/// A number for JSON, which has no word for those that are not finite: null for them and for none.
inline nlohmann::ordered_json OrNull(const std::optional<double>& value) {
  using Json = nlohmann::ordered_json;
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

/// The way back: none for null. Throws nlohmann's type_error for anything but a number.
inline std::optional<double> NumberOrNull(const nlohmann::ordered_json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

}  // namespace aisle
