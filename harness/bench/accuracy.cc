#include "harness/bench/accuracy.h"

#include "harness/bench/shown.h"
#include "harness/io/input_error.h"
#include "harness/plugs/systems.h"
#include "harness/run/drive.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

void Add(const RunResult& run, AccuracyOfView* view) {
  const Scorecard scores = ScoreRun(run).scores;
  const auto add = [&](const char* score, std::vector<double>* values) {
    const auto found = scores.find(score);
    if (found != scores.end() && found->second.value) values->push_back(*found->second.value);
  };
  add("ate_live_rmse_m", &view->live_m);
  add("ate_rmse_m", &view->final_m);
  view->frames = std::max(view->frames, run.facts.size());
  view->frames_lost.push_back(static_cast<double>(run.facts.size()) -
                              static_cast<double>(run.trajectory.live.size()));
}

}  // namespace

void CheckStarts(const BenchView& view, std::int64_t end, const AccuracyBenchOptions& options) {
  const std::int64_t last = view.from + std::int64_t{options.starts - 1} * options.step;
  if (last < end) return;
  throw InputError(
      fmt::format("{}: its last start would be frame {}, and it ends before frame {}: fewer "
                  "--starts or a smaller --step",
                  Printable(view.text), last, end));
}

AccuracyOfView MeasureAccuracy(const BenchView& view, const AccuracyBenchOptions& options,
                               const BenchProgress& progress) {
  const auto whole = OpenSourceFor(options.system, view, options.source);
  CheckStarts(view, std::ssize(whole->Schedule()), options);
  AccuracyOfView outcome;
  for (int start = 0; start < options.starts; ++start) {
    const Excerpt stretch(*whole, view.from + start * options.step, view.to);
    const auto estimator =
        MakeSystem(options.system, whole->calibration(), {.threads = options.source.threads});
    const auto observe = [&](const DrivenFrame& frame) {
      if (!progress) return;
      progress(fmt::format("{}: start {} of {}, frame {} of {}", view.text, start + 1,
                           options.starts, frame.index + 1, frame.count));
    };
    const MaskMaker masks = MasksFor(options.system, view, options.source);
    Add(Drive(stretch, *estimator, masks, {}, observe), &outcome);
  }
  return outcome;
}

}  // namespace aisle
