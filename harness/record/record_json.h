#pragma once

#include <nlohmann/json.hpp>

#include "harness/record/record.h"

namespace aisle {

/// The entry of a run as results.json has it. Not a number is null with its reason, never 0.
nlohmann::ordered_json RecordToJson(const RunRecord& record);
/// Throws nlohmann's exceptions when a field is missing or of the wrong kind.
RunRecord RecordFromJson(const nlohmann::ordered_json& json);

/// Text that cannot break the report, whatever bytes a name holds.
std::string Dump(const nlohmann::ordered_json& json);

}  // namespace aisle
