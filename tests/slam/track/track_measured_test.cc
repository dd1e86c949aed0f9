#include "slam/track/track_measured.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <set>

#include "slam/optimize/observations_of.h"
#include "slam/place/place_index.h"
#include "slam/track/keyframe_policy.h"
#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kStep_ns = 50'000'000;

MeasuredMotion Measured(const Eigen::Isometry3d& T_world_now, double sigma_m, double sigma_rad) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  return {T_world_now.inverse(), variances.asDiagonal()};
}

/// A map of one keyframe at the world's origin, where the last frame was found.
class TrackMeasuredTest : public testing::Test {
 protected:
  void SetUp() override { BeginAtOrigin(world, &map, &memory); }

  std::optional<FramePose> Find(const Eigen::Isometry3d& T_world_rig, std::int64_t stamp_ns) {
    return TrackMeasured({map, *world.See(T_world_rig, stamp_ns), {}, 8, {}}, memory,
                         {nullptr, index}, 0);
  }

  PointWorld world;
  PlaceIndex index;
  Map map;
  TrackMemory memory;
};

TEST_F(TrackMeasuredTest, FindsTheFrameBetterThanItWasMeasured) {
  const Eigen::Isometry3d truth = At(0.03, 0.05, 0.5);
  const Eigen::Isometry3d said = At(0.034, 0.044, 0.35);
  memory.measured = Measured(said, 0.005, 0.003);
  const auto found = Find(truth, kStep_ns);
  ASSERT_TRUE(found);
  const double off = Difference(truth.inverse(), said.inverse()).norm();
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), off / 10);
}

/// Five of six points go along with the rig, as somebody does who walks ahead and fills the view.
TEST_F(TrackMeasuredTest, IsNotCapturedByWhoGoesAlong) {
  const Eigen::Vector3d along(0, 0, 0.3);  // the crowd reaches 14 m away, where little shows
  world.Move(0, 500, along);
  const Eigen::Isometry3d truth = At(0, 0.3);
  const auto captured = TrackFrame({map, *world.See(truth, kStep_ns), {}, 8, {}}, memory);
  ASSERT_TRUE(captured);
  EXPECT_GT(Difference(truth.inverse(), captured->pose.T_rig_world).norm(), 0.25);

  memory.measured = Measured(At(0, 0.302), 0.004, 0.002);
  const auto found = Find(truth, kStep_ns);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 0.015);
}

TEST_F(TrackMeasuredTest, BelievesNoPoseThatContradictsTheMeasuredOne) {
  world.Move(0, 600, {0, 0, 0.06});
  memory.measured = Measured(At(0, 0.06), 0.002, 0.002);
  EXPECT_FALSE(Find(At(0, 0.06), kStep_ns));
}

TEST_F(TrackMeasuredTest, TakesUpTheMapAfterAWhileOffByWhatTheMeasurementMayErr) {
  const Eigen::Isometry3d truth = At(0.4, 1.5, 4);
  memory.measured = Measured(At(0.36, 1.44, 3.2), 0.04, 0.01);
  const auto found = Find(truth, 4'000'000'000);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 2e-3);
}

TEST_F(TrackMeasuredTest, FewPointsSufficeWhereMostAreHidden) {
  world.Move(12, 600, {0, 500, 0});
  const Eigen::Isometry3d truth = At(0, 0.05);
  EXPECT_FALSE(TrackFrame({map, *world.See(truth, kStep_ns), {}, 8, {}}, memory));
  memory.measured = Measured(At(0, 0.051), 0.002, 0.002);
  const int seen = world.See(truth, kStep_ns)->size();
  const auto found = Find(truth, kStep_ns);
  EXPECT_EQ(found.has_value(), seen >= TrackOptions().measured.least_inliers) << seen;
  if (found) {
    EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-3);
  }
}

/// Nothing is measured, but the rig has gone ahead by 6 m/s. Most of the map is hidden by somebody
/// who goes along, and more is seen of him than beside him.
TEST_F(TrackMeasuredTest, ARigInMotionIsNotStoppedByWhoHidesMostOfTheMap) {
  world.Move(0, 90, {0, 0, 0.3});
  world.Move(150, 600, {0, 500, 0});
  const Eigen::Isometry3d truth = At(0, 0.3);
  const auto frame = world.See(truth, kStep_ns);
  const PlainContext context{map, *frame, {}, 8, {}};
  const auto captured = TrackCarried(context, memory, {nullptr, index}, 0);
  ASSERT_TRUE(captured);
  EXPECT_FALSE(IsConvincing(*captured, context.options));
  EXPECT_GT(Difference(truth.inverse(), captured->pose.T_rig_world).norm(), 0.25);

  memory.carried = Measured(At(0, 0.302), 0.004, 0.007);
  const auto found = TrackCarried(context, memory, {nullptr, index}, 0);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 0.015);
}

/// Somebody stands before the left camera, and so close that the right one looks past him.
class BehindSomebodyClose : public TrackMeasuredTest {
 protected:
  static constexpr double kFromLeft_px = 730, kFromRight_px = 520;
  const Eigen::Isometry3d truth = At(0, 0.05), said = At(0.003, 0.058, 0.2);
  const std::shared_ptr<const Frame> left = world.See(truth, kStep_ns, PointWorld::Eye::kLeft,
                                                      kFromLeft_px),
                                     right = world.See(truth, kStep_ns, PointWorld::Eye::kRight,
                                                       kFromRight_px);
  const TrackOptions options;
  const StereoCamera camera;
  const PlainContext left_alone{map, *left, camera, 8, options},
      both{map, *left, camera, 8, options, right.get()};
};

TEST_F(BehindSomebodyClose, TheRightCameraFindsWhatTheLeftOneDoesNotSee) {
  const auto expect_found = [&](const auto& track) {
    EXPECT_FALSE(track(left_alone));
    const auto found = track(both);
    ASSERT_TRUE(found);
    EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 0.002);
    EXPECT_LT(std::ssize(found->matches), options.measured.least_inliers);
    EXPECT_GT(found->right_matches.size(), 50u);
    ASSERT_EQ(found->pose.inlier.size(), found->matches.size() + found->right_matches.size());
    EXPECT_GT(found->pose.inliers, 50);
  };
  memory.measured = Measured(said, 0.02, 0.01);
  expect_found([&](const auto& context) {
    return TrackMeasured(context, memory, {nullptr, index}, 0);
  });
  memory.carried = std::exchange(memory.measured, std::nullopt);
  expect_found([&](const auto& context) {
    return TrackCarried(context, memory, {nullptr, index}, 0);
  });
}

TEST_F(BehindSomebodyClose, ALandmarkCountsOnceHoweverManyCamerasShowIt) {
  memory.measured = Measured(said, 0.02, 0.01);
  const auto all = world.See(truth, kStep_ns, PointWorld::Eye::kRight);
  const auto found =
      TrackMeasured({map, *left, camera, 8, options, all.get()}, memory, {nullptr, index}, 0);
  ASSERT_TRUE(found);
  std::set<LandmarkId> once;
  for (const auto* matches : {&found->matches, &found->right_matches}) {
    for (const Match& match : *matches) EXPECT_TRUE(once.insert(match.landmark).second);
  }
  EXPECT_GT(LeftInliers(*found), 0);
  EXPECT_EQ(std::ssize(InliersOfBoth(found->matches, found->right_matches, found->pose)),
            found->pose.inliers);
  const std::set<LandmarkId> expected(found->expected.begin(), found->expected.end());
  for (const LandmarkId id : once) EXPECT_TRUE(expected.contains(id));
}

/// The right camera's chance matches may not take away what the left one is sure of.
TEST_F(BehindSomebodyClose, WhereTheLeftCameraConvincesTheRightOneIsNotAsked) {
  const auto all = world.See(truth, kStep_ns);
  const PlainContext alone{map, *all, camera, 8, options},
      with_right{map, *all, camera, 8, options, right.get()};
  const auto expect_same = [&](const auto& track) {
    const auto a = track(alone), b = track(with_right);
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(b->right_matches.empty());
    EXPECT_EQ(a->pose.T_rig_world.matrix(), b->pose.T_rig_world.matrix());
  };
  memory.measured = Measured(said, 0.02, 0.01);
  expect_same([&](const auto& context) {
    return TrackMeasured(context, memory, {nullptr, index}, 0);
  });
  memory.carried = std::exchange(memory.measured, std::nullopt);
  memory.velocity = Velocity{};
  expect_same([&](const auto& context) {
    return TrackCarried(context, memory, {nullptr, index}, 0);
  });
}

/// A keyframe's links to the map are those of the left camera: without them it would be loose.
TEST_F(BehindSomebodyClose, WhatTheRightCameraAloneHasFoundIsNoKeyframe) {
  memory.measured = Measured(said, 0.02, 0.01);
  const auto found = TrackMeasured(both, memory, {nullptr, index}, 0);
  ASSERT_TRUE(found);
  KeyframeOptions keyframe{.least_motion = 0};
  EXPECT_FALSE(NeedsKeyframe(map, *left, *found, camera, keyframe));
  keyframe.least_inliers = 0;  // all else asks for one
  EXPECT_TRUE(NeedsKeyframe(map, *left, *found, camera, keyframe));
}

/// At five frames a second inertia allows for much, standing still by who goes along among it. More
/// of the map is seen from where it leads.
TEST_F(TrackMeasuredTest, WhatInertiaAllowsContendsWithWhatIsFoundWhereItLeads) {
  const Eigen::Isometry3d truth = At(0, 0.25, 5);
  world.Move(0, 60, truth);
  world.Move(180, 600, {0, 500, 0});
  const auto frame = world.See(truth, kStep_ns);
  const PlainContext context{map, *frame, {}, 8, {}};
  const auto captured = TrackFrame(context, memory);
  ASSERT_TRUE(captured);
  EXPECT_FALSE(IsConvincing(*captured, context.options));
  EXPECT_LT(Difference(memory.PoseIn(map).inverse(), captured->pose.T_rig_world).norm(), 0.01);

  memory.carried = Measured(At(0, 0.2, 3), 0.06, 0.12);
  const auto found = TrackCarried(context, memory, {nullptr, index}, 0);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 0.015);
}

TEST_F(TrackMeasuredTest, WhatExplainsAllThatShouldBeSeenIsBelievedAgainstInertia) {
  const Eigen::Isometry3d truth = At(0, 0);  // an emergency stop
  memory.velocity = Velocity{};
  memory.carried = Measured(At(0, 0.3), 0.004, 0.007);
  const auto frame = world.See(truth, kStep_ns);
  const auto found = TrackCarried({map, *frame, {}, 8, {}}, memory, {nullptr, index}, 0);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-3);
}

/// Both err independently, so that they meet where a Kalman filter has them meet.
TEST_F(TrackMeasuredTest, InertiaCountsWhereItKnowsMoreThanTheImages) {
  memory.velocity = Velocity{};
  memory.carried = Measured(At(0.004, 0.303, 0.03), 0.004, 0.001);
  const auto sure =
      TrackCarried({map, *world.See(At(0, 0.3), kStep_ns), {}, 8, {}}, memory, {nullptr, index}, 0);
  ASSERT_TRUE(sure);
  EXPECT_FALSE(sure->seen);

  memory.carried = Measured(At(0.0004, 0.3003, 0.003), 4e-4, 1e-4);
  const Eigen::Isometry3d truth = At(0, 0.3);
  const auto frame = world.See(truth, kStep_ns);
  const auto found = TrackCarried({map, *frame, {}, 8, {}}, memory, {nullptr, index}, 0);
  ASSERT_TRUE(found);
  ASSERT_TRUE(found->seen);
  EXPECT_EQ(found->pose.inliers, found->seen->inliers);
  const Eigen::Isometry3d led = memory.carried->T_now_before * memory.PoseIn(map).inverse();
  const Matrix6d &P = memory.carried->covariance, S = found->seen->covariance;
  const Vector6d moved = P * (P + S).ldlt().solve(Difference(led, found->seen->T_rig_world));
  EXPECT_LT((Difference(led, found->pose.T_rig_world) - moved).norm(), 0.02 * moved.norm());
  EXPECT_GT(Difference(found->seen->T_rig_world, found->pose.T_rig_world).norm(), 1e-5);
  EXPECT_LT(found->pose.covariance.trace(), S.trace());
}

/// The drive has just begun: what the images have shown of the rig's motion is no inertia, which a
/// jolt or a brake may belie. The crowd is all that should be seen.
TEST_F(TrackMeasuredTest, ADriveThatBeginsBehindACrowdDoesNotGoAlongWithIt) {
  world.Move(0, 500, {0, 0, 0.3});
  const Eigen::Isometry3d truth = At(0, 0.3);
  const auto frame = world.See(truth, kStep_ns);
  const PlainContext context{map, *frame, {}, 8, {}};
  memory.velocity = Velocity{};
  memory.carried = Measured(At(0, 0.302), 0.004, 0.007);
  const auto captured = TrackCarried(context, memory, {nullptr, index}, 0);
  ASSERT_TRUE(captured);
  EXPECT_TRUE(IsConvincing(*captured, context.options));
  EXPECT_GT(Difference(truth.inverse(), captured->pose.T_rig_world).norm(), 0.25);

  memory.velocity.reset();
  const auto found = TrackCarried(context, memory, {nullptr, index}, 0);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 0.015);
}

/// A pose in which the measured one has counted itself differs from that by less than what the
/// images tell alone does; believed are both in the same measure. Here they see but who goes ahead.
TEST_F(TrackMeasuredTest, WhoFillsTheViewIsBelievedAsFarAsTheImagesAloneWouldBe) {
  constexpr double kSigma_m = 0.03, kStep_m = 0.02;
  const double most_chi2 = TrackOptions().measured.most_chi2;
  memory.measured = Measured(At(0, 0), kSigma_m, 1e-3);
  world.Move(0, 560, {0, 500, 0});
  double last_believed_m = 0;
  for (double ahead_m = 0; ahead_m < 0.6;
       ahead_m += kStep_m, world.Move(560, 600, {0, 0, kStep_m})) {
    const auto frame = world.See(At(0, 0), kStep_ns);
    const PlainContext context{map, *frame, {}, 8, {}};
    const auto found = TrackMeasured(context, memory, {nullptr, index}, 0);
    if (!found) continue;
    last_believed_m = ahead_m;
    std::vector<Match> kept;
    for (std::size_t i = 0; i < found->matches.size(); ++i) {
      if (found->pose.inlier[i]) kept.push_back(found->matches[i]);
    }
    const RefinedPose alone =
        RefinePose({}, found->pose.T_rig_world, ObservationsOf(map, *frame, kept), {});
    ASSERT_TRUE(alone.well_posed);
    const Vector6d off = Difference(memory.measured->T_now_before, alone.T_rig_world);
    const Matrix6d covariance = memory.measured->covariance + alone.covariance;
    EXPECT_LT(off.dot(covariance.ldlt().solve(off)), 1.2 * most_chi2) << ahead_m;
  }
  EXPECT_GT(last_believed_m, kSigma_m);
  EXPECT_LT(last_believed_m, 0.5) << "nothing was put to the question";
}

/// It stopped in the dark, a long way from where it was seen last, and is before another keyframe.
TEST_F(TrackMeasuredTest, HowItWentBeforeTheDarkSaysNothingOfWhereItIs) {
  const Eigen::Isometry3d there = At(30, 0, 180);
  Keyframe keyframe;
  keyframe.id = map.NextKeyframeId();
  keyframe.parent = memory.reference;
  keyframe.T_world_rig = there;
  PointWorld hall = world;
  hall.Move(0, 600, there);
  keyframe.frame = hall.See(there, 0);
  keyframe.landmarks.resize(static_cast<std::size_t>(keyframe.frame->size()));
  MapEdit edit;
  edit.new_landmarks = CreateLandmarks(keyframe, {}, {});
  edit.new_keyframes = {keyframe};
  map.Apply(edit);

  memory.stamp_ns = 60'000'000'000;
  memory.T_reference_rig = At(30, 0.1, 180);
  memory.steady_motion = EstimateMotion(At(0, 0), At(0, 0.05), 0.05);
  memory.measured = Measured(At(0, 0), 0.1, 0.02);
  const auto frame = hall.See(there, memory.stamp_ns + kStep_ns);
  const auto found = TrackMeasured({map, *frame, {}, 8, {}}, memory, {nullptr, index}, 0);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(there.inverse(), found->pose.T_rig_world).norm(), 1e-3);
}

/// The rig was last seen at the origin, going ahead by a metre a second; racks look alike.
TEST_F(TrackMeasuredTest, NoRigIsAtTheNextRackAtOnce) {
  memory.steady_motion = EstimateMotion(At(0, 0), At(0, 0.05), 0.05);
  const auto frame = world.See(At(0, 1), 1'000'000'000);
  const auto CanBe = [&](const Eigen::Isometry3d& pose, const TrackMemory& known) {
    FramePose found;
    found.pose.T_rig_world = pose.inverse();
    return CanBeThere({map, *frame, {}, 8, {}}, known, found);
  };
  EXPECT_TRUE(CanBe(At(0, 1.1), memory));
  EXPECT_FALSE(CanBe(At(2.7, 1), memory));
  EXPECT_FALSE(CanBe(At(0, 1, 90), memory));
  memory.steady_motion.reset();
  EXPECT_TRUE(CanBe(At(2.7, 1), memory));
}

}  // namespace
}  // namespace aisle::slam
