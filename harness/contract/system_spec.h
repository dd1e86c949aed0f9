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
/// fingerprint of a run. Whether `like` and `options` exist, and what follows from them, is known
/// to harness/systems alone (Systems, TraitsOf, CheckSpec).
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

}  // namespace aisle
