#include "harness/io/system_spec_json.h"

#include <nlohmann/json.hpp>

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const MaskErrors& errors) {
  return {{"boundary_px", errors.boundary_px},
          {"miss_below_px", errors.miss_below_px},
          {"miss_share", errors.miss_share},
          {"latency_frames", errors.latency_frames}};
}

MaskErrors MaskErrorsFromJson(const Json& json) {
  return {.boundary_px = json.at("boundary_px").get<double>(),
          .miss_below_px = json.at("miss_below_px").get<int>(),
          .miss_share = json.at("miss_share").get<double>(),
          .latency_frames = json.at("latency_frames").get<int>()};
}

constexpr const char* kStyles[] = {"", "vslam-lab", "vslam-lab-python"};

VslamLabStyle StyleFromName(const std::string& name) {
  for (int k = 0; k < 3; ++k) {
    if (name == kStyles[k]) return static_cast<VslamLabStyle>(k);
  }
  throw std::invalid_argument("unknown contract '" + name + "'");
}

Json ToJson(const ExternalSystem& external) {
  Json json = {{"command", external.command},
               {"dataset", external.dataset},
               {"trajectory", external.trajectory},
               {"contract", kStyles[static_cast<std::size_t>(external.vslam_lab)]},
               {"timeout_s", external.timeout_s},
               {"may_write", external.may_write},
               {"environment", external.environment},
               {"depends_on", external.depends_on}};
  if (!external.version.empty()) json["version"] = external.version;
  if (!external.repository.empty()) json["repository"] = external.repository;
  if (!external.build.empty()) json["build"] = external.build;
  if (external.repeats > 1) json["repeats"] = external.repeats;
  return json;
}

ExternalSystem ExternalFromJson(const Json& json) {
  return {.command = json.at("command").get<std::string>(),
          .dataset = json.at("dataset").get<std::string>(),
          .trajectory = json.at("trajectory").get<std::string>(),
          .vslam_lab = StyleFromName(json.at("contract").get<std::string>()),
          .timeout_s = json.at("timeout_s").get<double>(),
          .version = json.value("version", ""),
          .repository = json.value("repository", ""),
          .build = json.value("build", ""),
          .repeats = json.value("repeats", 1),
          .may_write = json.at("may_write").get<std::vector<std::string>>(),
          .environment = json.at("environment").get<std::vector<std::string>>(),
          .depends_on = json.at("depends_on").get<std::vector<std::string>>()};
}

}  // namespace

Json ToJson(const SystemSpec& spec) {
  Json json = {{"name", spec.name}};
  if (!spec.like.empty()) json["like"] = spec.like;
  if (!spec.options.empty()) json["options"] = spec.options;
  if (spec.mask_errors != MaskErrors{}) json["mask_errors"] = ToJson(spec.mask_errors);
  if (spec.external) json["external"] = ToJson(*spec.external);
  return json;
}

SystemSpec SystemSpecFromJson(const Json& json) {
  SystemSpec spec;
  spec.name = json.at("name").get<std::string>();
  spec.like = json.value("like", "");
  if (json.contains("options")) {
    spec.options = json.at("options").get<std::map<std::string, std::string>>();
  }
  if (json.contains("mask_errors")) spec.mask_errors = MaskErrorsFromJson(json.at("mask_errors"));
  if (json.contains("external")) spec.external = ExternalFromJson(json.at("external"));
  return spec;
}

}  // namespace aisle
