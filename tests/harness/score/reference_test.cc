// Real trajectories of three public data sets against values computed once by evo (commit 26d0953)
// and by the KITTI and TUM benchmarks' own programs. Skipped where the files are absent.
#include <gtest/gtest.h>

#include "harness/io/trajectory.h"
#include "harness/score/coverage.h"
#include "harness/score/pose_error.h"
#include "harness/score/relative_error.h"
#include "harness/score/segments.h"
#include "tests/support/test_data.h"

namespace aisle {
namespace {

constexpr double kRelative = 1e-9;

#define EXPECT_CLOSE(actual, expected) EXPECT_NEAR(actual, expected, std::abs(expected) * kRelative)

struct Case {
  Trajectory truth, estimate;
  std::vector<PosePair> pairs;
};

std::filesystem::path Folder() { return TestData("trajectories"); }

Case Load(const std::string& truth, TrajectoryFormat truth_format, const std::string& estimate,
          TrajectoryFormat estimate_format, AssociationRule rule) {
  Case loaded{ReadTrajectory(Folder() / truth, truth_format),
              ReadTrajectory(Folder() / estimate, estimate_format),
              {}};
  loaded.pairs = Associate(loaded.truth, loaded.estimate, {.rule = rule});
  return loaded;
}

Case Kitti() {
  return Load("KITTI_00_gt.txt", TrajectoryFormat::kKitti, "KITTI_00_ORB.txt",
              TrajectoryFormat::kKitti, AssociationRule::kIndex);
}
Case Euroc() {
  return Load("V102_groundtruth.csv", TrajectoryFormat::kEuroc, "V102.txt", TrajectoryFormat::kTum,
              AssociationRule::kEvo);
}
Case Desk(AssociationRule rule) {
  return Load("fr2_desk_groundtruth.txt", TrajectoryFormat::kTum, "fr2_desk_ORB.txt",
              TrajectoryFormat::kTum, rule);
}

std::vector<PoseError> Errors(const Case& c, AlignmentMethod method) {
  return AbsoluteErrors(c.truth, c.estimate, c.pairs,
                        Align(c.truth, c.estimate, c.pairs, {.method = method}));
}
double AteRmse(const Case& c, AlignmentMethod method) {
  return Summarize(Translations(Errors(c, method))).rmse;
}
double AngleRmse(const Case& c) {
  return Summarize(Rotations(Errors(c, AlignmentMethod::kSe3))).rmse;
}

struct Relative {
  std::size_t n = 0;
  double trans_rmse = 0, angle_rmse = 0;
};
Relative Rpe(const Case& c, RelativeOptions options) {
  options.along_estimate = true;  // as evo measures metres
  const auto errors = RelativeErrors(c.truth, c.estimate, c.pairs,
                                     SelectSpans(c.truth, c.estimate, c.pairs, options));
  return {errors.size(), Summarize(Translations(errors)).rmse, Summarize(Rotations(errors)).rmse};
}
Relative Metres(const Case& c, double delta, bool all_pairs) {
  return Rpe(c, {.delta = delta, .unit = DeltaUnit::kMetres, .all_pairs = all_pairs});
}

class ReferenceTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(Folder())) {
      GTEST_SKIP() << "no real trajectories in " << Folder();
    }
  }
};

TEST_F(ReferenceTest, Kitti00AbsoluteErrorsAreEvos) {
  const Case c = Kitti();
  ASSERT_EQ(c.pairs.size(), 4541u);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kNone), 7.790288882656827);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kSe3), 1.3034497145650565);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kSim3), 0.9377090736114021);
  EXPECT_NEAR(AteRmse(c, AlignmentMethod::kOrigin), 7.790305225, 5e-10 * 2);
  EXPECT_CLOSE(Align(c.truth, c.estimate, c.pairs, {.method = AlignmentMethod::kSim3}).scale,
               1.0046980764526634);
  EXPECT_CLOSE(AngleRmse(c), 0.7563005141572693);
}

TEST_F(ReferenceTest, Kitti00RelativeErrorsAreEvos) {
  const Case c = Kitti();
  const Relative frame = Rpe(c, {});
  EXPECT_EQ(frame.n, 4540u);
  EXPECT_CLOSE(frame.trans_rmse, 0.028120377017393464);
  EXPECT_CLOSE(frame.angle_rmse, 0.11497352089152525);
  const Relative frames = Rpe(c, {.delta = 10});
  EXPECT_EQ(frames.n, 454u);
  EXPECT_NEAR(frames.trans_rmse, 0.194007758, 1e-9);
  const Relative metre = Metres(c, 1, false), all = Metres(c, 1, true);
  EXPECT_EQ(metre.n, 2717u);
  EXPECT_CLOSE(metre.trans_rmse, 0.04569220460521677);
  EXPECT_EQ(all.n, 1838u);
  EXPECT_CLOSE(all.trans_rmse, 0.04393235624001773);
  const Relative ten = Metres(c, 10, false), ten_all = Metres(c, 10, true);
  EXPECT_EQ(ten.n, 353u);
  EXPECT_CLOSE(ten.trans_rmse, 0.22626134329310083);
  EXPECT_EQ(ten_all.n, 4533u);
  EXPECT_CLOSE(ten_all.trans_rmse, 0.23076404868596073);
}

TEST_F(ReferenceTest, Kitti00SegmentsAreTheBenchmarks) {
  const Case c = Kitti();
  const auto errors = SegmentErrors(c.truth, c.estimate, c.pairs);
  const SegmentScore score = PooledMean(errors);
  EXPECT_EQ(score.segments, 3283u);
  EXPECT_CLOSE(score.translation_percent, 0.6997286638583283);
  EXPECT_CLOSE(score.rotation_deg_per_100m, 0.2533302348329901);
  // These were printed by the benchmark's program, which sums the path in float: a segment here and
  // there ends a frame earlier or later.
  const double by_length[] = {1.009080, 0.874378, 0.780862, 0.718874,
                              0.655320, 0.571993, 0.492590, 0.415861};
  for (std::size_t k = 0; k < 8; ++k) {
    std::vector<SegmentError> of_length;
    for (const SegmentError& error : errors) {
      if (error.length_m == 100 * static_cast<double>(k + 1)) of_length.push_back(error);
    }
    EXPECT_NEAR(PooledMean(of_length).translation_percent, by_length[k], 1e-4);
  }
}

TEST_F(ReferenceTest, EurocV102IsEvos) {
  const Case c = Euroc();
  ASSERT_EQ(c.pairs.size(), 798u);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kNone), 2.5541740462181335);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kSe3), 0.09172711520685754);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kSim3), 0.08384138804295287);
  EXPECT_NEAR(AteRmse(c, AlignmentMethod::kOrigin), 0.153678892, 1e-9);
  EXPECT_CLOSE(AngleRmse(c), 2.7167713602780568);
  const Relative frame = Rpe(c, {}), metre = Metres(c, 1, false), all = Metres(c, 1, true);
  EXPECT_CLOSE(frame.trans_rmse, 0.015076710159641328);
  EXPECT_CLOSE(frame.angle_rmse, 0.3576155948859286);
  EXPECT_EQ(metre.n, 71u);
  EXPECT_CLOSE(metre.trans_rmse, 0.05323434230745979);
  EXPECT_EQ(all.n, 762u);
  EXPECT_CLOSE(all.trans_rmse, 0.05666597274412566);
}

TEST_F(ReferenceTest, EurocV102ShortSegmentsDependOnWhichMean) {
  const Case c = Euroc();
  const auto errors = SegmentErrors(c.truth, c.estimate, c.pairs, ShortSegments());
  EXPECT_EQ(errors.size(), 431u);
  EXPECT_NEAR(PooledMean(errors).translation_percent, 0.901884, 5e-7);
  EXPECT_NEAR(MeanOfLengthMeans(errors).translation_percent, 0.797286, 5e-7);
}

TEST_F(ReferenceTest, TumDeskIsEvos) {
  const Case c = Desk(AssociationRule::kEvo);
  ASSERT_EQ(c.pairs.size(), 2174u);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kNone), 3.17399354190223);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kSe3), 0.008118977562044912);
  EXPECT_CLOSE(AteRmse(c, AlignmentMethod::kSim3), 0.006123163030157227);
  EXPECT_CLOSE(AngleRmse(c), 0.9890356583679109);
  const Relative frame = Rpe(c, {}), metre = Metres(c, 1, false), all = Metres(c, 1, true);
  EXPECT_CLOSE(frame.trans_rmse, 0.0034903213747872895);
  EXPECT_CLOSE(frame.angle_rmse, 0.28051922626732667);
  EXPECT_EQ(metre.n, 18u);
  EXPECT_CLOSE(metre.trans_rmse, 0.011653475308426513);
  EXPECT_EQ(all.n, 1933u);
  EXPECT_CLOSE(all.trans_rmse, 0.011672673372666368);
}

TEST_F(ReferenceTest, TumDeskByTheTumScriptsRule) {
  const Case c = Desk(AssociationRule::kTum);
  EXPECT_EQ(c.pairs.size(), 2223u);
  EXPECT_NEAR(AteRmse(c, AlignmentMethod::kSe3), 0.008144, 5e-7);
}

/// Whoever asks for nothing gets evo's figures of a dense truth, but for stamps half-way between
/// two of it, which evo's doubles push to either side.
TEST_F(ReferenceTest, MotionCaptureIsPairedAsEvoDoes) {
  const Case desk = Desk(AssociationRule::kNearest);
  EXPECT_EQ(desk.pairs.size(), 2174u);
  EXPECT_NEAR(AteRmse(desk, AlignmentMethod::kSe3), 0.008118977562044912, 1e-7);
  const Case v102 = Load("V102_groundtruth.csv", TrajectoryFormat::kEuroc, "V102.txt",
                         TrajectoryFormat::kTum, AssociationRule::kNearest);
  EXPECT_EQ(v102.pairs.size(), 798u);
  EXPECT_NEAR(AteRmse(v102, AlignmentMethod::kSe3), 0.09172711520685754, 1e-5);
}

/// Its estimate has no hole above 0.0683 s; the truth has some of up to twelve seconds.
TEST_F(ReferenceTest, TumDeskIsNeverLost) {
  const Case c = Desk(AssociationRule::kNearest);
  TrajectoryScore score = ScoreTrajectory(c.truth, c.estimate, {});
  AddCoverageOfFiles(c.truth, c.estimate, {}, 0, &score);
  EXPECT_EQ(*score.scores.at("times_lost").value, 0);
  EXPECT_TRUE(score.scores.at("error_all_p95_m").value);
  // It begins 0.493 s after the truth, which are fifteen frames of 32 ms.
  EXPECT_NEAR(*score.scores.at("coverage").value, 2893.0 / (2893 + 15), 1e-12);
}

}  // namespace
}  // namespace aisle
