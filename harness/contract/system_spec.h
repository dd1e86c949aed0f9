#pragma once

#include <map>
#include <optional>
#include <string>

#include "harness/contract/external.h"
#include "harness/contract/mask_errors.h"

namespace aisle {

/// What is under test: one of our systems, a variant of one, or any other SLAM behind a command.
///
///   robust                                          our own, as it is
///   {name: robust_fast, like: robust,               a variant by options
///    options: {feature.features: 800}}
///   {name: network, like: semantic,                 one that is told its masks, told them badly
///    mask_errors: {boundary_px: 3}}
///   {name: mine, command: my_slam {dataset} {output}}   a foreign one
///
/// A plain value: it is compared, written into job.json and results.json, and hashed into the
/// fingerprint of a run. Whether `like` and `options` exist is known to Systems() alone.
struct SystemSpec {
  std::string name;  ///< as suites, results and reports call it; unique within a suite
  /// The built-in system that it is (then equal to `name`) or varies; empty for a foreign one.
  std::string like = {};
  /// Options that differ from those of `like`, by their path ("feature.features"), as text.
  std::map<std::string, std::string> options = {};
  /// How the masks are spoilt that `like` is handed; of `oracle` and `semantic` alone.
  MaskErrors mask_errors = {};
  std::optional<ExternalSystem> external = {};  ///< the command, where it is a foreign system

  bool operator==(const SystemSpec&) const = default;
};

/// The option of a system that is handed what the vehicle's wheels measure, beside its images:
/// "true" or "false". Others may have it as well: over the stream, or in a file of the dataset.
inline constexpr const char* kOdometryOption = "odometry";

/// A built-in system as it is.
inline SystemSpec BuiltIn(const std::string& name) { return {.name = name, .like = name}; }

/// Whose decisions one of our systems tracks and maps by: "orbslam2" or "plain"; empty for a
/// foreign one. The published systems stand on the published base, our own on ours.
inline std::string BaseOf(const SystemSpec& spec) {
  if (spec.external) return "";
  if (const auto base = spec.options.find("base"); base != spec.options.end()) return base->second;
  const bool published = spec.like == "orbslam2" || spec.like == "semantic" || spec.like == "paper";
  return published ? "orbslam2" : "plain";
}

/// Whether it is told its masks by truth of what moves, which a recording has not.
inline bool IsToldMasks(const SystemSpec& spec) {
  return spec.like == "oracle" || spec.like == "semantic";
}

/// Why the parts of a spec do not fit together, or an empty string.
inline std::string Validate(const SystemSpec& spec) {
  if (spec.name.empty()) return "a system needs a name";
  if (spec.external && !spec.like.empty()) {
    return "it is either 'like' one of ours or a 'command', not both";
  }
  if (!spec.external && spec.like.empty()) {
    return "it needs a 'command', or 'like' with one of our systems";
  }
  if (spec.external && !spec.options.empty()) {
    return "'options' are those of our systems: a command takes its own in its words";
  }
  if (spec.mask_errors != MaskErrors{} && !IsToldMasks(spec)) {
    return "'mask_errors' are for a system like oracle or semantic, which are told their masks";
  }
  return spec.mask_errors.Validate();
}

}  // namespace aisle
