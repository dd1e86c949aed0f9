#include "harness/vehicle/odometry.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

constexpr double kTick_s = 0.01;

OdometryOptions Perfect() {
  OdometryOptions options;
  options.radius_error = options.inequality = options.track_error = 0;
  options.steering_error_rad = options.noise_m = options.slip_per_mps2 = 0;
  options.counts_per_rev = 10'000'000;
  return options;
}

/// Where the wheels put a vehicle that drives like this, and where it is.
struct Reckoned {
  FloorPose wheels, truth;
};
Reckoned Drive(const DriveCommand& command, double duration_s, const OdometryOptions& odometry,
               const PlantOptions& plant, std::uint64_t seed) {
  Odometer odometer(odometry, plant, seed);
  PlantState state;
  Reckoned reckoned;
  for (int k = 0; k < static_cast<int>(duration_s / kTick_s); ++k) {
    const PlantStep step = Move(state, command, kTick_s, plant);
    state = step.state;
    reckoned.wheels = reckoned.wheels * odometer.Measure(step);
  }
  reckoned.truth = state.pose;
  return reckoned;
}

TEST(OdometerTest, PerfectWheelsTellTheTruth) {
  for (const VehicleKind kind : {VehicleKind::kDifferential, VehicleKind::kTricycle}) {
    PlantOptions plant;
    plant.kind = kind;
    const Reckoned reckoned = Drive({0.9, 0.25}, 20, Perfect(), plant, 1);
    EXPECT_LT((reckoned.wheels.position - reckoned.truth.position).norm(), 1e-3);
    EXPECT_NEAR(reckoned.wheels.heading_rad, reckoned.truth.heading_rad, 1e-3);
  }
}

TEST(OdometerTest, UnequalWheelsBendAStraightWayByTheirDifferenceOverTheTrack) {
  PlantOptions plant;
  OdometryOptions odometry = Perfect();
  odometry.inequality = 0.004;
  const Reckoned reckoned = Drive({1, 0}, 20, odometry, plant, 3);
  const double way = reckoned.truth.position.x();
  const double inequality = reckoned.wheels.heading_rad * plant.track_m / way;
  EXPECT_GT(std::abs(inequality), 1e-4);
  EXPECT_LT(std::abs(inequality), 4 * odometry.inequality);
  // An arc of that curvature.
  EXPECT_NEAR(reckoned.wheels.position.y(), way * way * inequality / plant.track_m / 2, 0.02 * way);
}

TEST(OdometerTest, NoiseGrowsWithTheRootOfTheWay) {
  PlantOptions plant;
  OdometryOptions odometry = Perfect();
  odometry.noise_m = 1e-4;
  double squared = 0;
  constexpr int kRuns = 200;
  double way = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const Reckoned reckoned = Drive({1, 0}, 5, odometry, plant, seed);
    way = reckoned.truth.position.x();
    const double turned = reckoned.wheels.heading_rad * plant.track_m;
    squared += turned * turned / kRuns;
  }
  // The difference of two wheels, each of variance noise * way.
  EXPECT_NEAR(squared, 2 * odometry.noise_m * way, 0.35 * 2 * odometry.noise_m * way);
}

TEST(OdometerTest, TheSameSeedGivesTheSameBitsAndAnotherOthers) {
  const PlantOptions plant;
  const OdometryOptions odometry;
  const FloorPose one = Drive({0.7, 0.1}, 5, odometry, plant, 4).wheels;
  EXPECT_EQ(one, Drive({0.7, 0.1}, 5, odometry, plant, 4).wheels);
  EXPECT_NE(one, Drive({0.7, 0.1}, 5, odometry, plant, 5).wheels);
}

TEST(OdometerTest, EncodersCountAndLoseNothing) {
  PlantOptions plant;
  OdometryOptions odometry = Perfect();
  odometry.counts_per_rev = 64;  // a centimetre each
  const Reckoned reckoned = Drive({0.5, 0}, 10, odometry, plant, 1);
  EXPECT_NEAR(reckoned.wheels.position.x(), reckoned.truth.position.x(), 0.0099);
}

}  // namespace
}  // namespace aisle
