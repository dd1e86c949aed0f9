#include "harness/record/record_json.h"

#include <utility>

#include "harness/io/input_error.h"
#include "harness/io/json_text.h"
#include "harness/io/system_spec_json.h"

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

/// A count; what is none would be made one by the conversions of JSON's library. Throws
/// std::invalid_argument.
template <typename Whole>
Whole WholeNumber(const Json& json, const char* key) {
  const Json& value = json.at(key);
  if (!value.is_number_unsigned() || !std::in_range<Whole>(value.get<std::uint64_t>())) {
    throw std::invalid_argument(
        fmt::format("{} is {}, not a whole number in range", key, value.dump()));
  }
  return static_cast<Whole>(value.get<std::uint64_t>());
}
template <typename Whole>
Whole WholeNumber(const Json& json, const char* key, Whole otherwise) {
  return json.contains(key) ? WholeNumber<Whole>(json, key) : otherwise;
}

Json ScoreToJson(const Score& score) {
  Json json;
  json["value"] = score.value && std::isfinite(*score.value) ? Json(*score.value) : Json(nullptr);
  json["unit"] = score.unit;
  json["n"] = score.n;
  if (!score.alignment.empty()) json["alignment"] = score.alignment;
  if (!score.absent.empty()) json["absent"] = score.absent;
  if (!score.basis.empty()) json["basis"] = score.basis;
  return json;
}

Score ScoreFromJson(const Json& json) {
  Score score;
  if (!json.at("value").is_null()) score.value = json.at("value").get<double>();
  score.unit = json.at("unit").get<std::string>();
  score.n = WholeNumber<std::size_t>(json, "n");
  score.alignment = json.value("alignment", "");
  score.absent = json.value("absent", "");
  score.basis = json.value("basis", "");
  return score;
}

}  // namespace

std::string Name(RunStatus status) {
  switch (status) {
    case RunStatus::kOk:
      return "ok";
    case RunStatus::kLost:
      return "lost";
    case RunStatus::kCrashed:
      return "crashed";
    case RunStatus::kTimeout:
      return "timeout";
    case RunStatus::kInvalid:
      break;
  }
  return "invalid";
}

RunStatus RunStatusFromName(const std::string& name) {
  for (const auto status : {RunStatus::kOk, RunStatus::kLost, RunStatus::kCrashed,
                            RunStatus::kTimeout, RunStatus::kInvalid}) {
    if (Name(status) == name) return status;
  }
  throw std::invalid_argument("run status '" + name + "'");
}

Json RecordToJson(const RunRecord& record) {
  Json json;
  json["id"] = RunId(record.spec);
  json["scene"] = record.spec.scene;
  json["scene_file"] = record.spec.scene_file;
  json["twin"] = record.spec.twin;
  json["system"] = record.spec.system.name;
  json["system_spec"] = ToJson(record.spec.system);
  json["seed"] = record.spec.seed;
  if (record.spec.repeat > 1) json["repeat"] = record.spec.repeat;
  if (!record.hall.empty()) json["hall"] = record.hall;
  json["status"] = Name(record.status);
  json["why"] = record.status_why;
  if (record.limit_s > 0) json["limit_s"] = record.limit_s;
  if (record.limit_mib > 0) json["limit_mib"] = record.limit_mib;
  json["frames"] = record.frames;
  json["rate_hz"] = record.rate_hz;
  json["wall_s"] = record.wall_s;
  json["threads"] = record.threads;
  json["content_hash"] = record.content_hash;
  json["inputs_hash"] = record.inputs_hash;
  json["output_hash"] = record.output_hash;
  if (!record.program.empty()) json["program"] = record.program;
  if (!record.commit.empty()) json["commit"] = record.commit;
  if (!record.cpu.empty()) json["cpu"] = record.cpu;
  if (record.attempts > 1 || record.flaky) json["attempts"] = record.attempts;
  if (record.flaky) json["flaky"] = true;
  if (!record.system_version.empty()) json["system_version"] = record.system_version;
  if (!record.last_words.empty()) json["last_words"] = record.last_words;
  std::map<std::string, Json> scores;
  for (const auto& [name, score] : record.scores) scores[name] = ScoreToJson(score);
  json["scores"] = scores;  // at once: one by one, each would be held against all before it
  json["notes"] = record.notes;
  json["artifacts"] = record.artifacts;
  return json;
}

RunRecord RecordFromJson(const Json& json) {
  RunRecord record;
  record.spec.scene = json.at("scene").get<std::string>();
  record.spec.scene_file = json.value("scene_file", "");
  record.spec.twin = json.at("twin").get<std::string>();
  const std::string system = json.at("system").get<std::string>();
  record.spec.system = json.contains("system_spec")
                           ? SystemSpecFromJson(json.at("system_spec"))
                           : BuiltIn(system);  // a file from before variants
  record.spec.seed = WholeNumber<std::uint64_t>(json, "seed");
  record.spec.repeat = WholeNumber(json, "repeat", 1);
  record.status = RunStatusFromName(json.at("status").get<std::string>());
  record.hall = json.value("hall", "");
  record.status_why = json.value("why", "");
  record.limit_s = json.value("limit_s", 0.0);
  record.limit_mib = json.value("limit_mib", 0.0);
  record.frames = WholeNumber<std::size_t>(json, "frames");
  record.rate_hz = json.value("rate_hz", 0.0);
  record.wall_s = json.value("wall_s", 0.0);
  record.threads = WholeNumber(json, "threads", 0);
  record.content_hash = json.value("content_hash", "");
  record.inputs_hash = json.value("inputs_hash", "");
  record.output_hash = json.value("output_hash", "");
  record.program = json.value("program", "");
  record.commit = json.value("commit", "");
  record.cpu = json.value("cpu", "");
  record.flaky = json.value("flaky", false);
  record.attempts =
      WholeNumber(json, "attempts", record.flaky ? 2 : 1);  // of before: it told flaky alone
  record.system_version = json.value("system_version", "");
  record.last_words = json.value("last_words", "");
  for (const auto& [name, score] : json.at("scores").items()) {
    try {
      record.scores[name] = ScoreFromJson(score);
    } catch (const std::exception& error) {
      throw std::invalid_argument(fmt::format("score {}: {}", name, error.what()));
    }
  }
  record.notes = json.value("notes", std::vector<std::string>{});
  for (const auto& [name, path] : json.at("artifacts").items()) {
    record.artifacts[name] = path.get<std::string>();
  }
  return record;
}

std::string Dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ToJson(const RunRecord& record) { return Dump(RecordToJson(record)); }

RunRecord RecordFromJson(const std::string& text, const std::string& file) {
  try {
    return RecordFromJson(ParseJson(text));
  } catch (const std::exception& error) {
    throw InputError(file, 0, fmt::format("not a run record: {}", Printable(error.what(), 200)));
  }
}

}  // namespace aisle
