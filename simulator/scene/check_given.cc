#include "simulator/scene/check_given.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace aisle::sim {
namespace {

bool Has(const KindKeys& kind, std::string_view key) {
  return std::ranges::find(kind.keys, key) != kind.keys.end();
}

}  // namespace

void CheckGiven(const std::vector<GivenKey>& given, const KindKeys& kind, const std::string& path,
                Issues* issues) {
  for (const GivenKey& key : given) {
    const bool is_told = !key.list.empty() && !Has(kind, key.list);
    if (is_told || Has(kind, key.name)) continue;
    const std::string inner = key.list.empty() ? "" : fmt::format("{}[{}].", key.list, key.index);
    issues->Add(
        key.mark, fmt::format("{}.{}{}", path, inner, key.name),
        kind.keys.empty()
            ? fmt::format("{} has no {}; give its `kind`", kind.kind, key.name)
            : fmt::format("{} has no {}, but {}", kind.kind, key.name, fmt::join(kind.keys, ", ")));
  }
}

}  // namespace aisle::sim
