#pragma once

#include <map>
#include <string>

#include "harness/contract/estimator.h"
#include "harness/contract/system_spec.h"
#include "harness/systems/built_in.h"

namespace aisle {

/// What decides how a system counts in plans, verdicts and reports. Of a foreign system, and of one
/// that Systems() does not list (in results of another version), nothing is known: all is empty.
struct SystemTraits {
  /// Whose decisions it tracks and maps by, as the option `base` names them: "plain" or "orbslam2".
  std::string base;
  MaskSource masks = MaskSource::kNone;  ///< what truth it is handed
  /// How it finds movers itself, as the option `dynamic.method` names it: "none", "paper" or
  /// "robust".
  std::string method;

  bool IsKnown() const { return !base.empty(); }
  /// Whether it is handed masks by truth of what moves, which a recording has not.
  bool ReceivesMasks() const { return masks != MaskSource::kNone; }
  /// Whether it leaves movers out, by a method of its own or by masks.
  bool Rejects() const { return IsKnown() && (ReceivesMasks() || method != "none"); }

  bool operator==(const SystemTraits&) const = default;
};

/// Resolved from its masks and options.
SystemTraits TraitsOf(const System& system);

/// Resolved from the system's definition and the options of the spec over it.
SystemTraits TraitsOf(const SystemSpec& spec);

/// The options of the spec over those of the system's definition, if Systems() lists it.
std::map<std::string, std::string> OptionsOver(const SystemSpec& spec);

/// Why the parts of a spec do not fit together, or an empty string.
std::string CheckSpec(const SystemSpec& spec);

}  // namespace aisle
