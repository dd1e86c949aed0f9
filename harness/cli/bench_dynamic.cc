#include <nlohmann/json.hpp>
#include <set>

#include "harness/bench/dynamic.h"
#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/dynamic_table.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/page_block.h"
#include "harness/cli/system_choice.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/score/front_end.h"
#include "harness/score/mask_scores.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

struct Options {
  std::vector<std::string> views;
  DynamicBenchOptions bench;
  SystemChoice system{.name = "robust", .set = {}};
  std::string views_file, json;
  PageBlock into{"views"};
};

/// Stretches in which something of every kind moves: across, along the axis, slowly, filling the
/// image, before a standing and a turning rig.
const std::vector<std::string> kViews = {
    "paper/scene1:170-210",         "paper/scene2:90-130",         "paper/scene3:90-130",
    "paper/scene5:120-160",         "weakness/creep:110-150",      "weakness/follow:60-100",
    "weakness/pure_rotation:60-90", "weakness/optical_axis:40-80", "weakness/fill_60:40-80",
    "weakness/never_moves:60-90",
};

nlohmann::json ToJson(const MoverSpell& spell) {
  nlohmann::json json = {{"instance", spell.instance},
                         {"class", spell.object_class},
                         {"first_ns", spell.first_ns},
                         {"last_ns", spell.last_ns},
                         {"frames", spell.frames},
                         {"mean_speed_mps", spell.mean_speed_mps},
                         {"largest_share", spell.largest_share},
                         {"gap_frames", spell.gap_frames},
                         {"turning_frames", spell.turning_frames},
                         {"gap_turning_frames", spell.gap_turning_frames}};
  if (spell.delay_s) json["delay_s"] = *spell.delay_s;
  return json;
}

nlohmann::json ToJson(const DynamicOfView& r) {
  nlohmann::json json = {
      {"name", r.name}, {"frames", r.frames}, {"rejected_share", r.rejected_share()}};
  for (const auto& [stage, ms] : r.mean_ms()) json["ms"][stage] = ms;
  if (const auto front_end = FrontEndOf(r.mean_ms())) {
    json["dynamic_ms"] = front_end->dynamic;
    json["front_end_ms"] = front_end->total();
  }
  if (!r.has_truth) return json;
  const ObjectCount large_movers = CountLargeMovers(r.masks);
  const Detection large = LargeDetection(r.masks);
  json["objects"] = {{"found", r.masks.objects_found},
                     {"invented", r.masks.objects_invented},
                     {"missed", r.masks.objects_missed},
                     {"large_regions", r.masks.large_regions},
                     {"large_regions_astray", r.masks.large_regions_astray},
                     {"large_movers", large_movers.asked},
                     {"large_movers_found", large_movers.counted},
                     {"iou_sum", r.masks.iou_sum}};
  if (large.precision.value) json["objects"]["precision_of_large"] = *large.precision.value;
  if (large.recall.value) json["objects"]["recall_of_large"] = *large.recall.value;
  json["pixels"] = {{"true_positives", r.masks.true_positives},
                    {"false_positives", r.masks.false_positives},
                    {"false_negatives", r.masks.false_negatives}};
  Scorecard scores;
  AddContinuity(r.spells, {}, &scores);
  for (const auto& [name, score] : scores) {
    json["scores"][name] = {{"value", *score.value}, {"unit", score.unit}, {"n", score.n}};
  }
  for (const auto& [kind, spells] : r.spells) {
    json["spells"][kind] = nlohmann::json::array();
    for (const MoverSpell& spell : spells) json["spells"][kind].push_back(ToJson(spell));
  }
  return json;
}

/// All of them, before the first is measured.
std::vector<BenchView> ViewsOf(const Options& options) {
  std::vector<BenchView> views;
  if (!options.views_file.empty()) views = ReadViews(options.views_file);
  const bool none = options.views.empty() && views.empty();
  for (const std::string& name : none ? kViews : options.views) views.push_back(ParseView(name));
  return views;
}

DynamicOfView Measure(const BenchView& view, const DynamicBenchOptions& bench) {
  ProgressLine line;
  DynamicOfView measured =
      MeasureDynamic(view, bench, [&](const std::string& at) { line.Show(at); });
  RefuseEmptyView(view, static_cast<std::size_t>(measured.frames));
  return measured;
}

constexpr const char* kAllOf = "all of ";

/// What the rows of the table will be called, sums of a scene's stretches included.
std::vector<std::string> NamesOf(const std::vector<BenchView>& views) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const BenchView& view : views) {
    names.push_back(view.text);
    if (!view.scene.empty() && !seen.insert(view.scene).second)
      names.push_back(kAllOf + view.scene);
  }
  return names;
}

void PrintSum(const std::vector<DynamicOfView>& rows, TextTable* table) {
  DynamicOfView sum;
  for (const DynamicOfView& row : rows) sum += row;
  const std::vector<DynamicOfView> scenes = ByScene(rows);
  if (scenes.size() < rows.size()) {
    for (const DynamicOfView& scene : scenes) {
      fmt::print("{}", table->Row(kAllOf + scene.name, DynamicCells(scene)));
    }
  }
  fmt::print("{}", table->Row("all", DynamicCells(sum)));
  for (const auto& [stage, ms] : sum.mean_ms()) fmt::print("  {:26}{:9.2f} ms\n", stage, ms);
  if (const auto front_end = FrontEndOf(sum.mean_ms())) {
    fmt::print("front end: {:.2f} ms per frame, of which tracking takes {:.2f} ms\n",
               front_end->total(), front_end->tracking);
  }
}

int BenchDynamic(const Options& options) {
  const DynamicBenchOptions& bench = options.bench;
  const std::vector<BenchView> views = ViewsOf(options);
  options.into.Check();
  CheckCanBeWritten(options.json);
  TextTable table = DynamicLines(NamesOf(views), LookOfStdout().width);
  fmt::print("{}, after a warm-up of {} frames\n{}", bench.system.name, bench.warm_up,
             table.Heading());
  nlohmann::json json = nlohmann::json::array();
  std::vector<DynamicOfView> rows;
  for (const BenchView& view : views) {
    rows.push_back(Measure(view, bench));
    fmt::print("{}", table.Row(view.text, DynamicCells(rows.back())));
    std::fflush(stdout);
    json.push_back(ToJson(rows.back()));
  }
  PrintSum(rows, &table);
  if (!options.json.empty()) WriteFileAtomically(options.json, json.dump(2) + "\n");
  options.into.Write(DynamicTable(ByScene(rows)));
  return kAllPassed;
}

}  // namespace

void AddBenchDynamic(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench->add_subcommand(
      "dynamic", "Compare what a system rejects with what really moves, and time its detector");
  command->add_option("VIEWS", options->views,
                      "Scenes or recordings' folders; :FROM-TO selects frames, @SEED sets the "
                      "scene's seed; default: ten stretches of the scenes");
  command->add_option("--views", options->views_file,
                      "File with one view per line; scenes/stretches has some");
  AddSystemChoice(command, &options->system);
  AddSourceOptions(command, &options->bench.source);
  command
      ->add_option("--warm-up", options->bench.warm_up,
                   "Frames to drive before FROM without counting them; default: 20")
      ->check(CLI::Range(0, 100000));
  command->option_defaults()->group("Output");
  command->add_option("--out", options->bench.out,
                      "Folder for pictures with the truth in red and rejected pixels in cyan");
  command
      ->add_flag("--debug-dynamic", options->bench.draw_stages,
                 "Also draw every stage of the detector into the folder of --out")
      ->needs("--out");
  command
      ->add_option("--every", options->bench.every, "Draw one picture every N frames; default: 10")
      ->check(CLI::Range(1, 100000));
  AddJsonFile(command, &options->json, "counts and means");
  options->into.AddTo(command);
  command->footer(
      "Objects: large R is the recall of objects of 1 % of the image or more that move at 0.15 m/s "
      "or\nmore; large P is the share of rejected regions of 1 % or more of which at least a tenth "
      "moves.\n"
      "Large movers over time: 'after s' is the longest time until one that stays for 1 s or "
      "longer "
      "was\nfound (> if one never was); 'gap' is the most frames in a row in which one was lost "
      "after it had\nbeen found. For what already moves when a stretch begins, time starts at its "
      "first scored frame.\n"
      "Example: ./aisle bench dynamic paper/scene2:90-130 --system paper --out masks");
  command->callback([=] {
    *action = [=] {
      options->bench.system = SpecOf(options->system);
      return BenchDynamic(*options);
    };
  });
}

}  // namespace aisle
