#include "harness/judge/gate.h"

#include "harness/judge/missing.h"

namespace aisle {
namespace {

Verdict OfMissing(const MissingRuns& missing) {
  return {.name = fmt::format("{} {} {}: baseline", missing.scene, missing.twin, missing.system),
          .passed = false,
          .flaky = false,
          .value = {},
          .limit = {},
          .why = missing.is_whole
                     ? "the baseline has this, but the new run does not"
                     : fmt::format("the baseline has seeds {}, which the new run does not have",
                                   fmt::join(missing.seeds, ", ")),
          .scene = missing.scene,
          .twin = missing.twin,
          .system = missing.system};
}

/// Scenes and systems that are new since the baseline: nothing fails, and nothing is judged.
std::optional<Verdict> WithoutBaseline(const Results& baseline, const Results& night) {
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> names;
  std::size_t cells = 0;
  for (const MissingRuns& added : MissingRunsOf(night, baseline)) {
    if (!added.is_whole) continue;
    if (++cells > kNamed) continue;
    names.push_back(fmt::format("{} {} {}", added.scene, added.twin, added.system));
  }
  if (cells == 0) return std::nullopt;
  return Verdict{
      .name = kWithoutBaseline,
      .passed = true,
      .flaky = false,
      .value = {},
      .limit = {},
      .why = fmt::format("{} cell{} no baseline and {} held against nothing: {}{}", cells,
                         cells == 1 ? " has" : "s have", cells == 1 ? "is" : "are",
                         fmt::join(names, ", "), cells > kNamed ? ", …" : "")};
}

/// Of a system over all its cells; it is about no scene alone.
Verdict OfSystem(const Comparison& c) {
  return {.name = fmt::format("{}: {} against the baseline", NameOfCell(c), c.score),
          .passed = !IsAlarm(c.change),
          .flaky = false,
          .value = {},
          .limit = {},
          .why = fmt::format("{}: {}", Name(c.change), c.why),
          .system = c.system};
}

Verdict OfScore(const Comparison& c) {
  const std::string unit = c.unit == "1" ? "" : " " + c.unit;
  const std::string now = c.new_n > 0 ? fmt::format("{:.4g}", c.new_median) : "nothing";
  return {.name = fmt::format("{}: {} against the baseline", NameOfCell(c), c.score),
          .passed = !IsAlarm(c.change),
          .flaky = false,
          .value = c.new_n > 0 ? std::optional(c.new_median) : std::nullopt,
          .limit = c.old_median,
          .why = fmt::format("{}: {} was {:.4g}{} ({})", Name(c.change), now, c.old_median, unit,
                             c.why),
          .scene = c.scene,
          .twin = c.twin,
          .system = c.system};
}

/// "seeds 2, 3", or what stands for many.
std::string SeedsInWords(const std::vector<std::uint64_t>& seeds) {
  constexpr std::size_t kNamed = 8;
  const auto named = std::span(seeds).first(std::min(kNamed, seeds.size()));
  return fmt::format("seed{} {}{}", seeds.size() == 1 ? "" : "s", fmt::join(named, ", "),
                     named.size() < seeds.size() ? ", …" : "");
}

/// The option that drives every seed of the results.
std::string SeedsOption(const Results& results) {
  std::set<std::uint64_t> seeds;
  for (const auto& [cell, of_cell] : SeedsByCell(results)) {
    seeds.insert(of_cell.begin(), of_cell.end());
  }
  const bool from_one = *seeds.begin() == 1 && *seeds.rbegin() == seeds.size();
  return from_one ? fmt::format("--seeds {}", seeds.size())
                  : fmt::format("--seed {}", fmt::join(seeds, ","));
}

}  // namespace

std::string BoundToFail(const Results& baseline, const std::vector<RunSpec>& night) {
  constexpr std::size_t kNamed = 4;
  Results planned;
  for (const RunSpec& spec : night) planned.runs.emplace_back().spec = spec;
  const std::vector<MissingRuns> missing = MissingRunsOf(baseline, planned);
  if (missing.empty()) return {};
  std::vector<std::string> names;
  for (const MissingRuns& one : missing) {
    if (names.size() == kNamed) break;
    names.push_back(fmt::format("{} {} {}{}", one.scene, one.twin, one.system,
                                one.is_whole ? "" : ", " + SeedsInWords(one.seeds)));
  }
  const bool seeds_alone = std::ranges::none_of(missing, &MissingRuns::is_whole);
  return fmt::format(
      "of the baseline {} tonight, so the gate could only fail: {}{}. {}, or make another baseline "
      "of such a night with `aisle baseline DIR`",
      InWords(missing), fmt::join(names, "; "), names.size() < missing.size() ? "; …" : "",
      seeds_alone ? "Run them with " + SeedsOption(baseline)
                  : "Leave out what takes scenes, twins, systems or seeds from the suite");
}

std::vector<Verdict> GateVerdicts(const Results& baseline, const Results& night,
                                  const CompareOptions& options) {
  std::vector<Verdict> verdicts;
  for (const MissingRuns& missing : MissingRunsOf(baseline, night)) {
    verdicts.push_back(OfMissing(missing));
  }
  if (const auto added = WithoutBaseline(baseline, night)) verdicts.push_back(*added);
  for (const Comparison& c : Compare(baseline, night, options)) {
    if (c.change == Change::kWatched) continue;
    verdicts.push_back(c.cells > 0 ? OfSystem(c) : OfScore(c));
  }
  return verdicts;
}

std::string BlindFor(const Results& baseline) {
  const auto cells = SeedsByCell(baseline);
  const auto few = [](const auto& cell) { return cell.second.size() < kFewestSeeds; };
  const auto count = std::count_if(cells.begin(), cells.end(), few);
  if (count == 0) return {};
  return fmt::format(
      "{} of {} cells of the baseline have fewer than {} seeds, too few to tell a change of a "
      "median from chance",
      count, cells.size(), kFewestSeeds);
}

}  // namespace aisle
