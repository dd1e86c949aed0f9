#include <nlohmann/json.hpp>

#include "harness/bench/search.h"
#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/page_block.h"
#include "harness/cli/search_axes.h"
#include "harness/cli/search_table.h"
#include "harness/cli/system_choice.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/plugs/systems.h"

namespace aisle {
namespace {

struct Options {
  std::string axes, train, judge, time_view = "paper/scene2:85-125@11";
  SystemChoice system{.name = "paper", .set = {}};
  std::vector<std::string> also;
  BenchSource source;
  SearchOptions search;
  double time_limit = 1.67;
  int timed = 8, frontier = 8;
  std::string json;
  PageBlock into{"search"};
};

/// All that is read, before the first frame is rendered.
struct Inputs {
  SystemSpec system;
  std::vector<BenchView> train, judge;
  BenchView time_view;
  std::vector<NamedSet> also;
};

Inputs Read(Options* options) {
  Inputs inputs{SpecOf(options->system),
                ReadViews(options->train),
                ReadViews(options->judge),
                ParseView(options->time_view),
                {}};
  options->search.axes = ReadAxes(options->axes, options->system.name);
  for (const std::string& text : options->also) {
    inputs.also.push_back(ParseNamedSet(text, options->system.name));
  }
  return inputs;
}

std::vector<Clip> LoadClips(const std::vector<BenchView>& views, const BenchSource& source) {
  ProgressLine line;
  std::vector<Clip> clips;
  for (const BenchView& view : views) {
    clips.push_back(LoadClip(view, source, [&](const std::string& at) { line.Show(at); }));
  }
  return clips;
}

std::string ToJson(const std::vector<Trial>& trials) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Trial& trial : trials) {
    const DetectorOutcome& o = trial.outcome;
    rows.push_back({{"set", trial.index},
                    {"options", trial.options},
                    {"given_up", trial.given_up},
                    {"frames", o.frames},
                    {"score", trial.score()},
                    {"object_f1", o.object_f1()},
                    {"pixel_iou", o.pixel_iou()},
                    {"static_wrong", o.static_wrong()},
                    {"large_asked", o.large.asked},
                    {"large_found", o.large.counted},
                    {"large_across_asked", o.large_across.asked},
                    {"large_across_found", o.large_across.counted},
                    {"ms", o.mean_ms()}});
  }
  return rows.dump(1) + "\n";
}

std::vector<Trial> Train(const Inputs& inputs, const Options& options) {
  const std::vector<Clip> clips = LoadClips(inputs.train, options.source);
  const System& like = FindSystem(options.system.name);
  fmt::print("{}\n", TrialHeading());
  double best = -1;
  std::vector<Trial> tried;
  return Search(
      inputs.system, clips, options.search,
      [&](const OptionSet& set) {
        return CheckOptions(like, With(inputs.system, set).options).empty();
      },
      [&](const Trial& trial) {
        tried.push_back(trial);
        if (!options.json.empty()) WriteFileAtomically(options.json, ToJson(tried));
        const bool better = !trial.given_up && trial.score() > best;
        if (better) best = trial.score();
        fmt::print("{}{}\n", TrialLine(trial), better ? "  *" : "");
        std::fflush(stdout);
      });
}

/// The best by score whose time keeps the limit; nothing where none does.
std::optional<OptionSet> BestInTime(std::vector<Trial> trials, const Inputs& inputs,
                                    const Options& options) {
  std::erase_if(trials, [](const Trial& trial) { return trial.given_up; });
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.score() > b.score(); });
  trials.resize(std::min(trials.size(), static_cast<std::size_t>(options.timed)));
  std::vector<OptionSet> sets;
  for (const Trial& trial : trials) sets.push_back(trial.options);
  const std::vector<double> ratios =
      TimeRatios(inputs.system, sets, inputs.time_view, options.source);
  const std::optional<std::size_t> taken = FirstInTime(ratios, options.time_limit);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    fmt::print("set {}: {:.2f} times the tracking{}\n", trials[i].index, ratios[i],
               taken == i ? ": taken" : "");
  }
  return taken ? std::optional(sets[*taken]) : std::nullopt;
}

/// Evenly over the frontier, its ends among them.
std::vector<Trial> Thinned(const std::vector<Trial>& frontier, int count) {
  if (static_cast<int>(frontier.size()) <= count) return frontier;
  std::vector<Trial> thinned;
  for (int i = 0; i < count; ++i) {
    const std::size_t at = static_cast<std::size_t>(i) * (frontier.size() - 1) /
                           static_cast<std::size_t>(std::max(1, count - 1));
    thinned.push_back(frontier[at]);
  }
  return thinned;
}

std::vector<JudgedSet> JudgeSets(const std::vector<NamedSet>& sets, const std::vector<Clip>& clips,
                                 const Inputs& inputs, const Options& options) {
  std::vector<OptionSet> values;
  for (const NamedSet& set : sets) values.push_back(set.options);
  const std::vector<double> ratios =
      TimeRatios(inputs.system, values, inputs.time_view, options.source);
  std::vector<JudgedSet> judged;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    judged.push_back(Judge(sets[i].name, inputs.system, sets[i].options, clips,
                           [](const Clip& clip) { return clip.scene; }));
    judged.back().time_ratio = ratios[i];
    fmt::print("judged: {}\n", sets[i].name);
    std::fflush(stdout);
  }
  return judged;
}

OptionSet OwnValues(const SystemSpec& system, const std::vector<SearchAxis>& axes) {
  OptionSet own;
  for (const SystemOption& option : OptionsOf(FindSystem(system.like))) {
    for (const SearchAxis& axis : axes) {
      if (axis.path == option.path) own[option.path] = option.value;
    }
  }
  for (const auto& [path, value] : system.options) {
    if (own.contains(path)) own[path] = value;
  }
  return own;
}

int BenchSearch(Options options) {
  const Inputs inputs = Read(&options);
  options.into.Check();
  SearchReport report{.system = options.system.name,
                      .axes = options.search.axes,
                      .own = OwnValues(inputs.system, options.search.axes),
                      .trials = Train(inputs, options),
                      .judged = {},
                      .frontier = {},
                      .time_limit = options.time_limit};
  std::vector<NamedSet> sets = {{"as it is", {}}};
  sets.insert(sets.end(), inputs.also.begin(), inputs.also.end());
  if (report.trials.size() > 1) {
    const std::optional<OptionSet> found = BestInTime(report.trials, inputs, options);
    if (found) sets.push_back({"found", *found});
    report.found = found.has_value();
  }
  const std::vector<Clip> clips = LoadClips(inputs.judge, options.source);
  report.judged = JudgeSets(sets, clips, inputs, options);
  std::vector<NamedSet> frontier;
  for (const Trial& trial : Thinned(Frontier(report.trials), options.frontier)) {
    frontier.push_back({fmt::format("set {}", trial.index), trial.options});
  }
  if (report.trials.size() > 1) report.frontier = JudgeSets(frontier, clips, inputs, options);
  const std::string text = ToMarkdown(report);
  fmt::print("\n{}", text);
  options.into.Write(text);
  return kAllPassed;
}

}  // namespace

void AddBenchSearch(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench->add_subcommand(
      "search",
      "Search for the constants of a system's detector: try sets of options on training stretches, "
      "then judge the best and the frontier on others");
  command->add_option("AXES", options->axes, "File with one option per line: PATH LOW HIGH [ratio]")
      ->required();
  command->add_option("--train", options->train, "File of views to choose by")->required();
  command->add_option("--judge", options->judge, "File of other views to judge by")->required();
  AddSystemChoice(command, &options->system);
  command->option_defaults()->group("Search");
  command->add_option("--also", options->also,
                      "Another set to judge, NAME:PATH=VALUE,…; may be given several times");
  command
      ->add_option(
          "--trials", options->search.trials,
          "Number of sets to try, the first of which is the system as it is; 1: only judge; "
          "default: 200")
      ->check(CLI::Range(1, 1000000));
  command
      ->add_option("--explore", options->search.explore,
                   "Number of those sets to draw from the whole space, the others from around the "
                   "best; default: 70")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--seed", options->search.seed, "Seed of the search; default: 1");
  command
      ->add_option("--time-limit", options->time_limit,
                   "Most time that the detector may take, as a multiple of tracking's; default: "
                   "1.67, the paper's")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--time-view", options->time_view,
                      "Stretch on which times are measured; default: " + options->time_view);
  command->option_defaults()->group("Options");
  AddFramesDir(command, &options->source.frames_dir);
  AddThreads(command, &options->source.threads, "", "Number of threads for tracking");
  AddJsonFile(command, &options->json, "every set that was tried");
  options->into.AddTo(command);
  command->footer(
      "The same seed tries the same sets: times only decide which of the best is taken.\n"
      "Example: ./aisle bench search scenes/searches/paper_axes.txt --train "
      "scenes/stretches/paper_train.txt --judge scenes/stretches/paper_judge.txt --json "
      "trials.json");
  command->callback([=] { *action = [=] { return BenchSearch(*options); }; });
}

}  // namespace aisle
