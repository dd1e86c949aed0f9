#include "harness/plugs/wheel_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "slam/camera/measured_motion.h"

namespace aisle {
namespace {

constexpr std::int64_t kReadingNs = 20'000'000, kFrameNs = 50'000'000;

/// Where a body that winds its way is.
Eigen::Isometry3d BodyAt(double seconds) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const double heading = 0.4 * std::sin(0.7 * seconds);
  pose.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() << 40 + 1.1 * seconds, -25 + 0.6 * std::sin(0.7 * seconds), 0;
  return pose;
}

Eigen::Isometry3d Mounting() {
  Eigen::Isometry3d T_base_left = CameraAhead();
  T_base_left.linear() *= Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  T_base_left.translation() << 0.35, 0.06, 1.2;
  return T_base_left;
}

/// `count` readings at 50 Hz, from 1 s on.
WheelTrack Wheels(int count) {
  WheelTrack track{.poses = {}, .T_base_left = Mounting()};
  for (int k = 0; k < count; ++k) {
    const std::int64_t stamp_ns = 1'000'000'000 + k * kReadingNs;
    track.poses.push_back({stamp_ns, BodyAt(static_cast<double>(stamp_ns) * 1e-9)});
    slam::Matrix6d spread = slam::Matrix6d::Random();
    track.covariances.push_back(1e-8 * (spread * spread.transpose() + slam::Matrix6d::Identity()));
  }
  return track;
}

std::vector<std::int64_t> Frames(std::int64_t first_ns, int count) {
  std::vector<std::int64_t> stamps_ns;
  for (int k = 0; k < count; ++k) stamps_ns.push_back(first_ns + k * kFrameNs);
  return stamps_ns;
}

TEST(MotionsBetweenTest, TheRigMovesAsItsMountingDoes) {
  const auto stamps_ns = Frames(1'010'000'000, 15);  // every other one between two readings
  const WheelTrack track = Wheels(60);
  const WheelMotions motions = MotionsBetween(track, stamps_ns, Eigen::Isometry3d::Identity());
  ASSERT_EQ(motions.size(), stamps_ns.size() - 1);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto rig = [&](std::size_t k) {
      return BodyAt(static_cast<double>(stamps_ns[k]) * 1e-9) * Mounting();
    };
    ASSERT_TRUE(motions[i]) << i;
    // The chords of 20 ms are off their arcs by way times turn / 8 at the most, at both ends.
    constexpr double kOffArc_m = 2 * 0.024 * 0.006 / 8;
    EXPECT_LT(slam::Difference(rig(i + 1).inverse() * rig(i), motions[i]->T_now_before).norm(),
              kOffArc_m);
  }
}

TEST(MotionsBetweenTest, RectificationTurnsTheRig) {
  Eigen::Isometry3d T_left_rig = Eigen::Isometry3d::Identity();
  T_left_rig.linear() = Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const auto stamps_ns = Frames(1'000'000'000, 5);
  const auto built = MotionsBetween(Wheels(20), stamps_ns, Eigen::Isometry3d::Identity());
  const auto turned = MotionsBetween(Wheels(20), stamps_ns, T_left_rig);
  for (std::size_t i = 0; i < built.size(); ++i) {
    EXPECT_TRUE(turned[i]->T_now_before.isApprox(
        T_left_rig.inverse() * built[i]->T_now_before * T_left_rig, 1e-12));
  }
}

/// Two motions one after the other are the motion over both, error and all, wherever they meet.
TEST(MotionsBetweenTest, MotionsAndTheirErrorsAddUp) {
  const WheelTrack track = Wheels(60);
  const std::int64_t first = 1'003'000'000, last = 1'190'000'000;
  const auto whole = MotionsBetween(track, {first, last}, Eigen::Isometry3d::Identity());
  for (const std::int64_t between : {1'015'000'000, 1'100'000'000, 1'189'000'000}) {
    const auto parts = MotionsBetween(track, {first, between, last}, Eigen::Isometry3d::Identity());
    const slam::MeasuredMotion joined =
        slam::Compose({parts[0]->T_now_before, parts[0]->covariance},
                      {parts[1]->T_now_before, parts[1]->covariance});
    EXPECT_TRUE(joined.T_now_before.isApprox(whole[0]->T_now_before, 1e-12));
    EXPECT_TRUE(joined.covariance.isApprox(whole[0]->covariance, 1e-9)) << between;
  }
}

TEST(MotionsBetweenTest, NothingIsMadeUpWhereWheelsAreSilent) {
  WheelTrack track = Wheels(60);
  track.poses.erase(track.poses.begin() + 20, track.poses.begin() + 35);  // 1.38 to 1.70 s
  track.covariances.erase(track.covariances.begin() + 20, track.covariances.begin() + 35);
  const auto stamps_ns = Frames(950'000'000, 27);  // 0.95 to 2.25 s
  const auto motions = MotionsBetween(track, stamps_ns, Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const std::int64_t from = stamps_ns[i], to = stamps_ns[i + 1];
    const bool known = (from >= 1'000'000'000 && to <= 1'380'000'000) ||
                       (from >= 1'700'000'000 && to <= 2'180'000'000);
    EXPECT_EQ(motions[i].has_value(), known) << from;
  }
}

TEST(MotionsBetweenTest, WheelsThatDoNotSayHowSureTheyAreRoll) {
  WheelTrack track = Wheels(60);
  track.covariances.clear();
  track.T_base_left = Eigen::Isometry3d::Identity();
  const auto motions =
      MotionsBetween(track, Frames(1'000'000'000, 3), Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d moved = motions[0]->T_now_before;
  const slam::Matrix6d rolled = RollingCovariance(
      moved.translation().norm(), Eigen::AngleAxisd(moved.linear()).angle(), {}, {});
  EXPECT_LT((motions[0]->covariance - rolled).cwiseAbs().maxCoeff(), 1e-3 * rolled.maxCoeff());
}

/// By how much headings of many drives scatter more, squared, than is said of each: of vehicles
/// that roll 5 m and turn so far on the way, as far as a calibration's error is said to be the
/// same.
double HeadingScatter(const PlantOptions& plant, const OdometryOptions& options, double turn_rad) {
  constexpr int kDrives = 400, kSteps = 500, kStepsAMotion = 5;
  constexpr double kWay_m = 5;
  PlantStep step;
  step.way_m = kWay_m / kSteps;
  step.turn_rad = turn_rad / kSteps;
  step.steering_rad = std::atan2(plant.wheelbase_m * turn_rad, kWay_m);
  step.wheel_way_m = step.way_m / std::cos(step.steering_rad);
  double said = 0, scatter = 0;
  for (int k = 0; k < kSteps / kStepsAMotion; ++k) {
    said += RollingCovariance(kStepsAMotion * step.way_m, kStepsAMotion * step.turn_rad, options,
                              plant)(5, 5);
  }
  for (int drive = 1; drive <= kDrives; ++drive) {
    Odometer odometer(options, plant, static_cast<std::uint64_t>(drive));
    double heading = 0;
    for (int k = 0; k < kSteps; ++k) heading += odometer.Measure(step).heading_rad;
    scatter += (heading - turn_rad) * (heading - turn_rad) / kDrives;
  }
  return scatter / said;
}

TEST(RollingCovarianceTest, ATricyclesHeadingScattersAsItsSteeringErrs) {
  PlantOptions plant{.kind = VehicleKind::kTricycle, .wheelbase_m = 1.4};
  for (const double steering_error_rad : {0.003, 0.0175, 0.035}) {
    for (const double noise_m : {1e-7, 1e-5}) {
      for (const double turn_rad : {0.0, 3.0}) {
        OdometryOptions options;
        options.steering_error_rad = steering_error_rad;
        options.noise_m = noise_m;
        options.track_error = 0.02;
        const double scatter = HeadingScatter(plant, options, turn_rad);
        EXPECT_GT(scatter, 0.75) << steering_error_rad << ' ' << noise_m << ' ' << turn_rad;
        EXPECT_LT(scatter, 1.35) << steering_error_rad << ' ' << noise_m << ' ' << turn_rad;
      }
    }
  }
}

/// Who stands, and whose wheel errs by nothing, is still no surer than its counts are fine.
TEST(RollingCovarianceTest, NobodyIsSureBeyondCounting) {
  OdometryOptions exact{.radius_error = 0, .inequality = 0, .track_error = 0};
  exact.steering_error_rad = exact.noise_m = 0;
  for (const VehicleKind kind : {VehicleKind::kDifferential, VehicleKind::kTricycle}) {
    for (const double turn_rad : {0.0, 0.3}) {
      const slam::Vector6d said =
          RollingCovariance(0, turn_rad, exact, {.kind = kind}).diagonal().cwiseSqrt();
      EXPECT_GT(said.minCoeff(), 1e-5);
    }
  }
}

MotionMeasurement Step(int k) {
  MotionMeasurement step;
  step.T_now_before = (BodyAt(0.05 * k).inverse() * BodyAt(0.05 * (k + 1))).inverse();
  slam::Vector6d deviations;
  deviations << 2e-3, 1e-3, 5e-4, 1e-3, 5e-4, 4e-3;
  step.covariance = deviations.cwiseAbs2().asDiagonal();
  return step;
}

/// What is said of the pose is how poses of many drives scatter.
TEST(ReckonTest, CovarianceIsTheScatterOfManyDrives) {
  constexpr int kSteps = 40, kDrives = 6000;
  OdometryReading said;
  for (int k = 0; k < kSteps; ++k) said = Reckon(said, Step(k), 0.05);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  slam::Matrix6d scatter = slam::Matrix6d::Zero();
  for (int drive = 0; drive < kDrives; ++drive) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int k = 0; k < kSteps; ++k) {
      slam::Vector6d error;
      for (int i = 0; i < 6; ++i) error[i] = std::sqrt(Step(k).covariance(i, i)) * normal(random);
      pose = pose * slam::Retract(Step(k).T_now_before, error).inverse();
    }
    slam::Vector6d off;
    off << pose.translation() - said.T_odom_base.translation(),
        slam::LogRotation(
            Eigen::Quaterniond(pose.linear() * said.T_odom_base.linear().transpose()));
    scatter += off * off.transpose() / kDrives;
  }
  const slam::Vector6d deviations = said.covariance.diagonal().cwiseSqrt();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      EXPECT_NEAR(scatter(i, j) / (deviations[i] * deviations[j]),
                  said.covariance(i, j) / (deviations[i] * deviations[j]), 0.06)
          << i << ' ' << j;
    }
  }
}

/// What a bag tells of wheels, read again as a bag is read, is what they measured.
TEST(ReckonTest, ReadingsGiveTheMotionsBack) {
  WheelTrack track{.poses = {{0, Eigen::Isometry3d::Identity()}},
                   .covariances = {slam::Matrix6d::Zero()},
                   .T_base_left = Mounting()};
  std::vector<std::int64_t> stamps_ns = {0};
  OdometryReading reading;
  for (int k = 0; k < 10; ++k) {
    reading = Reckon(reading, Step(k), 0.05);
    stamps_ns.push_back((k + 1) * kFrameNs);
    track.poses.push_back({stamps_ns.back(), reading.T_odom_base});
    track.covariances.push_back(reading.twist_covariance * 0.05 * 0.05);
  }
  const auto motions = MotionsBetween(track, stamps_ns, Eigen::Isometry3d::Identity());
  for (int k = 0; k < 10; ++k) {
    const MotionMeasurement expected = OfRig(Step(k), Mounting());
    const auto i = static_cast<std::size_t>(k);
    EXPECT_TRUE(motions[i]->T_now_before.isApprox(expected.T_now_before, 1e-12));
    EXPECT_TRUE(motions[i]->covariance.isApprox(expected.covariance, 1e-9));
  }
}

}  // namespace
}  // namespace aisle
