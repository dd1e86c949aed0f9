// The same numbers as a dense, exhaustive numpy computation on trajectories of our own: see
// synthetic/make.py. Always runs, unlike the tests on real data.
#include <gtest/gtest.h>

#include <fstream>

#include "harness/io/trajectory.h"
#include "harness/score/pose_error.h"
#include "harness/score/relative_error.h"
#include "harness/score/segments.h"

namespace aisle {
namespace {

const std::string kFolder = AISLE_SOURCE_DIR "/tests/harness/score/synthetic/";

class SyntheticTest : public testing::Test {
 protected:
  void SetUp() override {
    std::ifstream file(kFolder + "values.txt");
    std::string name;
    double value = 0;
    while (file >> name >> value) values_[name] = value;
    truth_ = ReadTrajectory(kFolder + "truth.txt", TrajectoryFormat::kTum);
    estimate_ = ReadTrajectory(kFolder + "estimate.txt", TrajectoryFormat::kTum);
    pairs_ = Associate(truth_, estimate_);
    ASSERT_EQ(static_cast<double>(pairs_.size()), values_.at("pairs"));
  }

  void ExpectClose(double actual, const std::string& name) const {
    EXPECT_NEAR(actual, values_.at(name), 1e-9 * std::abs(values_.at(name))) << name;
  }
  std::vector<PoseError> Errors(AlignmentMethod method) const {
    return AbsoluteErrors(truth_, estimate_, pairs_,
                          Align(truth_, estimate_, pairs_, {.method = method}));
  }
  void ExpectRelative(const RelativeOptions& options, const std::string& name) const {
    const auto errors =
        RelativeErrors(truth_, estimate_, pairs_, SelectSpans(truth_, estimate_, pairs_, options));
    EXPECT_EQ(static_cast<double>(errors.size()), values_.at("rpe_" + name + "_n")) << name;
    ExpectClose(Summarize(Translations(errors)).rmse, "rpe_" + name + "_trans_rmse");
    ExpectClose(Summarize(Rotations(errors)).rmse, "rpe_" + name + "_rot_rmse");
  }

  std::map<std::string, double> values_;
  Trajectory truth_, estimate_;
  std::vector<PosePair> pairs_;
};

TEST_F(SyntheticTest, AbsoluteErrorsAgreeForEveryAlignment) {
  const Statistics se3 = Summarize(Translations(Errors(AlignmentMethod::kSe3)));
  ExpectClose(se3.rmse, "ate_se3_rmse");
  ExpectClose(se3.mean, "ate_se3_mean");
  ExpectClose(se3.median, "ate_se3_median");
  ExpectClose(se3.std, "ate_se3_std");
  ExpectClose(se3.min, "ate_se3_min");
  ExpectClose(se3.max, "ate_se3_max");
  ExpectClose(Summarize(Rotations(Errors(AlignmentMethod::kSe3))).rmse, "ate_se3_rot_rmse");
  ExpectClose(Summarize(Translations(Errors(AlignmentMethod::kSim3))).rmse, "ate_sim3_rmse");
  ExpectClose(Align(truth_, estimate_, pairs_, {.method = AlignmentMethod::kSim3}).scale,
              "scale_sim3");
  ExpectClose(Summarize(Translations(Errors(AlignmentMethod::kNone))).rmse, "ate_none_rmse");
  ExpectClose(Summarize(Translations(Errors(AlignmentMethod::kOrigin))).rmse, "ate_origin_rmse");
  ExpectClose(Summarize(Translations(Errors(AlignmentMethod::kPosYaw))).rmse, "ate_posyaw_rmse");
}

TEST_F(SyntheticTest, RelativeErrorsAgreeForEveryUnit) {
  ExpectRelative({}, "1f");
  ExpectRelative({.delta = 10}, "10f");
  ExpectRelative({.delta = 10, .all_pairs = true}, "10f_all");
  ExpectRelative({.delta = 1, .unit = DeltaUnit::kMetres}, "1m");
  ExpectRelative({.delta = 2, .unit = DeltaUnit::kMetres, .all_pairs = true}, "2m_all");
  ExpectRelative({.delta = 1, .unit = DeltaUnit::kSeconds, .all_pairs = true}, "1s_all");
}

TEST_F(SyntheticTest, ShortSegmentsAgree) {
  const auto errors = SegmentErrors(truth_, estimate_, pairs_, ShortSegments());
  EXPECT_EQ(static_cast<double>(errors.size()), values_.at("segments_n"));
  ExpectClose(PooledMean(errors).translation_percent, "t_rel_percent");
  ExpectClose(PooledMean(errors).rotation_deg_per_100m, "r_rel_deg_per_100m");
  ExpectClose(MeanOfLengthMeans(errors).translation_percent, "t_rel_mean_of_means_percent");
}

}  // namespace
}  // namespace aisle
