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

Json ToJson(const ExternalSystem& external) {
  return {{"command", external.command},
          {"dataset", external.dataset},
          {"trajectory", external.trajectory},
          {"vslam_lab", external.vslam_lab},
          {"timeout_s", external.timeout_s}};
}

ExternalSystem ExternalFromJson(const Json& json) {
  return {.command = json.at("command").get<std::string>(),
          .dataset = json.at("dataset").get<std::string>(),
          .trajectory = json.at("trajectory").get<std::string>(),
          .vslam_lab = json.at("vslam_lab").get<bool>(),
          .timeout_s = json.at("timeout_s").get<double>()};
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
