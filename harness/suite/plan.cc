#include "harness/suite/plan.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "harness/io/input_error.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

Json ToJson(const ExternalSystem& external) {
  return {{"name", external.name},           {"command", external.command},
          {"dataset", external.dataset},     {"trajectory", external.trajectory},
          {"vslam_lab", external.vslam_lab}, {"timeout_s", external.timeout_s}};
}

ExternalSystem ExternalFromJson(const Json& json) {
  return {.name = json.at("name").get<std::string>(),
          .command = json.at("command").get<std::string>(),
          .dataset = json.at("dataset").get<std::string>(),
          .trajectory = json.at("trajectory").get<std::string>(),
          .vslam_lab = json.at("vslam_lab").get<bool>(),
          .timeout_s = json.at("timeout_s").get<double>()};
}

Json ToJson(const ImperfectSystem& system) {
  return {{"name", system.name},
          {"like", system.like},
          {"boundary_px", system.errors.boundary_px},
          {"miss_below_px", system.errors.miss_below_px},
          {"miss_share", system.errors.miss_share},
          {"latency_frames", system.errors.latency_frames}};
}

ImperfectSystem ImperfectFromJson(const Json& json) {
  return {.name = json.at("name").get<std::string>(),
          .like = json.at("like").get<std::string>(),
          .errors = {.boundary_px = json.at("boundary_px").get<double>(),
                     .miss_below_px = json.at("miss_below_px").get<int>(),
                     .miss_share = json.at("miss_share").get<double>(),
                     .latency_frames = json.at("latency_frames").get<int>()}};
}

Json OrNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::optional<double> NumberOrNull(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

Json ToJson(const Limit& limit) {
  return {{"score", limit.score},   {"scene", limit.scene},     {"twin", limit.twin},
          {"system", limit.system}, {"min", OrNull(limit.min)}, {"max", OrNull(limit.max)}};
}

Limit LimitFromJson(const Json& json) {
  return {.score = json.at("score").get<std::string>(),
          .scene = json.at("scene").get<std::string>(),
          .twin = json.at("twin").get<std::string>(),
          .system = json.at("system").get<std::string>(),
          .min = NumberOrNull(json.at("min")),
          .max = NumberOrNull(json.at("max"))};
}

PlanFile FromJson(const Json& json) {
  if (json.at("schema") != kSchema) throw std::invalid_argument("schema is not 1");
  PlanFile plan;
  plan.command = json.at("command").get<std::string>();
  Suite& suite = plan.suite;
  suite.name = json.at("suite").get<std::string>();
  suite.question = json.at("question").get<std::string>();
  for (const Json& scene : json.at("scenes")) {
    suite.scenes.push_back(
        {scene.at("name").get<std::string>(), scene.at("file").get<std::string>()});
  }
  suite.systems = json.at("systems").get<std::vector<std::string>>();
  for (const Json& external : json.at("externals")) {
    suite.externals[external.at("name").get<std::string>()] = ExternalFromJson(external);
  }
  for (const Json& system : json.at("imperfect")) {
    suite.imperfect[system.at("name").get<std::string>()] = ImperfectFromJson(system);
  }
  suite.twins = json.at("twins").get<std::vector<std::string>>();
  suite.seeds = json.at("seeds").get<std::vector<std::uint64_t>>();
  for (const Json& limit : json.at("limits")) suite.limits.push_back(LimitFromJson(limit));
  return plan;
}

}  // namespace

std::string ToJson(const PlanFile& plan) {
  const Suite& suite = plan.suite;
  Json json;
  json["schema"] = kSchema;
  json["command"] = plan.command;
  json["suite"] = suite.name;
  json["question"] = suite.question;
  json["scenes"] = Json::array();
  for (const SuiteScene& scene : suite.scenes) {
    json["scenes"].push_back({{"name", scene.name}, {"file", scene.file}});
  }
  json["systems"] = suite.systems;
  json["externals"] = Json::array();
  for (const auto& [name, external] : suite.externals) {
    json["externals"].push_back(ToJson(external));
  }
  json["imperfect"] = Json::array();
  for (const auto& [name, system] : suite.imperfect) json["imperfect"].push_back(ToJson(system));
  json["twins"] = suite.twins;
  json["seeds"] = suite.seeds;
  json["limits"] = Json::array();
  for (const Limit& limit : suite.limits) json["limits"].push_back(ToJson(limit));
  return Dump(json);
}

PlanFile PlanFromJson(const std::string& text, const std::string& file) {
  try {
    return FromJson(Json::parse(text));
  } catch (const std::exception& error) {
    throw InputError(file, 0, "is no plan: " + Printable(error.what(), 200));
  }
}

Shard ShardFromText(const std::string& text) {
  Shard shard;
  const char *begin = text.data(), *end = begin + text.size();
  const auto index = std::from_chars(begin, end, shard.index);
  const bool slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  if (!slash || count.ec != std::errc() || count.ptr != end || shard.index < 1 ||
      shard.index > shard.count) {
    throw InputError(
        fmt::format("--shard: '{}' is no part: expected I/N with 1 <= I <= N, for "
                    "example 2/3",
                    Printable(text)));
  }
  return shard;
}

std::vector<RunSpec> TakeShard(const std::vector<RunSpec>& specs, const Shard& shard) {
  std::vector<RunSpec> taken;
  std::vector<std::tuple<std::string, std::string, std::uint64_t>> groups;
  for (const RunSpec& spec : specs) {
    const std::tuple group{spec.scene, spec.twin, spec.seed};
    auto at = std::find(groups.begin(), groups.end(), group);
    if (at == groups.end()) at = groups.insert(groups.end(), group);
    const auto number = static_cast<std::size_t>(at - groups.begin());
    if (number % shard.count == shard.index - 1) taken.push_back(spec);
  }
  return taken;
}

}  // namespace aisle
