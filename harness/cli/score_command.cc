#include <nlohmann/json.hpp>

#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/score_input.h"
#include "harness/cli/score_masks.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/record/record_json.h"
#include "harness/score/coverage.h"
#include "harness/score/masks.h"
#include "harness/score/score_names.h"

namespace aisle {
namespace {

struct Options {
  std::string truth, format, format_truth, format_estimate, times;
  std::vector<std::string> estimates;
  std::string masks_truth, masks;
  OutlineOptions outline;
  std::string align = "se3", rule = "nearest", unit = "frames";
  std::optional<double> max_difference_s;
  double delta = 1;
  double rate_hz = 0;
  std::size_t align_first = 0;
  bool all = false;  ///< every score, not the six that matter
  bool all_pairs = false, along_estimate = false, list = false, json = false;
};

AssociationRule RuleFromName(const std::string& name) {
  if (name == "evo") return AssociationRule::kEvo;
  if (name == "tum") return AssociationRule::kTum;
  return name == "index" ? AssociationRule::kIndex : AssociationRule::kNearest;
}

DeltaUnit UnitFromName(const std::string& name) {
  if (name == "metres") return DeltaUnit::kMetres;
  return name == "seconds" ? DeltaUnit::kSeconds : DeltaUnit::kFrames;
}

/// What would have no effect here is a mistake about what was asked.
void RefuseIdle(const Options& options) {
  if (options.along_estimate && options.unit != "metres") {
    throw InputError("--along-estimate requires --unit metres");
  }
  if (options.align_first > 0 && options.align == "none") {
    throw InputError("--align-first has no effect with --align none");
  }
  if (options.rate_hz > 0 && options.rule == "index") {
    throw InputError(
        "--rate has no effect with --association index, which takes every true pose as a frame");
  }
}

ScoreOptions ScoreOptionsOf(const Options& options) {
  ScoreOptions score;
  score.association.rule = RuleFromName(options.rule);
  if (options.max_difference_s) {
    score.association.max_difference_ns =
        static_cast<std::int64_t>(std::llround(*options.max_difference_s * 1e9));
  }
  score.alignment.method = AlignmentFromName(options.align);
  score.alignment.first_n = options.align_first;
  score.relative = {.delta = options.delta,
                    .unit = UnitFromName(options.unit),
                    .all_pairs = options.all_pairs,
                    .along_estimate = options.along_estimate};
  return score;
}

/// KITTI files have no stamps: a shorter file is held against the common part, and that is said.
/// What the truth has beyond it counts as lost.
TrajectoryScore ScorePoses(const Trajectory& truth, Trajectory estimate,
                           const ScoreOptions& options, double rate_hz) {
  Trajectory scored = truth;
  if (options.association.rule == AssociationRule::kIndex && truth.size() != estimate.size()) {
    const std::size_t common = std::min(truth.size(), estimate.size());
    fmt::print(stderr, "aisle: {} true and {} estimated poses: scoring the first {}\n",
               truth.size(), estimate.size(), common);
    scored.resize(common);
    estimate.resize(common);
  }
  TrajectoryScore score = ScoreTrajectory(scored, estimate, options);
  AddCoverageOfFiles(truth, estimate, options, rate_hz, &score);
  return score;
}

std::string AlignmentInWords(const ScoreOptions& options) {
  const std::string name = Name(options.alignment.method);
  if (options.alignment.first_n == 0) return name;
  return fmt::format("{} on the first {} pairs", name, options.alignment.first_n);
}

/// What a person asks first; --all has the rest.
struct Asked {
  const char* score;
  const char* rule;
};
constexpr Asked kAsked[] = {
    {"ate_rmse_m",
     "root mean square distance between estimated and true positions, aligned as above"},
    {"ate_max_m", "the largest of these distances"},
    {"rpe_trans_rmse_m", "root mean square error of the motion over the step above"},
    {"rpe_rot_rmse_deg", "the same for the rotation"},
    {"t_rel_percent", "KITTI's drift over 100 to 800 m, as a share of the distance"},
    {"coverage", "share of the frames that have a pose; read it before any error"}};

bool IsAsked(const std::string& name, bool all) {
  return all || std::any_of(std::begin(kAsked), std::end(kAsked),
                            [&](const Asked& asked) { return name == asked.score; });
}

/// A path long enough to be told from the others: from the first folder in which they differ.
std::vector<std::string> TellingNames(const std::vector<std::string>& files) {
  std::size_t shared = 0;
  if (files.size() > 1) {
    const std::string& first = files.front();
    const auto all_have = [&](std::size_t length) {
      return std::all_of(files.begin(), files.end(), [&](const std::string& file) {
        return file.compare(0, length, first, 0, length) == 0;
      });
    };
    for (std::size_t slash = first.find('/'); slash != std::string::npos && all_have(slash + 1);
         slash = first.find('/', slash + 1)) {
      shared = slash + 1;
    }
  }
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(Printable(file.substr(shared), 4096));
  return names;
}

void PrintScores(const Scorecard& scores, bool all) {
  if (all) {
    for (const auto& [name, value] : scores) fmt::print("{:28} {}\n", name, ToText(value));
    return;
  }
  std::size_t left = scores.size();
  for (const auto& [name, rule] : kAsked) {
    const auto found = scores.find(name);
    if (found == scores.end()) continue;
    --left;
    fmt::print("{:18} {:40} {}\n", name, ToText(found->second), rule);
  }
  fmt::print("\n{} more scores with --all\n", left);
}

void PrintText(const TrajectoryScore& score, const ScoreOptions& options, const PosesRead& truth,
               const PosesRead& estimate, bool all) {
  fmt::print("read as      {} (truth); {} (estimate)\n", truth.format, estimate.format);
  fmt::print("association  {}: {} pairs of {} true and {} estimated poses\n", score.association,
             score.pairs.size(), truth.poses.size(), estimate.poses.size());
  fmt::print("alignment    {}, scale {:.9g}\n", AlignmentInWords(options), score.alignment.scale);
  fmt::print("rpe          {}\n", Describe(options.relative));
  const Score& coverage = score.scores.at("coverage");
  fmt::print("frames       {}, of which {:.0f} lost; error_all_* count these as failures\n\n",
             coverage.n, static_cast<double>(coverage.n) * (1 - coverage.value.value_or(0)));
  PrintScores(score.scores, all);
  for (const std::string& note : score.notes) fmt::print("\nnote: {}\n", note);
}

nlohmann::ordered_json ToJson(const TrajectoryScore& score, const ScoreOptions& options) {
  RunRecord record;
  record.scores = score.scores;
  nlohmann::ordered_json json;
  json["association"] = score.association;
  json["pairs"] = score.pairs.size();
  json["alignment"] = AlignmentInWords(options);
  json["rpe"] = Describe(options.relative);
  json["scores"] = RecordToJson(record)["scores"];
  json["notes"] = score.notes;
  return json;
}

/// Several estimates side by side, a row per score. Where one has no value, `score` of it alone
/// says why.
void PrintTable(const std::vector<std::string>& files, const AllPosesRead& read,
                const std::vector<TrajectoryScore>& scores, const ScoreOptions& options, bool all) {
  const std::vector<std::string> names = TellingNames(files);
  std::size_t width = 12;
  for (const std::string& name : names)
    width = std::max(width, std::min<std::size_t>(name.size(), 40));
  std::set<std::string> formats;
  for (const PosesRead& estimate : read.estimates) formats.insert(estimate.format);
  fmt::print("read as      {} (truth); {} (estimates)\n", read.truth.format,
             fmt::join(formats, " or "));
  fmt::print("association  {}\nalignment    {}\nrpe          {}\n\n{:36}",
             scores.front().association, AlignmentInWords(options), Describe(options.relative), "");
  for (const std::string& name : names) {
    fmt::print(" {:>{}}", name.substr(name.size() - std::min(name.size(), width)), width);
  }
  std::map<std::string, std::string> units;
  for (const TrajectoryScore& score : scores) {
    for (const auto& [name, value] : score.scores) {
      if (IsAsked(name, all)) units[name] = value.unit;
    }
  }
  for (const auto& [name, unit] : units) {
    fmt::print("\n{:28} {:7}", name, unit == "1" ? "" : unit);
    for (const TrajectoryScore& score : scores) {
      const auto at = score.scores.find(name);
      const bool has = at != score.scores.end() && at->second.value;
      fmt::print(" {:>{}}", has ? fmt::format("{:.6g}", *at->second.value) : "-", width);
    }
  }
  fmt::print("\n");
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const std::string& note : scores[i].notes) {
      fmt::print("\nnote: {}: {}\n", Printable(files[i], 4096), note);
    }
  }
}

nlohmann::ordered_json MasksToJson(const Scorecard& scores) {
  RunRecord record;
  record.scores = scores;
  return {{"objects", Describe(MaskOptions{})}, {"scores", RecordToJson(record)["scores"]}};
}

void PrintMasks(const Scorecard& scores) {
  fmt::print("objects      {}\n\n", Describe(MaskOptions{}));
  for (const auto& [name, value] : scores) fmt::print("{:28} {}\n", name, ToText(value));
}

int ListScores(bool json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ScoreDescription& score : ScoreNames()) {
    list.push_back({{"name", score.name}, {"unit", score.unit}, {"help", score.help}});
    if (!json) fmt::print("{:34} {:9} {}\n", score.name, score.unit, score.help);
  }
  if (json) fmt::print("{}", Dump({{"scores", list}}));
  return kAllPassed;
}

/// A finite number; CLI11's own checks let nan pass.
CLI::Validator NumberWithin(double low, double high) {
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        double value = 0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return good ? ""
                    : fmt::format("expected a number in [{1:g}, {2:g}], got '{0}'", Printable(text),
                                  low, high);
      },
      "NUMBER");
}

int ScoreFiles(const Options& options) {
  if (options.list) return ListScores(options.json);
  const bool trajectories = !options.truth.empty() || !options.estimates.empty();
  std::optional<Scorecard> masks;
  if (!options.masks_truth.empty()) {
    masks = ScoreMaskFolders(options.masks_truth, options.masks, options.outline);
    if (!options.json) PrintMasks(*masks);
    if (options.json && !trajectories) fmt::print("{}", Dump(MasksToJson(*masks)));
    if (!trajectories) return kAllPassed;
  }
  if (options.truth.empty() || options.estimates.empty()) {
    throw InputError("expected --truth and --estimate, or --masks-truth and --masks");
  }
  RefuseIdle(options);
  const ScoreOptions score_options = ScoreOptionsOf(options);
  const auto either = [](const std::string& own, const std::string& of_both) {
    return own.empty() ? of_both : own;
  };
  const AllPosesRead read =
      ReadPoseFiles({.truth = options.truth,
                     .estimates = options.estimates,
                     .format_truth = either(options.format_truth, options.format),
                     .format_estimate = either(options.format_estimate, options.format),
                     .times = options.times,
                     .by_stamp = score_options.association.rule != AssociationRule::kIndex});
  std::vector<TrajectoryScore> scores;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < read.estimates.size(); ++i) {
    const PosesRead& estimate = read.estimates[i];
    scores.push_back(ScorePoses(read.truth.poses, estimate.poses, score_options, options.rate_hz));
    if (!estimate.note.empty()) scores.back().notes.push_back(estimate.note);
    list.push_back(ToJson(scores.back(), score_options));
    list.back()["estimate"] = options.estimates[i];
  }
  if (options.json) {
    nlohmann::ordered_json all =
        list.size() == 1 ? list.front() : nlohmann::ordered_json{{"estimates", list}};
    if (masks) all["masks"] = MasksToJson(*masks);
    fmt::print("{}", Dump(all));
  } else if (scores.size() == 1) {
    PrintText(scores.front(), score_options, read.truth, read.estimates.front(), options.all);
  } else {
    PrintTable(options.estimates, read, scores, score_options, options.all);
  }
  const bool all = std::all_of(scores.begin(), scores.end(),
                               [](const TrajectoryScore& score) { return !score.errors.empty(); });
  return all ? kAllPassed : kNothingToDo;
}

void AddMaskOptions(CLI::App* command, Options* options) {
  command->option_defaults()->group("Masks");
  auto* masks_truth = command->add_option("--masks-truth", options->masks_truth,
                                          "Folder of true masks: PNGs in which black is static");
  command
      ->add_option("--masks", options->masks,
                   "Folder of masks to score, with the same file names as the true ones")
      ->needs(masks_truth);
  masks_truth->needs(command->get_option("--masks"));
  auto* px = command
                 ->add_option("--boundary-px", options->outline.px,
                              "Most pixels between two outlines that match (mask_boundary_f); "
                              "default: 3")
                 ->check(NumberWithin(0, 1e4))
                 ->needs(masks_truth);
  auto* share = command
                    ->add_option("--boundary-share", options->outline.share,
                                 "Most distance between two outlines that match, as a share of the "
                                 "image's diagonal")
                    ->check(NumberWithin(0, 1))
                    ->needs(masks_truth)
                    ->excludes(px);
  command
      ->add_flag("--boundary-davis", options->outline.davis,
                 "Match outlines as DAVIS's own program does: within 0.008 of the diagonal, mean "
                 "over frames")
      ->needs(masks_truth)
      ->excludes(px)
      ->excludes(share);
}

void AddInputOptions(CLI::App* command, Options* options) {
  command->option_defaults()->group("Trajectories");
  command->add_option(
      "--truth", options->truth,
      "True trajectory: a file, or a bag's topic (drive.mcap:/odom, drive.db3:/tf#base_link)");
  command->add_option(
      "--estimate", options->estimates,
      "Estimated trajectory: a file, or a bag's topic as for --truth; several are shown side by "
      "side");
  const auto add_format = [&](const char* name, std::string* format, const char* what) {
    command->add_option(name, *format, what)->check(CLI::IsMember({"tum", "kitti", "euroc"}));
  };
  add_format("--format", &options->format,
             "Format of all trajectories; default: recognised by their content");
  add_format("--format-truth", &options->format_truth,
             "Format of the true trajectory; default: that of --format");
  add_format("--format-estimate", &options->format_estimate,
             "Format of the estimates; default: that of --format");
  command->add_option("--times", options->times,
                      "KITTI's times.txt; needed if only one of the trajectories has timestamps");
  command
      ->add_option("--rate", options->rate_hz,
                   "Camera frames per second, for coverage; default: that of the slower trajectory")
      ->check(NumberWithin(1e-6, 1e9));
}

void AddMatchingOptions(CLI::App* command, Options* options) {
  command->option_defaults()->group("Association and alignment");
  command
      ->add_option("--association", options->rule,
                   "Rule that pairs estimated with true poses; default: nearest")
      ->check(CLI::IsMember({"nearest", "evo", "tum", "index"}));
  command
      ->add_option("--max-difference", options->max_difference_s,
                   "Most seconds between two paired timestamps; default: that of the rule")
      ->check(NumberWithin(0, 1e6));
  command->add_option("--align", options->align, "Alignment of the estimate; default: se3")
      ->check(CLI::IsMember({"none", "origin", "posyaw", "se3", "sim3"}));
  command
      ->add_option("--align-first", options->align_first,
                   "Align on the first N pairs only; default: on all")
      ->check(CLI::PositiveNumber);
  command->option_defaults()->group("Relative error");
  command->add_option("--delta", options->delta, "Step of the relative error; default: 1")
      ->check(NumberWithin(1e-9, 1e9));
  command->add_option("--unit", options->unit, "Unit of --delta; default: frames")
      ->check(CLI::IsMember({"frames", "metres", "seconds"}));
  command->add_flag(
      "--all-pairs", options->all_pairs,
      "Take a relative error from every pose, not only from the end of the last step");
  command->add_flag("--along-estimate", options->along_estimate,
                    "Measure metres along the estimate, as evo does");
}

}  // namespace

void AddScoreCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("score", "Score any trajectories and masks with every metric");
  AddInputOptions(command, options.get());
  AddMatchingOptions(command, options.get());
  AddMaskOptions(command, options.get());
  command->option_defaults()->group("Output");
  command->add_flag("--all", options->all, "Show every score, not only the six main ones");
  command->add_flag("--list", options->list, "List every score with its unit and meaning");
  AddJson(command, &options->json);
  command->footer("Example: ./aisle score --truth gt.txt --estimate slam.txt --align se3");
  command->callback([=] {
    *action = [=] {
      try {
        return ScoreFiles(*options);
      } catch (const std::invalid_argument& wrong) {  // what options and files do not fit together
        throw InputError(wrong.what());
      }
    };
  });
}

}  // namespace aisle
