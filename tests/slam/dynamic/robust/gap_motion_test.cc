#include "slam/dynamic/robust/gap_motion.h"

#include <gtest/gtest.h>

#include "slam/camera/measured_motion.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::int64_t kStampNs = 1'000'000'000, kStepNs = 50'000'000;

Isometry3d Ahead(double metres) { return Isometry3d(Eigen::Translation3d(0, 0, -metres)); }

MeasuredMotion Known(double ahead_m, double variance) {
  return {Ahead(ahead_m), variance * Matrix6d::Identity()};
}

/// A rig that has gone ahead by 5 cm in a twentieth of a second.
RobustState Driving() {
  RobustState state;
  state.stamp_ns = kStampNs;
  state.step_s = 0.05;
  state.motion = EgoMotion{
      .found = true, .T_now_before = Ahead(0.05), .covariance = 1e-6 * Matrix6d::Identity()};
  return state;
}

TEST(PriorFor, WhatIsMeasuredCountsBeforeWhatIsExpectedAndThatBeforeInertia) {
  const MeasuredMotion measured = Known(0.03, 1e-6), expected = Known(0.04, 1e-5);
  const auto z = [&](const KnownMotion& known) {
    return PriorFor(Driving(), kStampNs + kStepNs, known, {})->T_now_before.translation().z();
  };
  EXPECT_DOUBLE_EQ(z({expected, measured}), -0.03);
  EXPECT_DOUBLE_EQ(z({expected, {}}), -0.04);
  EXPECT_NEAR(z({}), -0.05, 1e-12);
  const auto both = PriorFor(Driving(), kStampNs + kStepNs, {expected, measured}, {});
  EXPECT_TRUE(both->measured);
  EXPECT_TRUE(both->covariance.isApprox(measured.covariance));
  EXPECT_FALSE(PriorFor(Driving(), kStampNs + kStepNs, {expected, {}}, {})->measured);
  EXPECT_FALSE(PriorFor(RobustState(), kStampNs, {}, {})) << "nothing is known in the first frame";
}

TEST(PriorFor, InertiaGoesOnAsLongAsTheStepAndErrsWithTheSquareOfTime) {
  const EgoMotionOptions options;
  const auto prior = PriorFor(Driving(), kStampNs + 3 * kStepNs, {}, options);
  ASSERT_TRUE(prior);
  EXPECT_LT((prior->T_now_before.translation() - Vector3d(0, 0, -0.15)).norm(), 1e-9);
  const double off_m = options.acceleration_mps2 * 0.15 * 0.15;
  const double off_rad = options.angular_acceleration_radps2 * 0.15 * 0.15;
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(prior->covariance(k, k), 9e-6 + std::pow(k < 3 ? off_m : off_rad, 2), 1e-12) << k;
  }
}

/// The caller counts from the last frame, which nobody could look at; the method from the one
/// before.
TEST(PriorFor, WhatIsKnownSinceTheLastFrameComesAfterTheWayThatNobodySaw) {
  RobustState state = Driving();
  state.unseen_way = Known(0.05, 1e-5);
  const MeasuredMotion last = Known(0.04, 1e-6), whole = Compose(*state.unseen_way, last);
  for (const KnownMotion& known : {KnownMotion{last, {}}, KnownMotion{{}, last}}) {
    const auto prior = PriorFor(state, kStampNs + 2 * kStepNs, known, {});
    ASSERT_TRUE(prior);
    EXPECT_NEAR(prior->T_now_before.translation().z(), -0.09, 1e-12);
    EXPECT_TRUE(prior->covariance.isApprox(whole.covariance));
  }
  // Inertia is that of the step that was seen, and knows of the whole time itself.
  const auto inertia = PriorFor(state, kStampNs + 2 * kStepNs, {}, {});
  EXPECT_NEAR(inertia->T_now_before.translation().z(), -0.1, 1e-12);
}

/// The deviations of a jolt during a step: of translation, then of rotation.
Vector6d JoltOf(std::int64_t step_ns, const EgoMotionOptions& options = {}) {
  const auto prior = PriorFor(Driving(), kStampNs + step_ns, {}, options);
  EXPECT_TRUE(prior->jolt.isDiagonal());
  return prior->jolt.diagonal().cwiseSqrt();
}

TEST(PriorFor, AJoltIsHeavePitchAndRollAlone) {
  const Vector6d jolt = JoltOf(kStepNs);
  Vector6d expected;
  expected << 0, 0.025, 0, 0.05, 0, 0.05;
  EXPECT_TRUE(jolt.isApprox(expected)) << jolt.transpose();
  const MeasuredMotion any = Known(0.04, 1e-6);
  const auto guessed = PriorFor(Driving(), kStampNs + kStepNs, {any, {}}, {});
  EXPECT_TRUE(guessed->jolt.isApprox(Matrix6d(jolt.cwiseAbs2().asDiagonal())));
  const auto measured = PriorFor(Driving(), kStampNs + kStepNs, {{}, any}, {});
  EXPECT_TRUE(measured->jolt.isZero());
}

TEST(PriorFor, AJoltIsNoHigherThanASillHoweverLongTheStep) {
  const Vector6d tenth = JoltOf(100'000'000), half = JoltOf(500'000'000);
  Vector6d highest;
  highest << 0, 0.1, 0, 0.2, 0, 0.2;
  EXPECT_TRUE(tenth.isApprox(highest)) << tenth.transpose();
  EXPECT_TRUE(half.isApprox(highest)) << half.transpose();
  EgoMotionOptions smooth;
  smooth.jolt_mps2 = smooth.jolt_radps2 = 0;
  EXPECT_TRUE(JoltOf(500'000'000, smooth).isZero());
}

TEST(LearningRate, OfTheLongerGapsIsThatOfAllTheirTurnsTogether) {
  ToleranceOptions options;
  options.learning_rate = 0.2;
  EXPECT_DOUBLE_EQ(LearningRate(0, options), 0.2);
  for (std::size_t slot = 1; slot < kSlots; ++slot) {
    EXPECT_DOUBLE_EQ(LearningRate(slot, options), 1 - 0.8 * 0.8 * 0.8) << slot;
  }
}

/// A rig that has gone towards a wall, 5 m away now, by the same way in each step.
struct Approach {
  StereoCamera half = HalfCamera(test::kHalfCamera);
  double step_m;
  RobustState state;
  View view;

  Approach(int frames, double step) : step_m(step) {
    DenseFrame frame;
    frame.image.create(half.height, half.width);
    cv::RNG random(1);
    random.fill(frame.image, cv::RNG::UNIFORM, 0, 256);
    const double disparity = half.fx * half.baseline_m / 5;
    frame.filled = cv::Mat1f(frame.image.size(), static_cast<float>(disparity));
    for (int k = 0; k < frames; ++k) {
      frame.T_world_rig.translation().z() = step_m * k;
      state.frames = WithFrame(std::move(state.frames), frame);
    }
    view.frame = frame;
    view.pyramid = MakeFlowPyramid(frame.image, {});
  }

  /// Slot and gap of all that are followed when the slot `before` had its turn last.
  std::vector<std::pair<std::size_t, int>> GapsAfter(std::size_t before) {
    state.long_slot = before;
    std::vector<std::pair<std::size_t, int>> gaps;
    for (const GapFlow& flow : FollowGaps(state, view, Ahead(step_m), half, {})) {
      gaps.emplace_back(flow.slot, flow.gap);
    }
    return gaps;
  }
};

using Gaps = std::vector<std::pair<std::size_t, int>>;
constexpr std::size_t kBeforeKeyframe = kKeyframeSlot - 1;

TEST(FollowGaps, EachOfTheLongerOnesHasItsTurn) {
  Approach standing(25, 0);
  EXPECT_EQ(standing.GapsAfter(0), Gaps({{0, 1}, {1, 5}}));
  EXPECT_EQ(standing.GapsAfter(1), Gaps({{0, 1}, {2, 15}}));
  EXPECT_EQ(standing.GapsAfter(2), Gaps({{0, 1}, {kKeyframeSlot, 25}}));
  EXPECT_EQ(standing.GapsAfter(3), Gaps({{0, 1}, {1, 5}}));
}

TEST(FollowGaps, TheKeyframeIsTheOldestThatSawTheSceneAlike) {
  EXPECT_EQ(Approach(25, 0).GapsAfter(kBeforeKeyframe), Gaps({{0, 1}, {kKeyframeSlot, 25}}));
  EXPECT_EQ(Approach(25, 0.02).GapsAfter(kBeforeKeyframe), Gaps({{0, 1}, {kKeyframeSlot, 25}}));
  // The oldest saw the wall smaller by 17.5 %, that of 20 frames ago by 14 %.
  EXPECT_EQ(Approach(25, 0.035).GapsAfter(kBeforeKeyframe), Gaps({{0, 1}, {kKeyframeSlot, 20}}));
  EXPECT_EQ(Approach(25, 0.1).GapsAfter(kBeforeKeyframe), Gaps({{0, 1}, {1, 5}})) << "none";
}

TEST(FollowGaps, WhatThePastDoesNotReachHasNoTurn) {
  EXPECT_EQ(Approach(0, 0).GapsAfter(0), Gaps());
  EXPECT_EQ(Approach(3, 0).GapsAfter(0), Gaps({{0, 1}}));
  EXPECT_EQ(Approach(10, 0).GapsAfter(1), Gaps({{0, 1}, {1, 5}}));
}

}  // namespace
}  // namespace aisle::slam::dynamic
