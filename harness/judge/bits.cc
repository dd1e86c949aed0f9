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
  std::map<std::string, std::array<const Score*, 2>> scores;
  for (const auto& [name, score] : a.scores) scores[name][0] = &score;
  for (const auto& [name, score] : b.scores) scores[name][1] = &score;
  for (const auto& [name, both] : scores) {
    if (name.starts_with("ms_") || name == "peak_rss_mib") continue;
    if (both[0] == nullptr || both[1] == nullptr) {
      // Penalties are ratios to a twin's run: a run on its own has none.
      if (name == "dynamic_penalty") continue;
      lines.push_back(
          fmt::format("{}: missing in the {}", name, both[0] == nullptr ? "first" : "second"));
    } else if (both[0]->value != both[1]->value) {
      lines.push_back(fmt::format("{}: {} and {}", name, ToText(*both[0]), ToText(*both[1])));
    }
  }
  return lines;
}

}  // namespace aisle
