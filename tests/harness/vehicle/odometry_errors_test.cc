// Each error of the wheels alone, of the size and sign that its option says.
#include <gtest/gtest.h>

#include "harness/vehicle/odometry.h"

namespace aisle {
namespace {

constexpr double kTick_s = 0.01;
constexpr std::uint64_t kRuns = 1000;
/// How far a spread of kRuns deviates may be off: four of its own standard deviations.
const double kSpreadWithin = 4 / std::sqrt(2.0 * kRuns);

OdometryOptions WithoutErrors() {
  OdometryOptions options;
  options.radius_error = options.inequality = options.track_error = 0;
  options.steering_error_rad = options.noise_m = options.slip_per_mps2 = 0;
  options.counts_per_rev = 1'000'000'000;
  return options;
}

PlantOptions Plant(VehicleKind kind) {
  PlantOptions plant;
  plant.kind = kind;
  return plant;
}

/// One step of a drive at constant speed.
PlantStep Steady(const PlantOptions& plant, double way_m, double turn_rad) {
  PlantStep step;
  if (plant.kind == VehicleKind::kTricycle) {
    const double across = turn_rad * plant.wheelbase_m;
    step.steering_rad = std::atan(across / way_m);
    step.wheel_way_m = std::copysign(std::hypot(way_m, across), way_m);
  }
  step.way_m = way_m;
  step.turn_rad = turn_rad;
  return step;
}

/// What the wheels of a run make of a way and a turn in one.
struct Measured {
  double way_m = 0, turn_rad = 0;
};
Measured Measure(const OdometryOptions& options, const PlantOptions& plant, std::uint64_t seed,
                 double way_m, double turn_rad) {
  const FloorPose moved = Odometer(options, plant, seed).Measure(Steady(plant, way_m, turn_rad));
  // The chord of an arc is the way of so much of it.
  const double half = std::abs(turn_rad) < 1e-12 ? 0 : moved.heading_rad / 2;
  const double chord = moved.position.x() < 0 ? -moved.position.norm() : moved.position.norm();
  return {half == 0 ? chord : chord * half / std::sin(half), moved.heading_rad};
}

/// Mean and standard deviation of a value over runs.
struct Spread {
  double mean = 0, deviation = 0;
};
template <class Value>
Spread Over(const Value& value) {
  double sum = 0, squares = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const double x = value(seed);
    sum += x;
    squares += x * x;
  }
  const double mean = sum / kRuns;
  return {mean, std::sqrt(squares / kRuns - mean * mean)};
}

/// Normal of that width about 0.
void ExpectWidth(const Spread& spread, double width, const char* what) {
  EXPECT_NEAR(spread.mean, 0, 4 * width / std::sqrt(double{kRuns})) << what;
  EXPECT_NEAR(spread.deviation, width, kSpreadWithin * width) << what;
}

constexpr VehicleKind kKinds[] = {VehicleKind::kDifferential, VehicleKind::kTricycle};

TEST(OdometryErrorsTest, WheelsOfAnotherRadiusMeasureEachWayByAsMuch) {
  OdometryOptions options = WithoutErrors();
  options.radius_error = 0.02;
  for (const VehicleKind kind : kKinds) {
    const PlantOptions plant = Plant(kind);
    const auto share = [&](std::uint64_t seed) {
      const Measured measured = Measure(options, plant, seed, 1, 0);
      EXPECT_NEAR(measured.turn_rad, 0, 1e-8) << "all wheels alike";
      return measured.way_m - 1;
    };
    ExpectWidth(Over(share), options.radius_error, "share of the way");
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Measured bend = Measure(options, plant, seed, 1, 0.5);
      EXPECT_NEAR(bend.turn_rad / 0.5 - 1, share(seed), 1e-6) << "and each turn";
      EXPECT_NEAR(-Measure(options, plant, seed, -1, 0).way_m - 1, share(seed), 1e-6);
    }
  }
}

TEST(OdometryErrorsTest, AnUnequalPairOfWheelsTurnsByTheirDifferenceOverTheTrack) {
  OdometryOptions options = WithoutErrors();
  options.inequality = 0.02;
  const PlantOptions plant = Plant(VehicleKind::kDifferential);
  const auto share = [&](std::uint64_t seed) {
    const Measured measured = Measure(options, plant, seed, 1, 0);
    return measured.turn_rad * plant.track_m;
  };
  ExpectWidth(Over(share), options.inequality, "share of the right wheel over the left");
  const auto way = [&](std::uint64_t seed) {
    return Odometer(options, plant, seed).Measure(Steady(plant, 1e-3, 0)).position.x() * 1e3 - 1;
  };
  EXPECT_NEAR(Over(way).deviation, 0, 1e-5) << "their mean is the way";
}

TEST(OdometryErrorsTest, AWiderBaseThanTheNominalOneTurnsLess) {
  OdometryOptions options = WithoutErrors();
  options.track_error = 0.02;
  for (const VehicleKind kind : kKinds) {
    const PlantOptions plant = Plant(kind);
    const auto share = [&](std::uint64_t seed) {
      const Measured measured = Measure(options, plant, seed, 0.5, 0.4);
      EXPECT_NEAR(measured.way_m, 0.5, 1e-7) << "of turns alone";
      return 0.4 / measured.turn_rad - 1;
    };
    ExpectWidth(Over(share), options.track_error, "share of track or wheelbase");
  }
}

TEST(OdometryErrorsTest, ASteeringZeroThatIsOffBendsAStraightWay) {
  OdometryOptions options = WithoutErrors();
  options.steering_error_rad = 0.02;
  const PlantOptions plant = Plant(VehicleKind::kTricycle);
  const auto angle = [&](std::uint64_t seed) {
    const double turn = Measure(options, plant, seed, 1, 0).turn_rad;
    return std::asin(turn * plant.wheelbase_m);
  };
  ExpectWidth(Over(angle), options.steering_error_rad, "angle");
  const auto straight = [&](std::uint64_t seed) {
    return Measure(options, Plant(VehicleKind::kDifferential), seed, 1, 0).turn_rad;
  };
  EXPECT_NEAR(Over(straight).deviation, 0, 1e-8) << "a differential drive steers no wheel";
}

/// What the wheels say too much of the way in a drive from speed to speed.
double SlipFromTo(double from_mps, double to_mps, double slip_per_mps2, VehicleKind kind) {
  OdometryOptions options = WithoutErrors();
  options.slip_per_mps2 = slip_per_mps2;
  PlantOptions plant = Plant(kind);
  plant.lag_s = 0;
  Odometer odometer(options, plant, 1);
  PlantState state;
  state.speed_mps = from_mps;
  double excess = 0;
  for (int k = 0; k < 400; ++k) {
    const PlantStep step = Move(state, {.speed_mps = to_mps}, kTick_s, plant);
    excess += odometer.Measure(step).position.x() - step.way_m;
    state = step.state;
  }
  EXPECT_EQ(state.speed_mps, to_mps);
  return excess;
}

/// Slip grows with the force: the excess is slip * acceleration on every metre, which is slip times
/// half the difference of the squared speeds, whatever the acceleration was.
TEST(OdometryErrorsTest, WheelsThatPushSayTooMuchAndWheelsThatBrakeTooLittle) {
  constexpr double kSlip = 0.01, kFast_mps = 1;
  const double of_ramp = kSlip * kFast_mps * kFast_mps / 2;
  for (const VehicleKind kind : kKinds) {
    EXPECT_NEAR(SlipFromTo(0, kFast_mps, kSlip, kind), of_ramp, 0.01 * of_ramp);
    EXPECT_NEAR(SlipFromTo(kFast_mps, 0, kSlip, kind), -of_ramp, 0.01 * of_ramp);
    // Backwards the same to the other side.
    EXPECT_NEAR(SlipFromTo(0, -kFast_mps, kSlip, kind), -of_ramp, 0.01 * of_ramp);
    EXPECT_NEAR(SlipFromTo(-kFast_mps, 0, kSlip, kind), of_ramp, 0.01 * of_ramp);
    EXPECT_NEAR(SlipFromTo(kFast_mps, kFast_mps, kSlip, kind), 0, 1e-6) << "a steady way";
  }
}

}  // namespace
}  // namespace aisle
