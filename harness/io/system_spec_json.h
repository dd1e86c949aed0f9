#pragma once

#include <nlohmann/json_fwd.hpp>

#include "harness/contract/system_spec.h"

namespace aisle {

/// {"name", "like", "options": {path: text}, "mask_errors": {…}, "external": {…}}; what is not set
/// is left out.
nlohmann::ordered_json ToJson(const SystemSpec& spec);

/// The inverse; what ToJson leaves out keeps its default. Throws nlohmann::json::exception, and
/// std::invalid_argument for a contract that is none.
SystemSpec SystemSpecFromJson(const nlohmann::ordered_json& json);

}  // namespace aisle
