#include "harness/campaign/closed_run.h"

#include "harness/common/stopwatch.h"
#include "harness/contract/map_id.h"
#include "harness/run/showing.h"

namespace aisle {
namespace {

/// The system under test tells where the vehicle is, from pictures taken where it is.
class SystemLocaliser : public Localiser {
 public:
  SystemLocaliser(const DriveScene& scene, Showing* showing) : scene_(scene), showing_(showing) {
    const double frames = scene.course().planned_s * scene.rate_hz();
    expected_ = static_cast<std::size_t>(std::ceil(frames));
  }

  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    if (showing_->offended()) return std::nullopt;
    const Stopwatch watch;
    const SequenceFrame frame = scene_.Take(exposure);
    const double made_ms = watch.ElapsedMs();
    const FrameRequest request{exposure.id, exposure.stamp_ns, exposure.T_world_rig};
    const FrameEstimate* said =
        showing_->Show(request, frame, made_ms, shown_, std::max(expected_, shown_ + 1));
    ++shown_;
    busy_ms_ += watch.ElapsedMs();
    if (said == nullptr) return std::nullopt;
    map_id_ = MapIdOf(*said);
    return said->T_world_rig;
  }
  int map_id() const override { return map_id_; }
  bool failed() const override { return showing_->offended(); }

  std::size_t shown() const { return shown_; }
  double busy_ms() const { return busy_ms_; }

 private:
  const DriveScene& scene_;
  Showing* showing_;
  std::size_t expected_ = 0, shown_ = 0;
  int map_id_ = 0;
  double busy_ms_ = 0;
};

}  // namespace

ClosedRun RunClosed(const DriveScene& scene, Estimator& estimator, const MaskMaker& masks,
                    const Steering& steering, std::uint64_t seed, const FrameObserver& observer,
                    const std::optional<TaughtCourse>& taught) {
  DriveLog log = LogOf(scene.course(), steering);
  LoopOptions options{.steering = steering, .seed = seed};
  TruthLocaliser truth;
  log.truth_steered = DriveClosed(scene, &truth, options);
  options.taught = taught;
  log.taught = taught.has_value();
  Showing showing(scene.calibration(), scene.rate_hz(), estimator, masks, observer);
  SystemLocaliser system(scene, &showing);
  const Stopwatch watch;
  log.track = DriveClosed(scene, &system, options);
  const double loop_ms = watch.ElapsedMs() - system.busy_ms();
  log.loop_ms = system.shown() > 0 ? loop_ms / static_cast<double>(system.shown()) : 0;
  RunResult result = showing.Finish(system.shown(), kMinCoverage);
  result.notes.push_back(
      fmt::format("closed loop: every frame was rendered for this run alone; the loop around it "
                  "took {:.2f} ms a frame",
                  log.loop_ms));
  return {std::move(result), std::move(log)};
}

}  // namespace aisle
