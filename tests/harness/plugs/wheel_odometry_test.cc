#include "harness/plugs/wheel_odometry.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include "harness/contract/floor.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/loop/closed_drive.h"
#include "harness/plugs/simulated_drive.h"
#include "slam/stereo_slam.h"
#include "tests/harness/loop/fake_drive_scene.h"

namespace aisle {
namespace {

/// T_body_rig of a camera 0.8 m above and 0.3 m ahead of the axle, looking down a little.
Eigen::Isometry3d Mount() {
  Eigen::Isometry3d T_body_rig = Eigen::Isometry3d::Identity();
  T_body_rig.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_body_rig.linear() =
      T_body_rig.linear() * Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  T_body_rig.translation() << 0.3, 0, 0.8;
  return T_body_rig;
}

constexpr double kStep_m = 0.045;

/// It drives a way of `metres` at 20 frames a second and turns by `turn(k)` after frame k.
std::vector<FrameRequest> WayOf(double metres, const std::function<double(int)>& turn) {
  std::vector<FrameRequest> way;
  FloorPose body{{1, 2}, 0.4};
  for (int k = 0; k * kStep_m < metres; ++k) {
    way.push_back({k, k * 50'000'000LL, InSpace(body) * Mount()});
    body = AlongArc(body, kStep_m, turn(k));
  }
  return way;
}

std::vector<FrameRequest> WindingWay(double metres) {
  return WayOf(metres, [](int k) { return 0.02 * std::sin(0.05 * k); });
}

slam::MeasuredMotion Whole(const WheelMotions& steps) {
  slam::MeasuredMotion whole{Eigen::Isometry3d::Identity(), slam::Matrix6d::Zero()};
  for (const std::optional<MotionMeasurement>& step : steps) {
    whole = slam::Compose(whole, {step->T_now_before, step->covariance});
  }
  return whole;
}

OdometryOptions Perfect() {
  return {.radius_error = 0,
          .inequality = 0,
          .track_error = 0,
          .steering_error_rad = 0,
          .noise_m = 0,
          .slip_per_mps2 = 0,
          .counts_per_rev = 1 << 30,
          .wheel_radius_m = 0.1};
}

TEST(MeasureByWheels, PerfectWheelsMeasureTheWayItself) {
  const auto way = WindingWay(20);
  const auto steps = MeasureByWheels(way, {.odometry = Perfect()}, 1);
  ASSERT_EQ(steps.size(), way.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Eigen::Isometry3d truth = way[i + 1].T_world_rig.inverse() * way[i].T_world_rig;
    EXPECT_LT(slam::Difference(truth, steps[i]->T_now_before).norm(), 1e-7) << i;
  }
}

TEST(MeasureByWheels, SameSeedSameBitsAnotherSeedOthers) {
  const auto way = WindingWay(2);
  const auto a = MeasureByWheels(way, {}, 7), b = MeasureByWheels(way, {}, 7),
             c = MeasureByWheels(way, {}, 8);
  EXPECT_EQ(a.back()->T_now_before.matrix(), b.back()->T_now_before.matrix());
  EXPECT_NE(a.back()->T_now_before.matrix(), c.back()->T_now_before.matrix());
}

/// A tricycle's wheel goes across as well as ahead, and its odometer reads a steering angle: what
/// it makes of any way, turns on the spot and reversing among it, is that way.
TEST(MeasureByWheels, PerfectWheelsOfATricycleMeasureTheWayItself) {
  Wheels wheels{.odometry = Perfect(), .plant = {.kind = VehicleKind::kTricycle}};
  wheels.plant.wheelbase_m = 1.4;
  std::vector<FrameRequest> way = WindingWay(3);
  FloorPose body;
  for (FrameRequest& frame : way) {
    frame.T_world_rig = InSpace(body) * Mount();
    const bool on_the_spot = frame.id % 20 < 5, back = frame.id % 20 > 15;
    body = AlongArc(body, on_the_spot ? 0 : back ? -0.03 : 0.04, on_the_spot ? -0.1 : 0.02);
  }
  const auto steps = MeasureByWheels(way, wheels, 1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Eigen::Isometry3d truth = way[i + 1].T_world_rig.inverse() * way[i].T_world_rig;
    EXPECT_LT(slam::Difference(truth, steps[i]->T_now_before).norm(), 1e-7) << i;
  }
}

/// Straight ahead, wheels that are larger than they are taken for by a share measure less by it,
/// and a tricycle whose steering's zero is off measures a turn of way * sin(error) / wheelbase.
TEST(MeasureByWheels, WheelsErrAsTheirVehicleSaysTheyDo) {
  const auto way = WayOf(4, [](int) { return 0.0; });
  const double way_m = kStep_m * static_cast<double>(way.size() - 1);
  Wheels large{.odometry = Perfect(), .plant = {.kind = VehicleKind::kTricycle}};
  large.odometry.radius_error = 0.2;
  Wheels askew{.odometry = Perfect(), .plant = {.kind = VehicleKind::kTricycle}};
  askew.odometry.steering_error_rad = 0.02;
  askew.plant.wheelbase_m = 1.4;
  double squares = 0;
  constexpr int kSeeds = 200;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Eigen::Isometry3d said = Whole(MeasureByWheels(way, large, seed)).T_now_before;
    EXPECT_LT(Eigen::AngleAxisd(said.linear()).angle(), 1e-7) << "nothing may turn it";
    const double off = said.translation().norm() / way_m - 1;
    squares += off * off / kSeeds;

    const Eigen::Isometry3d turned = Whole(MeasureByWheels(way, askew, seed)).T_now_before;
    Odometer odometer(askew.odometry, askew.plant, seed);
    PlantStep whole_way;
    whole_way.way_m = whole_way.wheel_way_m = way_m;
    EXPECT_NEAR(Eigen::AngleAxisd(turned.linear()).angle(),
                std::abs(odometer.Measure(whole_way).heading_rad), 1e-6);
  }
  EXPECT_NEAR(std::sqrt(squares), 0.2, 0.03);  // of the rms over 200 seeds, three deviations
}

/// Over some metres the errors of calibration dominate and the covariance still bounds them: of
/// 100 runs the way ahead is off by three deviations at most in nearly all.
TEST(MeasureByWheels, CovarianceBoundsTheErrorOfAWay) {
  for (const double metres : {0.5, 5.0}) {
    const auto way = WindingWay(metres);
    const Eigen::Isometry3d truth = way.back().T_world_rig.inverse() * way.front().T_world_rig;
    int within = 0;
    double nees = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const slam::MeasuredMotion whole = Whole(MeasureByWheels(way, {}, seed));
      const slam::Vector6d off = slam::Difference(whole.T_now_before, truth);
      const double chi2 = off.dot(whole.covariance.ldlt().solve(off));
      within += chi2 < 22.46;
      nees += chi2 / 100;
    }
    EXPECT_GE(within, 97) << metres;
    EXPECT_GT(nees, 0.1) << metres;  // not so wide that it says nothing
  }
}

TEST(MeasureByWheels, CovariancesAreSymmetricAndDefinite) {
  auto way = WindingWay(1);
  way.push_back(way.back());  // it stops
  way.back().stamp_ns += 50'000'000;
  for (const std::optional<MotionMeasurement>& step : MeasureByWheels(way, {}, 3)) {
    EXPECT_EQ(step->covariance, step->covariance.transpose());
    EXPECT_EQ((Eigen::LLT<slam::Matrix6d>(step->covariance).info()), Eigen::Success);
  }
}

/// A recording's truth often begins after its images, and has gaps.
TEST(MeasureByWheels, NothingIsMeasuredWhereNobodyKnowsTheWay) {
  auto way = WindingWay(2);
  const auto lacks = [](std::size_t i) { return i < 3 || (i >= 10 && i < 12); };
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (lacks(i)) way[i] = {way[i].id, way[i].stamp_ns, Eigen::Isometry3d::Identity(), false};
  }
  const WheelMotions steps = MeasureByWheels(way, {.odometry = Perfect()}, 1);
  ASSERT_EQ(steps.size(), way.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    ASSERT_EQ(steps[i].has_value(), !lacks(i) && !lacks(i + 1)) << i;
    if (!steps[i]) continue;
    const Eigen::Isometry3d truth = way[i + 1].T_world_rig.inverse() * way[i].T_world_rig;
    EXPECT_LT(slam::Difference(truth, steps[i]->T_now_before).norm(), 1e-7) << i;
  }
}

/// Frames whose poses are known, and nothing else.
class Planned : public Sequence {
 public:
  explicit Planned(std::vector<FrameRequest> schedule) : schedule_(std::move(schedule)) {}
  std::string name() const override { return "planned"; }
  StereoCalibration calibration() const override { return {}; }
  double rate_hz() const override { return 20; }
  std::vector<FrameRequest> Schedule() const override { return schedule_; }
  SequenceFrame At(const FrameRequest&) const override { return {}; }

 private:
  std::vector<FrameRequest> schedule_;
};

TEST(MeasureByWheels, AWorldOnItsSideAndAWayThatNobodyKnowsAreRefused) {
  auto way = WindingWay(1);
  EXPECT_NO_THROW(MeasureByWheels(Planned(way), 1));
  for (FrameRequest& frame : way) {  // y down, as a camera has it
    frame.T_world_rig = way.front().T_world_rig.inverse() * frame.T_world_rig;
  }
  EXPECT_THROW(MeasureByWheels(Planned(way), 1), InputError);
  for (FrameRequest& frame : way) frame.pose_known = false;
  EXPECT_THROW(MeasureByWheels(Planned(way), 1), InputError);
}

/// Who has no vehicle has wheels all the same; who has one, its own.
TEST(WheelsOfScene, AreThoseOfItsDrive) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("aisle_wheels_{}", ::getpid());
  const std::string smoke = AISLE_SOURCE_DIR "/scenes/smoke/short.yaml";
  WriteFileAtomically(folder / "driven.yaml",
                      "extend: " + smoke +
                          "\ndrive: {kind: tricycle, wheelbase_m: 1.4, odometry: {radius_error: "
                          "0.2, steering_error_deg: 1}}\n");
  const Wheels driven = WheelsOfScene(folder / "driven.yaml"), none = WheelsOfScene(smoke);
  EXPECT_EQ(driven.plant.kind, VehicleKind::kTricycle);
  EXPECT_EQ(driven.plant.wheelbase_m, 1.4);
  EXPECT_EQ(driven.odometry.radius_error, 0.2);
  EXPECT_NEAR(driven.odometry.steering_error_rad, std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(driven.odometry.track_error, OdometryOptions{}.track_error);
  EXPECT_EQ(none.plant.kind, VehicleKind::kDifferential);
  EXPECT_EQ(none.odometry.radius_error, OdometryOptions{}.radius_error);
  std::filesystem::remove_all(folder);
}

/// Looks at what every picture is handed, and tells the truth.
class LooksAtMotion : public Localiser {
 public:
  explicit LooksAtMotion(const DriveScene& scene) : scene_(scene) {}

  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    const std::optional<MotionMeasurement> motion = scene_.Take(exposure).images.motion;
    EXPECT_EQ(motion.has_value(), !ids.empty());
    if (motion) {
      const Eigen::Isometry3d truth = exposure.T_world_rig.inverse() * before_;
      const slam::Vector6d error = slam::Difference(truth, motion->T_now_before);
      worst = std::max(worst, error.norm());
      surprise += error.dot(motion->covariance.llt().solve(error));
    }
    before_ = exposure.T_world_rig;
    ids.push_back(exposure.id);
    return exposure.T_world_rig;
  }
  double worst = 0, surprise = 0;  ///< of the errors: the largest, the sum of Mahalanobis' squares
  std::vector<std::int64_t> ids;

 private:
  const DriveScene& scene_;
  Eigen::Isometry3d before_ = Eigen::Isometry3d::Identity();
};

TEST(WithOdometry, AClosedDriveHandsOutTheMotionSinceThePictureLookedAtBefore) {
  auto fake = std::make_unique<FakeDriveScene>();
  fake->edit().odometry = Perfect();
  const std::unique_ptr<DriveScene> scene = WithOdometry(std::move(fake));
  for (const double latency_ms : {0.0, 120.0}) {
    LooksAtMotion system(*scene);
    LoopOptions options;
    options.steering.latency_ms = latency_ms;
    EXPECT_EQ(DriveClosed(*scene, &system, options).end, DriveEnd::kArrived);
    EXPECT_LT(system.worst, 1e-6) << latency_ms;
    const auto shown = static_cast<std::int64_t>(system.ids.size());
    // At 120 ms it looks at every third picture at the most.
    EXPECT_EQ(system.ids.back() + 1 >= 2 * shown, latency_ms > 0);
  }
}

TEST(WithOdometry, WheelsThatErrAreAsFarOffAsTheySay) {
  auto fake = std::make_unique<FakeDriveScene>();
  fake->edit().odometry = {.radius_error = 0.005};
  const std::unique_ptr<DriveScene> scene = WithOdometry(std::move(fake));
  LooksAtMotion system(*scene);
  DriveClosed(*scene, &system, {});
  // Three of six directions err here; a body that heaves and nods on its floor errs in the others.
  const double mean = system.surprise / static_cast<double>(system.ids.size() - 1);
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 6);
}

}  // namespace
}  // namespace aisle
