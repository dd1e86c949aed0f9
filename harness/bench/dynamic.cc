#include "harness/bench/dynamic.h"

#include "harness/bench/shown.h"
#include "harness/io/image.h"
#include "harness/plugs/systems.h"
#include "harness/report/picture/overlay.h"
#include "harness/report/picture/stage_sheets.h"

namespace aisle {
namespace {

/// "paper_scene2@4": seeds of a scene have pictures of their own.
std::string PictureName(const Sequence& sequence, const BenchView& view,
                        const BenchSource& source) {
  std::string name = sequence.name();
  std::ranges::replace(name, '/', '_');
  return view.scene.empty() ? name : fmt::format("{}@{}", name, SeedOf(view, source));
}

void Picture(const SequenceFrame& shown, const FrameEstimate& estimate, const std::string& view,
             const std::string& name, const DynamicBenchOptions& options) {
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

void DynamicMeter::Add(const SequenceFrame& shown, const FrameEstimate& estimate) {
  ++view_.frames;
  view_.pixels += static_cast<double>(shown.images.left.total());
  if (!estimate.regions.mask.empty()) view_.rejected += cv::countNonZero(estimate.regions.mask);
  for (const auto& [stage, ms] : estimate.stage_ms) view_.stage_ms[stage] += ms;
  if (!shown.truth) return;
  FrameFacts facts;
  facts.stamp_ns = shown.images.stamp_ns;
  facts.T_world_rig = shown.truth->T_world_rig;
  if (!shown.truth->dynamic.empty()) {
    view_.has_truth = true;
    facts.mask = CompareMasks(shown.images.left, *shown.truth, estimate.regions);
    view_.masks += *facts.mask;
  }
  facts_.push_back(std::move(facts));
}

DynamicOfView DynamicMeter::View() const {
  DynamicOfView view = view_;
  view.spells = FollowKinds(facts_);
  return view;
}

double DynamicOfView::rejected_share() const { return rejected / std::max(pixels, 1.0); }

double DynamicOfView::static_wrong() const {
  const double moving = static_cast<double>(masks.true_positives + masks.false_negatives);
  return static_cast<double>(masks.false_positives) / std::max(pixels - moving, 1.0);
}

DynamicOfView MeasureDynamic(const BenchView& view, const DynamicBenchOptions& options,
                             const BenchProgress& progress) {
  const auto sequence = OpenSourceFor(options.system, view, options.source);
  const auto estimator =
      MakeSystem(options.system, sequence->calibration(),
                 {.threads = options.source.threads, .draw_stages = options.draw_stages});
  const std::string picture = PictureName(*sequence, view, options.source);
  DynamicMeter meter(sequence->name(), view.text);
  const MaskMaker masks = MasksFor(options.system, view, options.source);
  const Excerpt stretch(*sequence, std::max(view.from - options.warm_up, 0), view.to);
  for (const FrameRequest& request : stretch.Schedule()) {
    if (progress) progress(fmt::format("{}: frame {}", sequence->name(), request.id));
    const SequenceFrame shown = stretch.At(request);
    const FrameEstimate estimate = Show(shown, masks, estimator.get());
    if (request.id < view.from) continue;
    meter.Add(shown, estimate);
    if (!options.out.empty() && request.id % options.every == 0) {
      Picture(shown, estimate, sequence->name(), picture, options);
    }
  }
  return meter.View();
}

}  // namespace aisle
