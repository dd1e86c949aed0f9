#include "harness/report/paper/base_table.h"

#include "harness/contract/twin.h"
#include "harness/record/seed_values.h"
#include "harness/report/paper/spread.h"
#include "harness/score/statistics.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

/// What a system rejects, as the table calls it; empty for one that has no place there.
std::string RejectionOf(const SystemSpec& spec) {
  std::map<std::string, std::string> others = OptionsOver(spec);
  others.erase("base");
  others.erase("dynamic.method");
  const SystemTraits traits = TraitsOf(spec);
  if (!traits.IsKnown() || !others.empty() || spec.mask_errors != MaskErrors{}) return "";
  if (!traits.Rejects()) return "nothing";
  if (!traits.ReceivesMasks()) return traits.method;
  if (traits.method != "none") return "";  // by both
  return traits.masks == MaskSource::kDynamic ? "oracle" : "semantic";
}

/// Runs of one scene by rejection and base.
using Cells = std::map<std::pair<std::string, std::string>, std::vector<const RunRecord*>>;

Cells CellsOf(const SceneRuns& scene) {
  Cells cells;
  for (const SystemRuns& system : scene.systems) {
    const SystemSpec& spec = system.runs.front()->spec.system;
    // Of two systems that are the same the first stands for both.
    const std::string rejection = RejectionOf(spec);
    if (!rejection.empty()) cells.try_emplace({rejection, TraitsOf(spec).base}, system.runs);
  }
  return cells;
}

std::vector<double> Errors(const std::vector<const RunRecord*>& runs) {
  constexpr const char* kScore = "ate_rmse_m";
  return AllHave(runs, kScore) ? ScoresOf(runs, kScore) : std::vector<double>{};
}

std::string ErrorText(double error_m) { return fmt::format("{:.4f}", error_m); }

std::string MedianText(const std::vector<double>& errors) {
  return ErrorText(Quantile(errors, 0.5));
}

/// Rejections in the order of their first run, bases by name.
struct Head {
  std::vector<std::string> rejections, bases;
  bool compares = false;  ///< some rejection stands on two bases
};

Head HeadOf(const std::vector<SceneRuns>& scenes) {
  Head head;
  const auto add = [](const std::string& name, std::vector<std::string>* names) {
    if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
  };
  for (const SceneRuns& scene : scenes) {
    if (scene.twin != twin::kLive) continue;
    for (const SystemRuns& system : scene.systems) {
      const SystemSpec& spec = system.runs.front()->spec.system;
      if (RejectionOf(spec).empty()) continue;
      add(RejectionOf(spec), &head.rejections);
      add(TraitsOf(spec).base, &head.bases);
    }
    const Cells cells = CellsOf(scene);
    for (const std::string& rejection : head.rejections) {
      head.compares |= std::count_if(head.bases.begin(), head.bases.end(), [&](const auto& base) {
                         return cells.contains({rejection, base});
                       }) > 1;
    }
  }
  std::sort(head.bases.begin(), head.bases.end());
  return head;
}

template <typename TextOf>
std::vector<std::string> Texts(const Head& head, const Cells& cells, const TextOf& text_of) {
  std::vector<std::string> texts;
  for (const std::string& rejection : head.rejections) {
    for (const std::string& base : head.bases) {
      const auto at = cells.find({rejection, base});
      const std::vector<double> errors =
          at == cells.end() ? std::vector<double>{} : Errors(at->second);
      texts.push_back(errors.empty() ? "-" : text_of(errors));
    }
  }
  return texts;
}

}  // namespace

std::optional<NumberTable> BaseTable(const std::vector<SceneRuns>& scenes) {
  const Head head = HeadOf(scenes);
  if (!head.compares) return std::nullopt;
  NumberTable table{.title = "Absolute trajectory error by rejection and base [m]",
                    .caption =
                        "What is rejected, and on whose tracking and mapping: the published "
                        "ORB-SLAM2's or our own (plain). RMSE of the final track, rigid alignment "
                        "(SE(3)); median over seeds.",
                    .group_head = "rejection",
                    .groups = head.rejections,
                    .columns = head.bases,
                    .unit = "m",
                    .rows = {}};
  for (const SceneRuns& scene : scenes) {
    if (scene.twin != twin::kLive) continue;
    const Cells cells = CellsOf(scene);
    std::size_t seeds = 0;
    for (const auto& [cell, runs] : cells) seeds = std::max(seeds, CountSeeds(runs));
    table.rows.push_back({.name = scene.scene,
                          .scene = scene.scene,
                          .cells = Texts(head, cells, MedianText),
                          .seeds = seeds,
                          .intervals = {}});
    if (seeds < 2) continue;
    table.rows.back().intervals = Texts(head, cells, [](const std::vector<double>& errors) {
      return IntervalText(errors, ErrorText);
    });
    table.rows.push_back({.name = SpreadRowName(seeds, scene.scene),
                          .scene = scene.scene,
                          .cells = Texts(head, cells,
                                         [](const std::vector<double>& errors) {
                                           return SpreadText(errors, ErrorText);
                                         }),
                          .spread = true,
                          .seeds = seeds,
                          .intervals = {}});
  }
  return table;
}

bool IsOnAnotherBase(const SystemSpec& spec) {
  const SystemSpec like = BuiltIn(spec.like);
  return spec.name != spec.like && !RejectionOf(spec).empty() &&
         RejectionOf(spec) == RejectionOf(like) && TraitsOf(spec).base != TraitsOf(like).base;
}

}  // namespace aisle
