#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/score/coverage.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kStep_ns = 50'000'000;

/// A path with bends to both sides, the heading along it: no arc, whose inverse is one too.
Trajectory Drive(double off_m = 0) {
  Trajectory poses;
  Eigen::Vector3d at(0, 0, 0);
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.006 * i + 1.2 * std::sin(0.02 * i);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    at += pose.linear().col(0) * 0.05 + Eigen::Vector3d(0, 0, 0.005 * std::cos(0.05 * i));
    pose.translation() = at + off_m * Eigen::Vector3d(std::sin(50.0 * i), std::cos(31.0 * i), 0);
    poses.push_back({i * kStep_ns, pose});
  }
  return poses;
}

template <class Change>
Trajectory Changed(const Change& change) {
  Trajectory poses = Drive(0.01);
  for (StampedPose& pose : poses) change(pose);
  return poses;
}

std::vector<std::string> Notes(const Trajectory& estimate, AlignmentMethod method) {
  ScoreOptions options;
  options.alignment.method = method;
  return ScoreTrajectory(Drive(), estimate, options).notes;
}
std::vector<std::string> Notes(const Trajectory& estimate) {
  return Notes(estimate, AlignmentMethod::kSe3);
}

void Invert(StampedPose& pose) { pose.T_world_rig = pose.T_world_rig.inverse(); }

/// qw and its three read one place off, as a file with qw first is that is read with it last.
void Shift(StampedPose& pose) {
  const Eigen::Quaterniond q(pose.T_world_rig.linear());
  pose.T_world_rig.linear() = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
}
void ShiftBack(StampedPose& pose) {
  const Eigen::Quaterniond q(pose.T_world_rig.linear());
  pose.T_world_rig.linear() = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
}

TEST(ConventionsTest, WhatAgreesIsToldNothing) {
  EXPECT_THAT(Notes(Drive()), IsEmpty());
  EXPECT_THAT(Notes(Changed([](StampedPose&) {})), IsEmpty());
  const auto lost_its_way = [](StampedPose& pose) {
    const double t = static_cast<double>(pose.stamp_ns) * 1e-9;
    pose.T_world_rig.translation().x() += 2 * std::sin(t);
    pose.T_world_rig.translation().y() += 2 * std::sin(1.7 * t);
  };
  EXPECT_THAT(Notes(Changed(lost_its_way)), IsEmpty());
}

TEST(ConventionsTest, PosesFromWorldToCameraAreTold) {
  EXPECT_THAT(Notes(Changed(Invert)), ElementsAre(AllOf(HasSubstr("with every pose inverted the"),
                                                        HasSubstr("world to camera"))));
  const auto both = [](StampedPose& pose) {
    Invert(pose);
    Shift(pose);
  };
  EXPECT_THAT(Notes(Changed(both)),
              ElementsAre(HasSubstr("inverted and qw read as the first of the four")));
}

TEST(ConventionsTest, LengthsInAnotherUnitAreTold) {
  const auto times = [](double factor) {
    return Changed([=](StampedPose& pose) { pose.T_world_rig.translation() *= factor; });
  };
  EXPECT_THAT(Notes(times(1000)), ElementsAre(HasSubstr("one of the files in millimetres?")));
  EXPECT_THAT(Notes(times(100)), ElementsAre(HasSubstr("one of the files in centimetres?")));
  EXPECT_THAT(Notes(times(0.001)), ElementsAre(HasSubstr("one of the files in millimetres?")));
  EXPECT_THAT(Notes(times(3.3)), ElementsAre(HasSubstr("as a single camera's is; --align sim3")));
  EXPECT_THAT(Notes(times(1000), AlignmentMethod::kSim3), IsEmpty()) << "its scale is printed";
}

TEST(ConventionsTest, AQuaternionInTheOtherOrderIsTold) {
  EXPECT_THAT(Notes(Changed(Shift)), ElementsAre(HasSubstr("with qw read as the first of the")));
  EXPECT_THAT(Notes(Changed(ShiftBack)), ElementsAre(HasSubstr("with qw read as the last of the")));
}

TrajectoryScore ScoreOfFiles(const Trajectory& truth, const Trajectory& estimate) {
  TrajectoryScore score = ScoreTrajectory(truth, estimate);
  AddCoverageOfFiles(truth, estimate, {}, 0, &score);
  return score;
}

TEST(StampUnitTest, StampsInAnotherUnitAreNoPerfectScore) {
  for (const auto& [factor, unit] :
       {std::pair(1000, "milliseconds"), std::pair(1'000'000, "microseconds")}) {
    for (const bool of_truth : {false, true}) {
      Trajectory scaled = Drive(0.01), plain = Drive();
      for (StampedPose& pose : scaled) pose.stamp_ns *= factor;
      const TrajectoryScore score =
          of_truth ? ScoreOfFiles(scaled, plain) : ScoreOfFiles(plain, scaled);
      EXPECT_FALSE(score.scores.at("ate_rmse_m").value) << "the poses at 0 alone are a pair";
      EXPECT_FALSE(score.scores.at("error_all_p50_m").value);
      EXPECT_LT(*score.scores.at("coverage").value, 0.01);
      EXPECT_THAT(score.notes, testing::Contains(HasSubstr(unit)));
    }
  }
}

TEST(StampUnitTest, IsToldWhereNoStampMeets) {
  Trajectory truth = Drive(), estimate = Drive();
  for (StampedPose& pose : truth) pose.stamp_ns += 1'000'000'000'000;
  for (StampedPose& pose : estimate) pose.stamp_ns = (pose.stamp_ns + 1'000'000'000'000) * 1000;
  const TrajectoryScore score = ScoreOfFiles(truth, estimate);
  EXPECT_THAT(score.notes, ElementsAre(HasSubstr("no stamp of the estimate is near one"),
                                       HasSubstr("times 0.001")));
}

TEST(StampUnitTest, AnotherStretchOfTheDriveIsNoOtherUnit) {
  Trajectory later = Drive();
  for (StampedPose& pose : later) pose.stamp_ns += 300 * kStep_ns;
  EXPECT_FALSE(ScoreTrajectory(Drive(), later).stamp_factor);
}

TEST(AlignmentTest, LeavesNoErrorOfFewerPosesThanItNeeds) {
  const Trajectory truth = Drive();
  const struct {
    AlignmentMethod method;
    std::size_t fewest;
  } cases[] = {{AlignmentMethod::kNone, 1},
               {AlignmentMethod::kOrigin, 2},
               {AlignmentMethod::kPosYaw, 2},
               {AlignmentMethod::kSe3, 3},
               {AlignmentMethod::kSim3, 3}};
  for (const auto& [method, fewest] : cases) {
    ScoreOptions options;
    options.alignment.method = method;
    const Trajectory all = Drive(0.5);
    for (std::size_t count = 1; count <= 4; ++count) {
      const Trajectory some(all.begin() + 1, all.begin() + 1 + static_cast<std::ptrdiff_t>(count));
      const Score ate = ScoreTrajectory(truth, some, options).scores.at("ate_rmse_m");
      EXPECT_EQ(ate.value.has_value(), count >= fewest) << Name(method) << " of " << count;
      if (ate.value) {
        EXPECT_GT(*ate.value, 1e-6) << Name(method) << " of " << count;
      }
    }
  }
}

TEST(AlignmentTest, FramesWithAPoseAreCoveredThoughNoErrorIsLeft) {
  const Trajectory truth = Drive();
  const Trajectory two(truth.begin(), truth.begin() + 2);
  const TrajectoryScore score = ScoreOfFiles(two, two);
  EXPECT_EQ(*score.scores.at("coverage").value, 1);
  EXPECT_EQ(score.scores.at("error_all_p95_m").absent, "no frame could be judged");
}

}  // namespace
}  // namespace aisle
