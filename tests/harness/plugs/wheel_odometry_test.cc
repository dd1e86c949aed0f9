#include "harness/plugs/wheel_odometry.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "harness/contract/floor.h"
#include "harness/io/input_error.h"
#include "harness/loop/closed_drive.h"
#include "slam/stereo_slam.h"
#include "tests/harness/loop/fake_drive_scene.h"

namespace aisle {
namespace {

/// A camera 0.8 m above and 0.3 m ahead of the axle, looking down a little, that drives a winding
/// way of `metres` at 20 frames a second.
std::vector<FrameRequest> WindingWay(double metres) {
  Eigen::Isometry3d T_body_rig = Eigen::Isometry3d::Identity();
  T_body_rig.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_body_rig.linear() =
      T_body_rig.linear() * Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  T_body_rig.translation() << 0.3, 0, 0.8;
  std::vector<FrameRequest> way;
  FloorPose body{{1, 2}, 0.4};
  constexpr double kStep_m = 0.045;
  for (int k = 0; k * kStep_m < metres; ++k) {
    way.push_back({k, k * 50'000'000LL, InSpace(body) * T_body_rig});
    body = AlongArc(body, kStep_m, 0.02 * std::sin(0.05 * k));
  }
  return way;
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
  const auto steps = MeasureByWheels(way, Perfect(), 1);
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
  const WheelMotions steps = MeasureByWheels(way, Perfect(), 1);
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
