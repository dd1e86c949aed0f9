#include "harness/suite/plan.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "harness/io/input_error.h"
#include "harness/io/json_numbers.h"
#include "harness/io/json_text.h"
#include "harness/io/system_spec_json.h"
#include "harness/record/record.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 2;

Json ToJson(const Limit& limit) {
  Json json = {{"score", limit.score},   {"scene", limit.scene},     {"twin", limit.twin},
               {"system", limit.system}, {"min", OrNull(limit.min)}, {"max", OrNull(limit.max)}};
  if (limit.share) json["share"] = *limit.share;
  return json;
}

Limit LimitFromJson(const Json& json) {
  return {.score = json.at("score").get<std::string>(),
          .scene = json.at("scene").get<std::string>(),
          .twin = json.at("twin").get<std::string>(),
          .system = json.at("system").get<std::string>(),
          .min = NumberOrNull(json.at("min")),
          .max = NumberOrNull(json.at("max")),
          .share = json.contains("share") ? NumberOrNull(json.at("share")) : std::nullopt};
}

Json ToJson(const Suite& suite) {
  Json json = {{"suite", suite.name}, {"question", suite.question}};
  json["scenes"] = Json::array();
  for (const SuiteScene& scene : suite.scenes) {
    json["scenes"].push_back({{"name", scene.name}, {"file", scene.file}});
    if (scene.recorded) json["scenes"].back()["recorded"] = true;
  }
  json["systems"] = Json::array();
  for (const SystemSpec& system : suite.systems) json["systems"].push_back(ToJson(system));
  json["twins"] = suite.twins;
  json["seeds"] = suite.seeds;
  json["limits"] = Json::array();
  for (const Limit& limit : suite.limits) json["limits"].push_back(ToJson(limit));
  return json;
}

Suite SuiteFromJson(const Json& json) {
  Suite suite;
  suite.name = json.at("suite").get<std::string>();
  suite.question = json.at("question").get<std::string>();
  for (const Json& scene : json.at("scenes")) {
    suite.scenes.push_back({scene.at("name").get<std::string>(),
                            scene.at("file").get<std::string>(), scene.value("recorded", false)});
  }
  for (const Json& system : json.at("systems")) {
    suite.systems.push_back(SystemSpecFromJson(system));
  }
  suite.twins = json.at("twins").get<std::vector<std::string>>();
  suite.seeds = json.at("seeds").get<std::vector<std::uint64_t>>();
  for (const Json& limit : json.at("limits")) suite.limits.push_back(LimitFromJson(limit));
  return suite;
}

PlanFile FromJson(const Json& json) {
  if (json.at("schema") != kSchema) {
    throw std::invalid_argument(
        fmt::format("schema is not {}: the folder was made by another version of aisle", kSchema));
  }
  PlanFile plan;
  plan.command = json.at("command").get<std::string>();
  plan.suite_file = json.value("suite_file", "");
  plan.gate = json.value("gate", false);
  plan.trial = json.value("trial", false);
  plan.started = json.value("started", "");
  plan.inputs = json.value("inputs", plan.inputs);
  plan.scenes = json.value("scenes", plan.scenes);
  for (const Json& suite : json.at("suites")) plan.suites.push_back(SuiteFromJson(suite));
  return plan;
}

template <class Part>
std::string Joined(const std::vector<Suite>& suites, const char* between, Part Suite::*part) {
  std::string joined;
  for (const Suite& suite : suites) joined += (joined.empty() ? "" : between) + suite.*part;
  return joined;
}

}  // namespace

std::string PlanFile::name() const { return Joined(suites, "+", &Suite::name); }

std::string PlanFile::question() const {
  std::vector<std::string> bare_scenes;
  for (const Suite& suite : suites) {
    if (suite.scenes.size() != 1) break;
    if (suite.question != QuestionOfScenes({suite.scenes[0].name})) break;
    bare_scenes.push_back(suite.scenes[0].name);
  }
  if (bare_scenes.size() == suites.size()) return QuestionOfScenes(bare_scenes);
  return Joined(suites, " ", &Suite::question);
}

std::string ToJson(const PlanFile& plan) {
  Json json = {{"schema", kSchema}, {"command", plan.command}};
  if (!plan.suite_file.empty()) json["suite_file"] = plan.suite_file;
  if (plan.gate) json["gate"] = true;
  if (plan.trial) json["trial"] = true;
  if (!plan.started.empty()) json["started"] = plan.started;
  json["suites"] = Json::array();
  for (const Suite& suite : plan.suites) json["suites"].push_back(ToJson(suite));
  if (!plan.inputs.empty()) json["inputs"] = plan.inputs;
  if (!plan.scenes.empty()) json["scenes"] = plan.scenes;
  return Dump(json);
}

PlanFile PlanFromJson(const std::string& text, const std::string& file) {
  try {
    return FromJson(ParseJson(text));
  } catch (const std::exception& error) {
    throw InputError(file, 0, "not a plan: " + Printable(error.what(), 200));
  }
}

bool SameQuestion(const PlanFile& a, const PlanFile& b) {
  const auto question = [](PlanFile plan) {
    plan.started.clear();
    plan.inputs.clear();
    plan.scenes.clear();
    return ToJson(plan);
  };
  return question(a) == question(b);
}

std::optional<std::string> ChangedScene(const PlanFile& a, const PlanFile& b) {
  for (const auto& [scene, hash] : a.scenes) {
    const auto at = b.scenes.find(scene);
    if (at != b.scenes.end() && at->second != hash) return scene;
  }
  return std::nullopt;
}

PlanFile Resumed(const PlanFile& plan, const PlanFile& before,
                 const std::function<std::string(const RunSpec&)>& inputs_of) {
  std::map<std::string, std::string> kept;
  for (const RunSpec& spec : Plan(plan.suites)) {
    const auto at = before.inputs.find(RunId(spec));
    if (at == before.inputs.end()) continue;
    if (at->second != inputs_of(spec)) return plan;
    kept.insert(*at);
  }
  if (kept.empty() || before.started.empty()) return plan;
  PlanFile resumed = plan;
  resumed.started = before.started;
  resumed.inputs.merge(kept);
  return resumed;
}

Shard ShardFromText(const std::string& text) {
  Shard shard;
  const char *begin = text.data(), *end = begin + text.size();
  const auto index = std::from_chars(begin, end, shard.index);
  const bool slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  if (!slash || count.ec != std::errc() || count.ptr != end || shard.index < 1 ||
      shard.index > shard.count) {
    throw InputError(fmt::format(
        "--shard: expected I/N with 1 <= I <= N, for example 2/3, got '{}'", Printable(text)));
  }
  return shard;
}

std::vector<RunSpec> TakeShard(const std::vector<RunSpec>& specs, const Shard& shard) {
  std::vector<RunSpec> taken;
  std::map<std::tuple<std::string, std::string, std::uint64_t>, std::size_t> numbers;
  for (const RunSpec& spec : specs) {
    const std::tuple group{spec.scene, spec.twin, spec.seed};
    const std::size_t number = numbers.emplace(group, numbers.size()).first->second;
    if (number % shard.count == shard.index - 1) taken.push_back(spec);
  }
  return taken;
}

}  // namespace aisle
