#include "harness/judge/bits.h"

namespace aisle {

std::vector<std::string> DifferentBits(const RunRecord& a, const RunRecord& b) {
  std::vector<std::string> lines;
  const auto compare = [&](const std::string& what, const std::string& x, const std::string& y) {
    if (x != y) lines.push_back(fmt::format("{}: {} and {}", what, x, y));
  };
  compare("status", Name(a.status), Name(b.status));
  compare("content hash", a.content_hash, b.content_hash);
  compare("trajectories", a.output_hash, b.output_hash);
  for (const auto& [name, score] : a.scores) {
    if (name.starts_with("ms_") || name == "peak_rss_mib") continue;
    const auto other = b.scores.find(name);
    if (other == b.scores.end()) {
      // Penalties are ratios to a twin's run: a run on its own has none.
      if (name != "dynamic_penalty") lines.push_back(name + ": missing in one");
    } else if (score.value != other->second.value) {
      lines.push_back(fmt::format("{}: {} and {}", name, ToText(score), ToText(other->second)));
    }
  }
  return lines;
}

}  // namespace aisle
