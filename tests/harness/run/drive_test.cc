#include "harness/run/drive.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "harness/run/frames_ahead.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

constexpr int kFrames = 40;
constexpr std::int64_t kStepNs = 50'000'000;

Eigen::Isometry3d PoseAt(std::int64_t id) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 0.1 * static_cast<double>(id), 0.05 * static_cast<double>(id % 5), 0;
  return pose;
}

/// Frames whose pixels name them; a mover covers a quarter of every image.
class CountingSequence : public Sequence {
 public:
  std::string name() const override { return "counting"; }
  StereoCalibration calibration() const override { return {8, 8, 10, 10, 4, 4, 0.1}; }
  double rate_hz() const override { return 20; }
  std::vector<FrameRequest> Schedule() const override {
    std::vector<FrameRequest> schedule;
    for (int k = 0; k < kFrames; ++k) schedule.push_back({k, k * kStepNs, PoseAt(k)});
    return schedule;
  }
  SequenceFrame At(const FrameRequest& request) const override {
    made_ = std::max<std::int64_t>(made_, request.id + 1);
    if (request.id == fails_at) throw std::runtime_error("no such frame");
    SequenceFrame frame;
    const auto grey = static_cast<unsigned char>(request.id);
    frame.images = {request.id, request.stamp_ns, cv::Mat1b(8, 8, grey), cv::Mat1b(8, 8, grey)};
    frame.truth.emplace();
    frame.truth->T_world_rig = request.T_world_rig;
    frame.truth->dynamic = cv::Mat1b(8, 8, static_cast<unsigned char>(0));
    frame.truth->dynamic(cv::Rect(0, 0, 4, 4)) = 255;
    frame.truth->actor = cv::Mat1b(8, 8, static_cast<unsigned char>(255));
    return frame;
  }
  std::int64_t fails_at = -1;
  std::int64_t made() const { return made_; }

 private:
  mutable std::atomic<std::int64_t> made_ = 0;
};

/// Says the truth, unless told to misbehave at one frame.
class ScriptedEstimator : public Estimator {
 public:
  enum class Sin {
    kNone,
    kThrows,
    kHasNoMemory,
    kSaysNan,
    kSaysFar,
    kSaysShear,
    kLosesTheRest,
    kWrongFrame,
    kEndsInMicroseconds,
    kEndsInTheFuture,
    kEndsSparse,
    kBeginsAnew,
    kGoesBackToAnOldMap
  };
  explicit ScriptedEstimator(Sin sin = Sin::kNone) : sin_(sin) {}

  FrameEstimate Process(const StereoFrame& frame, const ExternalMask& mask) override {
    EXPECT_EQ(frame.left(3, 3), static_cast<unsigned char>(frame.id));
    masked_pixels = mask.left.empty() ? 0 : cv::countNonZero(mask.left);
    FrameEstimate estimate;
    estimate.id = frame.id;
    estimate.stamp_ns = frame.stamp_ns;
    estimate.state = TrackingState::kTracking;
    estimate.T_world_rig = PoseAt(frame.id);
    estimate.keypoints = {{1, 1}, {2, 2}, {6, 6}, {100, 100}};
    estimate.keypoint_is_inlier = {true, false, true, true};
    if (frame.id >= 10) Sin10(&estimate);
    if (estimate.T_world_rig) track_.push_back({frame.stamp_ns, *estimate.T_world_rig});
    return estimate;
  }
  Trajectory Finish() override {
    Trajectory track;
    for (StampedPose pose : track_) {
      if (sin_ == Sin::kEndsInMicroseconds) pose.stamp_ns /= 1000;
      const bool is_key = pose.stamp_ns % (7 * kStepNs) == 0;
      if (is_key || sin_ != Sin::kEndsSparse) track.push_back(pose);
    }
    if (sin_ == Sin::kEndsInTheFuture) track.push_back({kFrames * kStepNs, PoseAt(kFrames)});
    return track;
  }
  int masked_pixels = 0;

 private:
  void Sin10(FrameEstimate* estimate) const {
    switch (sin_) {
      case Sin::kNone:
      case Sin::kEndsInMicroseconds:
      case Sin::kEndsInTheFuture:
      case Sin::kEndsSparse:
        break;
      case Sin::kBeginsAnew:
        estimate->T_world_rig = PoseAt(9).inverse() * *estimate->T_world_rig;
        estimate->counts["map_id"] = 1;
        break;
      case Sin::kGoesBackToAnOldMap:
        estimate->counts["map_id"] = -1;
        break;
      case Sin::kThrows:
        throw std::runtime_error("cannot go on");
      case Sin::kHasNoMemory:
        throw std::bad_alloc();
      case Sin::kSaysNan:
        estimate->T_world_rig->translation().x() = std::nan("");
        break;
      case Sin::kSaysFar:
        estimate->T_world_rig->translation().x() = -1e200;
        break;
      case Sin::kSaysShear:
        estimate->T_world_rig->linear()(0, 1) = 0.5;
        break;
      case Sin::kLosesTheRest:
        estimate->T_world_rig.reset();
        estimate->state = TrackingState::kLost;
        break;
      case Sin::kWrongFrame:
        estimate->id = 0;
        break;
    }
  }
  const Sin sin_;
  Trajectory track_;
};
using Sin = ScriptedEstimator::Sin;

RunResult DriveWith(Sin sin) {
  ScriptedEstimator estimator(sin);
  return Drive(CountingSequence(), estimator, MasksFromTruth(MaskSource::kNone));
}

TEST(DriveTest, EveryFrameReachesTheEstimatorInOrder) {
  const RunResult run = DriveWith(Sin::kNone);
  EXPECT_EQ(run.status, RunStatus::kOk) << run.status_why;
  ASSERT_EQ(run.estimates.size(), static_cast<std::size_t>(kFrames));
  ASSERT_EQ(run.truth.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(run.trajectory.live.size(), static_cast<std::size_t>(kFrames));
  for (int k = 0; k < kFrames; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_EQ(run.estimates[i].id, k);
    EXPECT_EQ(run.facts[i].stamp_ns, k * kStepNs);
    EXPECT_DOUBLE_EQ(run.facts[i].movers_share, 0.25);
    EXPECT_DOUBLE_EQ(run.facts[i].actors_share, 1);
    EXPECT_EQ(run.facts[i].features_on_movers, 2);
    EXPECT_EQ(run.facts[i].inliers_on_movers, 1);
  }
}

TEST(DriveTest, HowFarAheadFramesAreMadeChangesNothing) {
  for (const std::size_t ahead : {1u, 3u, 100u}) {
    ScriptedEstimator estimator;
    const RunResult run = Drive(CountingSequence(), estimator, MasksFromTruth(MaskSource::kNone),
                                {.frames_ahead = ahead, .min_coverage = 0.5});
    EXPECT_EQ(run.trajectory.final.size(), static_cast<std::size_t>(kFrames));
  }
}

TEST(DriveTest, MisbehaviourIsTheSystemsOwnVerdict) {
  const std::tuple<Sin, RunStatus, std::string> cases[] = {
      {Sin::kThrows, RunStatus::kCrashed, "frame 10: cannot go on"},
      {Sin::kSaysNan, RunStatus::kInvalid,
       "frame 10: the pose is not a rigid motion within 1e+08 m"},
      {Sin::kSaysFar, RunStatus::kInvalid,
       "frame 10: the pose is not a rigid motion within 1e+08 m"},
      {Sin::kSaysShear, RunStatus::kInvalid,
       "frame 10: the pose is not a rigid motion within 1e+08 m"},
      {Sin::kGoesBackToAnOldMap, RunStatus::kInvalid, "frame 10: its map_id falls from 0 to -1"},
      {Sin::kWrongFrame, RunStatus::kInvalid, "frame 10: the answer belongs to frame 0"},
      {Sin::kLosesTheRest, RunStatus::kLost, "poses for only 10 of 40 frames"}};
  for (const auto& [sin, status, why] : cases) {
    const RunResult run = DriveWith(sin);
    EXPECT_EQ(run.status, status);
    EXPECT_EQ(run.status_why, why);
    EXPECT_EQ(run.trajectory.live.size(), 10u);  // what was said before stands
    EXPECT_EQ(run.truth.size(), 40u) << "frames that it was never shown are not covered";
    EXPECT_DOUBLE_EQ(*ScoreRun(run).scores.at("coverage").value, 0.25);
  }
}

/// Scores compare what has the same stamp: a track of which one pose is a frame's would look exact.
TEST(DriveTest, AFinalTrackHasTheStampsOfFrames) {
  const std::pair<Sin, std::string> cases[] = {{Sin::kEndsInMicroseconds, "39 of 40 poses"},
                                               {Sin::kEndsInTheFuture, "1 of 41 poses"}};
  for (const auto& [sin, why] : cases) {
    const RunResult run = DriveWith(sin);
    EXPECT_EQ(run.status, RunStatus::kInvalid);
    EXPECT_NE(run.status_why.find(why), std::string::npos) << run.status_why;
    EXPECT_TRUE(run.trajectory.final.empty());
    EXPECT_FALSE(ScoreRun(run).scores.contains("ate_rmse_m") &&
                 ScoreRun(run).scores.at("ate_rmse_m").value);
  }
  const RunResult sparse = DriveWith(Sin::kEndsSparse);
  EXPECT_EQ(sparse.status, RunStatus::kOk) << sparse.status_why;
  EXPECT_EQ(sparse.trajectory.final.size(), 6u);
}

/// One rigid motion lays a track onto truth: poses of two worlds are no track.
TEST(DriveTest, TheLiveTrackIsOfTheLastWorld) {
  const RunResult run = DriveWith(Sin::kBeginsAnew);
  EXPECT_EQ(run.status, RunStatus::kOk) << run.status_why;
  ASSERT_EQ(run.trajectory.live.size(), 30u);
  EXPECT_EQ(run.trajectory.live.front().stamp_ns, 10 * kStepNs);
  ASSERT_EQ(run.notes.size(), 1u);
  EXPECT_NE(run.notes[0].find("frame 10: the 10 live poses"), std::string::npos) << run.notes[0];
  const Scorecard scores = ScoreRun(run).scores;
  EXPECT_NEAR(*scores.at("ate_live_rmse_m").value, 0, 1e-9);
  EXPECT_DOUBLE_EQ(*scores.at("coverage").value, 0.75);
  EXPECT_TRUE(DriveWith(Sin::kNone).notes.empty());
}

TEST(DriveTest, MemoryThatIsNotThereIsNotTheSystemsFault) {
  EXPECT_THROW(DriveWith(Sin::kHasNoMemory), std::bad_alloc);
}

TEST(DriveTest, ASequenceThatFailsIsNotTheSystemsFault) {
  CountingSequence sequence;
  sequence.fails_at = 7;
  ScriptedEstimator estimator;
  EXPECT_THROW(Drive(sequence, estimator, MasksFromTruth(MaskSource::kNone)), std::runtime_error);
}

TEST(DriveTest, MasksFromTruthReachOnlyThoseWhoAsk) {
  const std::tuple<MaskSource, int> cases[] = {
      {MaskSource::kNone, 0}, {MaskSource::kDynamic, 16}, {MaskSource::kActors, 64}};
  for (const auto& [source, pixels] : cases) {
    ScriptedEstimator estimator;
    const RunResult run = Drive(CountingSequence(), estimator, MasksFromTruth(source));
    EXPECT_EQ(estimator.masked_pixels, pixels);
    EXPECT_EQ(run.facts[0].mask.has_value(), source != MaskSource::kNone);
  }
}

TEST(FramesAheadTest, TheQueueIsBoundedAndStopsWhenItsReaderLeaves) {
  CountingSequence sequence;
  {
    FramesAhead frames(sequence, sequence.Schedule(), 2);
    EXPECT_EQ(frames.Next().frame.images.id, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_LE(sequence.made(), 4);  // one taken, two waiting, one in the maker's hands
  }
  EXPECT_LE(sequence.made(), 4);
}

}  // namespace
}  // namespace aisle
