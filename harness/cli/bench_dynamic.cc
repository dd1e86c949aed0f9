#include <nlohmann/json.hpp>

#include "harness/bench/dynamic.h"
#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/system_choice.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/score/front_end.h"
#include "harness/score/mask_scores.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

struct Options {
  std::vector<std::string> views;
  DynamicBenchOptions bench;
  SystemChoice system{.name = "robust", .set = {}};
  std::string json;
};

/// Stretches in which something of every kind moves: across, along the axis, slowly, filling the
/// image, before a standing and a turning rig.
const std::vector<std::string> kViews = {
    "paper/scene1:170-210",         "paper/scene2:90-130",         "paper/scene3:90-130",
    "paper/scene5:120-160",         "weakness/creep:110-150",      "weakness/follow:60-100",
    "weakness/pure_rotation:60-90", "weakness/optical_axis:40-80", "weakness/fill_60:40-80",
    "weakness/never_moves:60-90",
};

std::string Cell(const Score& score) {
  return score.value ? fmt::format("{:8.3f}", *score.value) : fmt::format("{:>8}", "-");
}

/// How late the last of the large movers was found, and for how many frames one was lost.
std::string LargeOverTime(const DynamicOfView& r) {
  const auto large = r.spells.find("large");
  if (large == r.spells.end()) return fmt::format("{:>8}{:>8}", "-", "-");
  const Continuity c = Summarize(large->second);
  const std::string after =
      c.delay_max_s ? fmt::format("{}{:.2f}", c.never_found > 0 ? ">" : "", *c.delay_max_s) : "-";
  const std::string gap = c.gap_max_frames ? fmt::format("{}", *c.gap_max_frames) : "-";
  return fmt::format("{:>8}{:>8}", after, gap);
}

/// One line: objects by rectangle, large ones over time, then pixels.
std::string Line(const std::string& name, const DynamicOfView& r) {
  std::string line = fmt::format("{:28}{:7}", name, r.frames);
  if (r.has_truth) {
    const Detection objects = ObjectDetection(r.masks), large = LargeDetection(r.masks),
                    pixels = PixelDetection(r.masks);
    line += Cell(objects.precision) + Cell(objects.recall) + Cell(large.precision) +
            Cell(large.recall) + LargeOverTime(r) + Cell(objects.iou) + Cell(pixels.iou) +
            Cell(pixels.recall) + fmt::format("{:7.2f} %", 100 * r.static_wrong());
  } else {
    line += fmt::format("{:>81}", "-");
  }
  line += fmt::format("{:7.2f} %", 100 * r.rejected_share());
  const auto dynamic = r.stage_ms.find("dynamic");
  if (dynamic != r.stage_ms.end()) line += fmt::format("{:8.1f}", dynamic->second / r.frames);
  return line;
}

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

int BenchDynamic(const Options& options) {
  const DynamicBenchOptions& bench = options.bench;
  const std::vector<std::string>& names = options.views.empty() ? kViews : options.views;
  std::vector<BenchView> views;  // all of them, before the first is measured
  for (const std::string& name : names) views.push_back(ParseView(name));
  fmt::print(
      "{}, after {} frames of warming "
      "up\n{:28}{:>7}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}\n",
      bench.system.name, bench.warm_up, "view", "frames", "prec.", "recall", "large P", "large R",
      "after s", "gap", "box IoU", "px IoU", "px rec.", "static", "all", "ms");
  nlohmann::json rows = nlohmann::json::array();
  DynamicOfView sum;
  for (const BenchView& view : views) {
    ProgressLine line;
    const DynamicOfView result =
        MeasureDynamic(view, bench, [&](const std::string& at) { line.Show(at); });
    line.Clear();
    fmt::print("{}\n", Line(Abridged(view.text, 27), result));
    std::fflush(stdout);
    rows.push_back(ToJson(result));
    sum += result;
  }
  fmt::print("{}\n", Line("all", sum));
  for (const auto& [stage, ms] : sum.mean_ms()) fmt::print("  {:26}{:9.2f} ms\n", stage, ms);
  if (const auto front_end = FrontEndOf(sum.mean_ms())) {
    fmt::print("front end: {:.2f} ms a frame, of which tracking {:.2f} ms\n", front_end->total(),
               front_end->tracking);
  }
  if (!options.json.empty()) WriteFileAtomically(options.json, rows.dump(2) + "\n");
  return kAllPassed;
}

}  // namespace

void AddBenchDynamic(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench->add_subcommand(
      "dynamic",
      "what a system rejects beside what moves: objects (large R: recall of those of 1 % of the "
      "image at 0.15 m/s or more; large P: share of the regions of 1 % or more of which a tenth or "
      "more moves), large movers over time, pixels, milliseconds");
  command->add_option("VIEWS", options->views,
                      "scene or folder of a recording, :FROM-TO for some frames (default: ten "
                      "stretches of the scenes)");
  AddSystemChoice(command, &options->system);
  AddSourceOptions(command, &options->bench.source);
  command
      ->add_option("--warm-up", options->bench.warm_up,
                   "frames before FROM, not counted; default 20")
      ->check(CLI::Range(0, 100000));
  command->add_option("--out", options->bench.out, "folder for pictures: truth red, rejected cyan");
  command
      ->add_flag("--debug-dynamic", options->bench.draw_stages,
                 "with --out: draw every stage of these frames too")
      ->needs("--out");
  command->add_option("--every", options->bench.every, "a picture every so many frames; default 10")
      ->check(CLI::Range(1, 100000));
  command->add_option("--json", options->json, "write counts and means there too");
  command->footer(
      "Over time, of large movers: after s, the longest that one which stays for 1 s or longer was "
      "not found (> where one never was); gap, the most frames in a row in which one once found "
      "was lost. What moves already when a stretch begins counts from its first scored frame on.\n"
      "Example: ./aisle bench dynamic paper/scene2:90-130 --system paper --out masks");
  command->callback([=] {
    *action = [=] {
      options->bench.system = SpecOf(options->system);
      return BenchDynamic(*options);
    };
  });
}

}  // namespace aisle
