#include "harness/systems/traits.h"

#include <algorithm>

namespace aisle {
namespace {

/// The built-in system that it is or varies; null for any other.
const System* DefinitionOf(const SystemSpec& spec) {
  const auto at = std::ranges::find(Systems(), spec.like, &System::name);
  return spec.external || at == Systems().end() ? nullptr : &*at;
}

std::string ValueOr(const std::map<std::string, std::string>& options, const std::string& path,
                    const std::string& otherwise) {
  const auto at = options.find(path);
  return at == options.end() ? otherwise : at->second;
}

}  // namespace

SystemTraits TraitsOf(const System& system) {
  return {.base = ValueOr(system.options, "base", "plain"),
          .masks = system.mask_source,
          .method = ValueOr(system.options, "dynamic.method", "none")};
}

SystemTraits TraitsOf(const SystemSpec& spec) {
  const System* like = DefinitionOf(spec);
  return like == nullptr ? SystemTraits{} : TraitsOf(Varied(*like, spec.options));
}

std::map<std::string, std::string> OptionsOver(const SystemSpec& spec) {
  const System* like = DefinitionOf(spec);
  return like == nullptr ? spec.options : Varied(*like, spec.options).options;
}

std::string CheckSpec(const SystemSpec& spec) {
  if (spec.name.empty()) return "a system needs a name";
  if (spec.external && !spec.like.empty()) {
    return "give either 'like' with a built-in system or 'command', not both";
  }
  if (!spec.external && spec.like.empty()) {
    return "it needs 'command', or 'like' with a built-in system";
  }
  if (spec.external && !spec.options.empty()) {
    return "'options' are for built-in systems; write those of a command into the command";
  }
  if (spec.mask_errors != MaskErrors{} && !TraitsOf(spec).ReceivesMasks()) {
    return "'mask_errors' are for a system like oracle or semantic, which are told their masks";
  }
  return spec.mask_errors.Validate();
}

}  // namespace aisle
