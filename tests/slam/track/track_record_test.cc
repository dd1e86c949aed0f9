#include "slam/track/track_record.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kStepNs = 50'000'000;

MeasuredMotion Forward(double metres) {
  MeasuredMotion motion{Eigen::Isometry3d::Identity(), 1e-6 * Matrix6d::Identity()};
  motion.T_now_before.translation().z() = -metres;
  return motion;
}

/// Of a rig that was found at the origin, and before that a step behind if it `goes_on`.
TrackRecord FoundAtOrigin(bool goes_on) {
  PointWorld world;
  Map map;
  TrackMemory memory;
  BeginAtOrigin(world, &map, &memory);
  FramePose pose = PoseOfKeyframe(map, memory.reference);
  pose.pose.covariance = 1e-6 * Matrix6d::Identity();
  TrackRecord record;
  record.Note(map, *world.See(At(0, 0), 0), pose, false, {});
  if (goes_on) record.Note(map, *world.See(At(0, 0), kStepNs), pose, true, {});
  return record;
}

TEST(TrackRecord, TheFirstStepIsAsTheImagesShowIt) {
  TrackRecord record = FoundAtOrigin(false);
  record.Roll({}, kStepNs, {}, Forward(0.05));
  ASSERT_TRUE(record.memory().carried);
  EXPECT_NEAR(record.memory().carried->T_now_before.translation().z(), -0.05, 1e-12);
  EXPECT_NEAR(record.memory().carried->covariance(2, 2), 2e-6, 1e-12);  // and of the pose before
  record.Roll({}, kStepNs, {});
  EXPECT_FALSE(record.memory().carried);
}

TEST(TrackRecord, ALaterOneIsAsInertiaCarriesIt) {
  TrackRecord record = FoundAtOrigin(true);
  record.Roll({}, 2 * kStepNs, {}, Forward(0.05));
  ASSERT_TRUE(record.memory().carried);
  EXPECT_NEAR(record.memory().carried->T_now_before.translation().z(), 0, 1e-9);
}

/// Of a rig that was at the origin one step ago.
TrackMemory Coasted(const std::optional<MeasuredMotion>& measured,
                    const std::optional<MeasuredMotion>& seen) {
  PointWorld world;
  Map map;
  TrackMemory memory;
  BeginAtOrigin(world, &map, &memory);
  TrackRecord record = FoundAtOrigin(false);
  record.Roll(measured, kStepNs, {}, seen);
  record.Coast(map, kStepNs, {});
  EXPECT_EQ(record.memory().stamp_ns, kStepNs);
  EXPECT_NEAR(record.memory().PoseIn(map).translation().z(), 0.05, 1e-12);
  return record.memory();
}

TEST(TrackRecord, WhereTheRigIsCarriedIsNotKnownWhatIsMeasuredIs) {
  const TrackMemory carried = Coasted({}, Forward(0.05));
  EXPECT_EQ(carried.known_ns, 0);
  EXPECT_NEAR(carried.T_rig_known.translation().z(), -0.05, 1e-12);
  const TrackMemory measured = Coasted(Forward(0.05), {});
  EXPECT_EQ(measured.known_ns, kStepNs);
  EXPECT_EQ(measured.T_rig_known.translation().z(), 0);
}

TEST(TrackRecord, WhatIsMeasuredNeedsNeither) {
  TrackRecord record = FoundAtOrigin(false);
  record.Roll(Forward(0.04), kStepNs, {}, Forward(0.05));
  EXPECT_FALSE(record.memory().carried);
  ASSERT_TRUE(record.memory().measured);
  EXPECT_NEAR(record.memory().measured->T_now_before.translation().z(), -0.04, 1e-12);
}

/// A rig that has been seen driving round a bend and then goes on in the dark, for as long as not.
class InTheDark : public testing::Test {
 protected:
  static constexpr int kSeen = 20, kDark = 20;
  static constexpr double kStep_s = 1e-9 * kStepNs;

  void SetUp() override {
    TrackMemory memory;
    BeginAtOrigin(world, &map, &memory);
    options.inertia = {.acceleration_mps2 = 0.5, .angular_acceleration_radps2 = 0.1};
    driving << 0.1, 0, -1, 0, 0.2, 0;
    Eigen::Isometry3d T_rig_world = Eigen::Isometry3d::Identity();
    for (int k = 0; k < kSeen; ++k) {
      Find(record, T_rig_world, k);
      T_rig_world = Retract(T_rig_world, driving * kStep_s);
    }
    seen = record.memory();
    for (int k = kSeen; k < kSeen + kDark; ++k) {
      record.Roll({}, k * kStepNs, options.inertia);
      record.Coast(map, k * kStepNs, options.inertia);
    }
  }

  void Find(TrackRecord& noted, const Eigen::Isometry3d& T_rig_world, int frame) {
    FramePose pose = PoseOfKeyframe(map, map.keyframes().begin()->first);
    pose.pose.T_rig_world = T_rig_world;
    pose.pose.covariance = kSigma * kSigma * Matrix6d::Identity();
    Frame now;
    now.stamp_ns = frame * kStepNs;
    noted.Note(map, now, pose, frame > 0, options);
  }

  /// What the rig may truly have done since it was seen last, by its inertia: a sample.
  struct Truth {
    Eigen::Isometry3d T_rig_world;
    Vector6d velocity;
  };
  Truth Sample(int frames) {
    const auto noise = [&](const Matrix6d& covariance) {
      Vector6d white;
      for (double& one : white) one = normal(random);
      return Vector6d(covariance.llt().matrixL() * white);
    };
    Truth truth{Retract(seen.PoseIn(map).inverse(), noise(seen.covariance)),
                seen.velocity->per_second + noise(seen.velocity->covariance)};
    Vector6d deviation;
    deviation << Eigen::Vector3d::Constant(options.inertia.acceleration_mps2 * kStep_s),
        Eigen::Vector3d::Constant(options.inertia.angular_acceleration_radps2 * kStep_s);
    for (int k = 0; k < frames; ++k) {
      truth.velocity += noise(deviation.cwiseAbs2().asDiagonal());
      truth.T_rig_world = Retract(truth.T_rig_world, truth.velocity * kStep_s);
    }
    return truth;
  }

  static double Chi2(const Vector6d& off, const Matrix6d& covariance) {
    return off.dot(covariance.ldlt().solve(off));
  }

  static constexpr double kSigma = 1e-3;
  PointWorld world;
  Map map;
  TrackOptions options;
  Vector6d driving;
  TrackRecord record;
  TrackMemory seen;
  std::mt19937_64 random{1};
  std::normal_distribution<double> normal;
};

TEST_F(InTheDark, ItIsKnownWhereTheRigIsAsWellAsIsSaid) {
  const Eigen::Isometry3d guess = record.memory().PoseIn(map).inverse();
  constexpr int kSamples = 2000;
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    sum += Chi2(Difference(guess, Sample(kDark).T_rig_world), record.memory().covariance);
  }
  EXPECT_NEAR(sum / kSamples / 6, 1, 0.05);  // the mean of chi-square over its degrees of freedom
}

/// A velocity that is wrong by e has led wrong by e t; accelerations by a, each of a frame of its
/// own, change what follows them: a^2 t^3 dt / 3.
TEST_F(InTheDark, TheErrorGrowsAsThatOfOneVelocity) {
  const double t = kDark * kStep_s;
  const double a = options.inertia.angular_acceleration_radps2;
  const double expected = seen.covariance(4, 4) + t * t * seen.velocity->covariance(4, 4) +
                          a * a * t * t * t * kStep_s / 3;
  EXPECT_NEAR(record.memory().covariance(4, 4) / expected, 1, 0.1);
}

TEST_F(InTheDark, FoundAgainTheRigIsAsFastAsIsSaid) {
  constexpr int kSamples = 1000;
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Truth truth = Sample(kDark + 1);
    Vector6d error;
    for (double& one : error) one = kSigma * normal(random);
    TrackRecord found = record;
    Find(found, Retract(truth.T_rig_world, error), kSeen + kDark);
    const Velocity& velocity = *found.memory().velocity;
    sum += Chi2(truth.velocity - velocity.per_second, velocity.covariance);
    ASSERT_TRUE(found.memory().motion);
    EXPECT_EQ(found.memory().motion->per_second, velocity.per_second);
  }
  EXPECT_NEAR(sum / kSamples / 6, 1, 0.1);
}

TEST_F(InTheDark, WhatWasWrongWithTheGuessIsNoMotion) {
  // It has braked by half a metre a second in the second that nobody saw.
  const Eigen::Isometry3d guess = record.memory().PoseIn(map).inverse();
  Vector6d behind = driving * kStep_s;
  behind[2] += 0.25;
  Find(record, Retract(guess, behind), kSeen + kDark);
  for (const auto& motion : {record.memory().motion, record.memory().steady_motion}) {
    ASSERT_TRUE(motion);  // a step of a twentieth of a second had said 4 m/s backwards
    EXPECT_LT(motion->per_second[2], -0.2);
    EXPECT_GT(motion->per_second[2], -1);
  }
}

}  // namespace
}  // namespace aisle::slam
