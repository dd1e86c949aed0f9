#include "harness/record/results.h"

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/json_numbers.h"
#include "harness/io/json_text.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

Json VerdictToJson(const Verdict& verdict) {
  return {{"name", verdict.name},           {"passed", verdict.passed},
          {"flaky", verdict.flaky},         {"value", OrNull(verdict.value)},
          {"limit", OrNull(verdict.limit)}, {"why", verdict.why},
          {"scene", verdict.scene},         {"twin", verdict.twin},
          {"system", verdict.system}};
}

Verdict VerdictFromJson(const Json& json) {
  return {.name = json.at("name").get<std::string>(),
          .passed = json.at("passed").get<bool>(),
          .flaky = json.value("flaky", false),
          .value = NumberOrNull(json.at("value")),
          .limit = NumberOrNull(json.at("limit")),
          .why = json.at("why").get<std::string>(),
          .scene = json.value("scene", ""),
          .twin = json.value("twin", ""),
          .system = json.value("system", "")};
}

Results FromJson(const Json& json) {
  if (json.at("schema") != kSchema) throw std::invalid_argument("schema is not 1");
  Results results;
  results.provenance = {.version = json.at("aisle").at("version").get<std::string>(),
                        .commit = json.at("aisle").at("commit").get<std::string>(),
                        .cpu = json.at("host").at("cpu").get<std::string>(),
                        .os = json.at("host").at("os").get<std::string>(),
                        .threads = json.at("host").at("threads").get<int>()};
  results.suite = json.at("suite").get<std::string>();
  results.question = json.value("question", "");
  results.started = json.at("started").get<std::string>();
  results.rerun = json.value("rerun", "");
  results.suite_file = json.value("suite_file", "");
  results.wall_s = json.at("wall_s").get<double>();
  for (const Json& run : json.at("runs")) {
    try {
      results.runs.push_back(RecordFromJson(run));
    } catch (const std::exception& error) {
      throw std::invalid_argument(fmt::format("run {}: {}", results.runs.size() + 1, error.what()));
    }
  }
  for (const Json& verdict : json.at("verdicts")) {
    results.verdicts.push_back(VerdictFromJson(verdict));
  }
  return results;
}

/// An array with a line for each of its members: nights have thousands of scores, and what changed
/// between two files shows by run.
std::string Lines(const Json& members) {
  std::string text;
  for (const Json& member : members) {
    text += text.empty() ? "\n    " : ",\n    ";
    text += member.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return fmt::format("[{}{}]", text, text.empty() ? "" : "\n  ");
}

}  // namespace

std::string ToJson(const Results& results) {
  const Provenance& from = results.provenance;
  Json json;
  json["schema"] = kSchema;
  json["aisle"] = {{"version", from.version}, {"commit", from.commit}};
  json["host"] = {{"cpu", from.cpu}, {"threads", from.threads}, {"os", from.os}};
  json["suite"] = results.suite;
  json["question"] = results.question;
  json["started"] = results.started;
  json["rerun"] = results.rerun;
  if (!results.suite_file.empty()) json["suite_file"] = results.suite_file;
  json["wall_s"] = results.wall_s;
  Json runs = Json::array(), verdicts = Json::array();
  for (const RunRecord& run : results.runs) runs.push_back(RecordToJson(run));
  for (const Verdict& verdict : results.verdicts) verdicts.push_back(VerdictToJson(verdict));
  std::string text = Dump(json);
  text.erase(text.rfind("\n}"));
  return fmt::format("{},\n  \"runs\": {},\n  \"verdicts\": {}\n}}\n", text, Lines(runs),
                     Lines(verdicts));
}

Results ResultsFromJson(const std::string& text, const std::string& file) {
  try {
    return FromJson(ParseJson(text));
  } catch (const std::exception& error) {
    throw InputError(file, 0, "not a results file: " + Printable(error.what(), 200));
  }
}

Results ReadResults(const std::filesystem::path& report_dir) {
  const std::filesystem::path path = report_dir / "results.json";
  return ResultsFromJson(ReadFile(path), path.string());
}

}  // namespace aisle
