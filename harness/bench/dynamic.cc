#include "harness/bench/dynamic.h"

#include "harness/io/image.h"
#include "harness/plugs/systems.h"
#include "harness/report/picture/overlay.h"
#include "harness/report/picture/stage_sheets.h"

namespace aisle {
namespace {

/// What truth says of the frame, if it says anything.
std::optional<FrameFacts> Add(const SequenceFrame& shown, const FrameEstimate& estimate,
                              DynamicOfView* view) {
  ++view->frames;
  view->pixels += static_cast<double>(shown.images.left.total());
  if (!estimate.regions.mask.empty()) view->rejected += cv::countNonZero(estimate.regions.mask);
  for (const auto& [stage, ms] : estimate.stage_ms) view->stage_ms[stage] += ms;
  if (!shown.truth) return std::nullopt;
  FrameFacts facts;
  facts.stamp_ns = shown.images.stamp_ns;
  facts.T_world_rig = shown.truth->T_world_rig;
  if (shown.truth->dynamic.empty()) return facts;
  view->has_truth = true;
  facts.mask = CompareMasks(shown.images.left, *shown.truth, estimate.regions);
  view->masks += *facts.mask;
  return facts;
}

void Picture(const SequenceFrame& shown, const FrameEstimate& estimate, const std::string& view,
             const DynamicBenchOptions& options) {
  std::string name = view;
  std::ranges::replace(name, '/', '_');
  if (estimate.draw_stages) {
    const cv::Mat3b sheet = TileStages(estimate.draw_stages(shown.truth ? &*shown.truth : nullptr));
    const std::string file = fmt::format("{}_{:05}_stages.jpg", name, shown.images.id);
    if (!sheet.empty()) WriteImage(options.out / file, sheet);
  }
  WriteImage(options.out / fmt::format("{}_{:05}.jpg", name, shown.images.id),
             DrawOverlay(shown.images.left, shown.truth ? &*shown.truth : nullptr, &estimate,
                         fmt::format("{}  frame {}", view, shown.images.id)));
}

}  // namespace

DynamicOfView& DynamicOfView::operator+=(const DynamicOfView& more) {
  stretches += more.stretches;
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

std::map<std::string, double> DynamicOfView::mean_ms() const {
  std::map<std::string, double> means = stage_ms;
  for (auto& [stage, ms] : means) ms /= std::max(frames, 1);
  return means;
}

double DynamicOfView::rejected_share() const { return rejected / std::max(pixels, 1.0); }

double DynamicOfView::static_wrong() const {
  const double moving = static_cast<double>(masks.true_positives + masks.false_negatives);
  return static_cast<double>(masks.false_positives) / std::max(pixels - moving, 1.0);
}

DynamicOfView MeasureDynamic(const BenchView& view, const DynamicBenchOptions& options,
                             const BenchProgress& progress) {
  const auto sequence = OpenSource(view, options.source);
  const auto estimator =
      MakeSystem(options.system, sequence->calibration(),
                 {.threads = options.source.threads, .draw_stages = options.draw_stages});
  DynamicOfView result;
  result.name = sequence->name();
  result.view = view.text;
  result.stretches = 1;
  std::vector<FrameFacts> facts;
  int index = 0;
  for (const FrameRequest& request : sequence->Schedule()) {
    const int now = index++;
    if (now < view.from - options.warm_up) continue;
    if (now >= view.to) break;
    if (progress) progress(fmt::format("{}: frame {}", result.name, now));
    const SequenceFrame shown = sequence->At(request);
    const FrameEstimate estimate = estimator->Process(shown.images, {});
    if (now < view.from) continue;
    if (auto of_frame = Add(shown, estimate, &result)) facts.push_back(*std::move(of_frame));
    if (!options.out.empty() && now % options.every == 0) {
      Picture(shown, estimate, result.name, options);
    }
  }
  result.spells = FollowKinds(facts);
  return result;
}

}  // namespace aisle
