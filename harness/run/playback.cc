#include "harness/run/playback.h"

namespace aisle {
namespace {

/// Says again what was said.
class Ghost : public Estimator {
 public:
  Ghost(const RunResult& result, const Remarks& remarks) : result_(result), remarks_(remarks) {}

  FrameEstimate Process(const StereoFrame& frame, const ExternalMask&) override {
    FrameEstimate estimate = remarks_ ? remarks_(frame) : FrameEstimate{};
    const FrameEstimate& told = result_.estimates.at(static_cast<std::size_t>(frame.id));
    estimate.id = frame.id;
    estimate.stamp_ns = frame.stamp_ns;
    estimate.state = told.state;
    estimate.T_world_rig = told.T_world_rig;
    return estimate;
  }
  Trajectory Finish() override { return result_.trajectory.final; }

 private:
  const RunResult& result_;
  const Remarks& remarks_;
};

}  // namespace

void PlayBack(const Sequence& sequence, const Remarks& remarks, const FrameObserver& observer,
              RunResult* result) {
  Ghost ghost(*result, remarks);
  // A share of frames below which a run is lost is the drive's own matter, and decided.
  RunResult seen =
      Drive(sequence, ghost, MasksFromTruth(MaskSource::kNone), {.min_coverage = 0}, observer);
  if (seen.facts.size() != result->facts.size()) {
    result->notes.push_back("ignored what it left beside its trajectory: " + seen.status_why);
    return;
  }
  for (std::size_t i = 0; i < seen.facts.size(); ++i) {
    seen.facts[i].process_ms = result->facts[i].process_ms;
  }
  result->facts = std::move(seen.facts);
}

void SpreadWallTime(RunResult* result) {
  if (result->facts.empty()) return;
  const double frame_ms = 1000 * result->wall_s / static_cast<double>(result->facts.size());
  for (FrameFacts& facts : result->facts) facts.process_ms = frame_ms;
}

}  // namespace aisle
