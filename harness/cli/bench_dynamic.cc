#include <nlohmann/json.hpp>

#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/plugs/systems.h"
#include "harness/report/picture/overlay.h"
#include "harness/report/picture/stage_sheets.h"
#include "harness/score/continuity.h"
#include "harness/score/front_end.h"
#include "harness/score/masks.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> views;
  BenchSource source{.format = "kitti"};
  std::string system = "robust", out, json;
  int warm_up = 20, every = 10;
  bool debug_dynamic = false;
};

/// Stretches in which something of every kind moves: across, along the axis, slowly, filling the
/// image, before a standing and a turning rig.
const std::vector<std::string> kViews = {
    "paper/scene1:170-210",         "paper/scene2:90-130",         "paper/scene3:90-130",
    "paper/scene5:120-160",         "weakness/creep:110-150",      "weakness/follow:60-100",
    "weakness/pure_rotation:60-90", "weakness/optical_axis:40-80", "weakness/fill_60:40-80",
    "weakness/never_moves:60-90",
};

/// What became of one stretch.
struct Result {
  std::string name;
  int frames = 0;
  bool has_truth = false;
  MaskFacts masks;
  SpellsByKind spells;
  double pixels = 0, rejected = 0;         ///< of all frames
  std::map<std::string, double> stage_ms;  ///< sums

  std::map<std::string, double> mean_ms() const {
    std::map<std::string, double> means = stage_ms;
    for (auto& [stage, ms] : means) ms /= std::max(frames, 1);
    return means;
  }

  /// What truth says of the frame, if it says anything.
  std::optional<FrameFacts> Add(const SequenceFrame& shown, const FrameEstimate& estimate) {
    ++frames;
    pixels += static_cast<double>(shown.images.left.total());
    if (!estimate.regions.mask.empty()) rejected += cv::countNonZero(estimate.regions.mask);
    for (const auto& [stage, ms] : estimate.stage_ms) stage_ms[stage] += ms;
    if (!shown.truth) return std::nullopt;
    FrameFacts facts;
    facts.stamp_ns = shown.images.stamp_ns;
    facts.T_world_rig = shown.truth->T_world_rig;
    if (shown.truth->dynamic.empty()) return facts;
    has_truth = true;
    facts.mask = CompareMasks(shown.images.left, *shown.truth, estimate.regions);
    masks += *facts.mask;
    return facts;
  }

  Result& operator+=(const Result& more) {
    frames += more.frames;
    has_truth |= more.has_truth;
    masks += more.masks;
    for (const auto& [kind, more_of_it] : more.spells) {
      spells[kind].insert(spells[kind].end(), more_of_it.begin(), more_of_it.end());
    }
    pixels += more.pixels;
    rejected += more.rejected;
    for (const auto& [stage, ms] : more.stage_ms) stage_ms[stage] += ms;
    return *this;
  }

  /// Of the objects that must be found, large ones that really go somewhere, those that were.
  ObjectCount LargeMovers() const {
    return CountObjects(
        masks.objects, [](const ObjectOutcome& object) { return IsLargeMover(object); },
        [](const ObjectOutcome& object) { return object.found; });
  }
  std::optional<double> RecallOfLarge() const {
    return Ratio(LargeMovers().counted, LargeMovers().asked);
  }

  std::optional<double> PrecisionOfLarge() const {
    return Ratio(masks.large_regions - masks.large_regions_astray, masks.large_regions);
  }

  double static_wrong() const {
    const double moving = static_cast<double>(masks.true_positives + masks.false_negatives);
    return static_cast<double>(masks.false_positives) / std::max(pixels - moving, 1.0);
  }
};

void Picture(const SequenceFrame& shown, const FrameEstimate& estimate, const Result& result,
             const Options& options) {
  std::string name = result.name;
  std::ranges::replace(name, '/', '_');
  if (estimate.draw_stages) {
    const cv::Mat3b sheet = TileStages(estimate.draw_stages(shown.truth ? &*shown.truth : nullptr));
    const std::string file = fmt::format("{}_{:05}_stages.jpg", name, shown.images.id);
    if (!sheet.empty()) WriteImage(fs::path(options.out) / file, sheet);
  }
  WriteImage(fs::path(options.out) / fmt::format("{}_{:05}.jpg", name, shown.images.id),
             DrawOverlay(shown.images.left, shown.truth ? &*shown.truth : nullptr, &estimate,
                         fmt::format("{}  frame {}", result.name, shown.images.id)));
}

Result Measure(const BenchView& view, const Options& options) {
  const auto sequence = OpenSource(view.source, options.source);
  const auto estimator = FindSystem(options.system)
                             .make(sequence->calibration(), {.threads = options.source.threads,
                                                             .draw_stages = options.debug_dynamic});
  Result result;
  result.name = sequence->name();
  std::vector<FrameFacts> facts;
  ProgressLine line;
  int index = 0;
  for (const FrameRequest& request : sequence->Schedule()) {
    const int now = index++;
    if (now < view.from - options.warm_up) continue;
    if (now >= view.to) break;
    line.Show(fmt::format("{}: frame {}", result.name, now));
    const SequenceFrame shown = sequence->At(request);
    const FrameEstimate estimate = estimator->Process(shown.images, {});
    if (now < view.from) continue;
    if (auto of_frame = result.Add(shown, estimate)) facts.push_back(*std::move(of_frame));
    if (!options.out.empty() && now % options.every == 0) {
      Picture(shown, estimate, result, options);
    }
  }
  result.spells = FollowKinds(facts);
  return result;
}

std::string Cell(const std::optional<double>& value) {
  return value ? fmt::format("{:8.3f}", *value) : fmt::format("{:>8}", "-");
}

/// How late the last of the large movers was found, and for how many frames one was lost.
std::string LargeOverTime(const Result& r) {
  const auto large = r.spells.find("large");
  if (large == r.spells.end()) return fmt::format("{:>8}{:>8}", "-", "-");
  const Continuity c = Summarize(large->second);
  const std::string after =
      c.delay_max_s ? fmt::format("{}{:.2f}", c.never_found > 0 ? ">" : "", *c.delay_max_s) : "-";
  const std::string gap = c.gap_max_frames ? fmt::format("{}", *c.gap_max_frames) : "-";
  return fmt::format("{:>8}{:>8}", after, gap);
}

/// One line: objects by rectangle, large ones over time, then pixels.
std::string Line(const std::string& name, const Result& r) {
  const MaskFacts& m = r.masks;
  const auto tp = static_cast<double>(m.true_positives);
  const double union_px = tp + static_cast<double>(m.false_positives + m.false_negatives);
  std::string line = fmt::format("{:28}{:7}", name, r.frames);
  if (r.has_truth) {
    line += Cell(Ratio(m.objects_found, m.objects_found + m.objects_invented)) +
            Cell(Ratio(m.objects_found, m.objects_found + m.objects_missed)) +
            Cell(r.PrecisionOfLarge()) + Cell(r.RecallOfLarge()) + LargeOverTime(r) +
            Cell(Ratio(m.iou_sum, m.objects_found)) + Cell(Ratio(tp, union_px)) +
            Cell(Ratio(tp, tp + static_cast<double>(m.false_negatives))) +
            fmt::format("{:7.2f} %", 100 * r.static_wrong());
  } else {
    line += fmt::format("{:>81}", "-");
  }
  line += fmt::format("{:7.2f} %", 100 * r.rejected / std::max(r.pixels, 1.0));
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

nlohmann::json ToJson(const Result& r) {
  nlohmann::json json = {{"name", r.name},
                         {"frames", r.frames},
                         {"rejected_share", r.rejected / std::max(r.pixels, 1.0)}};
  for (const auto& [stage, ms] : r.mean_ms()) json["ms"][stage] = ms;
  if (const auto front_end = FrontEndOf(r.mean_ms())) {
    json["dynamic_ms"] = front_end->dynamic;
    json["front_end_ms"] = front_end->total();
  }
  if (!r.has_truth) return json;
  json["objects"] = {{"found", r.masks.objects_found},
                     {"invented", r.masks.objects_invented},
                     {"missed", r.masks.objects_missed},
                     {"large_regions", r.masks.large_regions},
                     {"large_regions_astray", r.masks.large_regions_astray},
                     {"large_movers", r.LargeMovers().asked},
                     {"large_movers_found", r.LargeMovers().counted},
                     {"iou_sum", r.masks.iou_sum}};
  if (const auto precision = r.PrecisionOfLarge())
    json["objects"]["precision_of_large"] = *precision;
  if (const auto recall = r.RecallOfLarge()) json["objects"]["recall_of_large"] = *recall;
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
  const std::vector<std::string>& names = options.views.empty() ? kViews : options.views;
  std::vector<BenchView> views;  // all of them, before the first is measured
  for (const std::string& name : names) views.push_back(ParseView(name));
  fmt::print(
      "{}, after {} frames of warming "
      "up\n{:28}{:>7}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}\n",
      options.system, options.warm_up, "view", "frames", "prec.", "recall", "large P", "large R",
      "after s", "gap", "box IoU", "px IoU", "px rec.", "static", "all", "ms");
  nlohmann::json rows = nlohmann::json::array();
  Result sum;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Result result = Measure(views[i], options);
    const std::string& text = names[i];
    fmt::print("{}\n", Line(Abridged(text, 27), result));
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
  command->add_option("--system", options->system, "default robust");
  AddSourceOptions(command, &options->source);
  command->add_option("--warm-up", options->warm_up, "frames before FROM, not counted; default 20")
      ->check(CLI::Range(0, 100000));
  command->add_option("--out", options->out, "folder for pictures: truth red, rejected cyan");
  command
      ->add_flag("--debug-dynamic", options->debug_dynamic,
                 "with --out: draw every stage of these frames too")
      ->needs("--out");
  command->add_option("--every", options->every, "a picture every so many frames; default 10")
      ->check(CLI::Range(1, 100000));
  command->add_option("--json", options->json, "write counts and means there too");
  command->footer(
      "Over time, of large movers: after s, the longest that one which stays for 1 s or longer was "
      "not found (> where one never was); gap, the most frames in a row in which one once found "
      "was lost. What moves already when a stretch begins counts from its first scored frame on.\n"
      "Example: ./aisle bench dynamic paper/scene2:90-130 --system paper --out masks");
  command->callback([=] { *action = [=] { return BenchDynamic(*options); }; });
}

}  // namespace aisle
