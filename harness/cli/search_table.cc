#include "harness/cli/search_table.h"

#include <set>

#include "harness/score/mask_scores.h"

namespace aisle {
namespace {

std::string Cell(const Score& score) {
  return score.value ? fmt::format("{:.3f}", *score.value) : "-";
}

std::string Share(const ObjectCount& count) {
  return count.asked == 0 ? "-"
                          : fmt::format("{:.3f}", static_cast<double>(count.counted) / count.asked);
}

std::string Row(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

std::string Heading(const std::vector<std::string>& cells) {
  std::string rule = "|";
  for (std::size_t i = 0; i < cells.size(); ++i) rule += "---|";
  return Row(cells) + rule + "\n";
}

const std::vector<std::string> kFigures = {"frames", "prec.",  "recall",  "F1",      "box IoU",
                                           "px IoU", "static", "large R", "across R"};

std::vector<std::string> Figures(const DetectorOutcome& outcome) {
  const Detection objects = ObjectDetection(outcome.masks);
  return {fmt::format("{}", outcome.frames),
          Cell(objects.precision),
          Cell(objects.recall),
          fmt::format("{:.3f}", outcome.object_f1()),
          Cell(objects.iou),
          fmt::format("{:.3f}", outcome.pixel_iou()),
          fmt::format("{:.2f} %", 100 * outcome.static_wrong()),
          fmt::format("{} of {}", Share(outcome.large), outcome.large.asked),
          fmt::format("{} of {}", Share(outcome.large_across), outcome.large_across.asked)};
}

template <class... Parts>
std::vector<std::string> Joined(std::vector<std::string> first, const Parts&... parts) {
  (first.insert(first.end(), parts.begin(), parts.end()), ...);
  return first;
}

std::string ValueIn(const OptionSet& set, const std::string& path, const OptionSet& own) {
  if (const auto found = set.find(path); found != set.end()) return found->second;
  const auto as_it_is = own.find(path);
  return as_it_is == own.end() ? "-" : as_it_is->second;
}

std::string Constants(const SearchReport& report) {
  std::vector<std::string> heading = {"constant", "searched"};
  for (const JudgedSet& set : report.judged) heading.push_back(set.name);
  std::string table = Heading(heading);
  for (const SearchAxis& axis : report.axes) {
    std::vector<std::string> row = {
        "`" + axis.path + "`",
        fmt::format("{:g} to {:g}{}", axis.low, axis.high, axis.even_ratios ? ", by ratio" : "")};
    for (const JudgedSet& set : report.judged) {
      row.push_back(ValueIn(set.options, axis.path, report.own));
    }
    table += Row(row);
  }
  return table;
}

std::string Judged(const std::vector<JudgedSet>& sets) {
  std::string table = Heading(Joined({"set"}, kFigures, std::vector<std::string>{"time"}));
  for (const JudgedSet& set : sets) {
    table += Row(Joined({set.name}, Figures(set.all),
                        std::vector<std::string>{fmt::format("{:.2f} x", set.time_ratio)}));
  }
  return table;
}

std::string ByScene(const std::vector<JudgedSet>& sets) {
  std::set<std::string> scenes;
  for (const JudgedSet& set : sets) {
    for (const auto& [scene, outcome] : set.by_scene) scenes.insert(scene);
  }
  std::string table = Heading(Joined({"scene", "set"}, kFigures));
  for (const std::string& scene : scenes) {
    for (const JudgedSet& set : sets) {
      const auto found = set.by_scene.find(scene);
      if (found == set.by_scene.end()) continue;
      table += Row(Joined({scene, set.name}, Figures(found->second)));
    }
  }
  return table;
}

int CountIn(const std::map<std::string, int>& losses, const std::string& step) {
  const auto found = losses.find(step);
  return found == losses.end() ? 0 : found->second;
}

/// Steps in the order in which the method takes them.
std::string Losses(const std::vector<JudgedSet>& sets) {
  const std::vector<std::string> steps = {
      "found",         "few points", "no disparity",      "along its line",    "wrong lines",
      "not one group", "no outline", "outline too small", "outline too large", "in parts"};
  std::vector<std::string> heading = {"large movers"};
  for (const JudgedSet& set : sets) {
    heading.push_back(set.name + ", along");
    heading.push_back(set.name + ", across");
  }
  std::string table = Heading(heading);
  for (const std::string& step : steps) {
    std::vector<std::string> row = {step};
    for (const JudgedSet& set : sets) {
      row.push_back(fmt::format("{}", CountIn(set.all.losses_along, step)));
      row.push_back(fmt::format("{}", CountIn(set.all.losses_across, step)));
    }
    table += Row(row);
  }
  return table;
}

std::string Training(const SearchReport& report) {
  if (report.trials.size() < 2) return {};
  int given_up = 0;
  for (const Trial& trial : report.trials) given_up += trial.given_up;
  const std::string limit = fmt::format("at most {:g} times the tracking", report.time_limit);
  const std::string outcome =
      report.found
          ? fmt::format("Found: the best whose detector takes {}.", limit)
          : fmt::format("None was found: none of the best sets has a detector that takes {}.",
                        limit);
  return fmt::format(
      "{} sets of options of `{}` were tried on the training stretches, {} of them abandoned half "
      "way. A set's score is the mean of the objects' F1 and the pixel IoU. {}\n\n",
      report.trials.size(), report.system, given_up, outcome);
}

}  // namespace

std::optional<std::size_t> FirstInTime(const std::vector<double>& ratios, double limit) {
  const auto first = std::ranges::find_if(ratios, [&](double ratio) { return ratio <= limit; });
  if (first == ratios.end()) return std::nullopt;
  return static_cast<std::size_t>(first - ratios.begin());
}

std::string TrialHeading() {
  return fmt::format("{:>5}{:>8}{:>8}{:>8}{:>9}{:>9}{:>9}{:>9}", "set", "score", "F1", "px IoU",
                     "large R", "across R", "static", "ms");
}

std::string TrialLine(const Trial& trial) {
  const DetectorOutcome& o = trial.outcome;
  return fmt::format("{:>5}{:>8.3f}{:>8.3f}{:>8.3f}{:>9}{:>9}{:>7.2f} %{:>9.1f}{}", trial.index,
                     trial.score(), o.object_f1(), o.pixel_iou(), Share(o.large),
                     Share(o.large_across), 100 * o.static_wrong(), o.mean_ms(),
                     trial.given_up ? "  abandoned" : "");
}

std::string ToMarkdown(const SearchReport& report) {
  std::string text = fmt::format(
      "{}{}\nOn the judging stretches:\n\n{}\nBy scene:\n\n{}\nWhere the large movers of the "
      "judging stretches were lost:\n\n{}",
      Training(report), Constants(report), Judged(report.judged), ByScene(report.judged),
      Losses(report.judged));
  if (!report.frontier.empty()) {
    text += fmt::format(
        "\nSets on the training stretches' frontier of large recall, static loss and time, as "
        "judged:\n\n{}",
        Judged(report.frontier));
  }
  return text;
}

}  // namespace aisle
