#include "harness/io/imu.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "harness/io/trajectory.h"
#include "simulator/motion/recorded_path.h"
#include "simulator/motion/rig_mount.h"
#include "simulator/scene/load.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

using Path = std::function<Eigen::Isometry3d(std::int64_t)>;

constexpr std::int64_t kEpoch_ns = 1'600'000'000'000'000'000;

/// What a user has: the numbers of the exported files, line by line.
std::vector<std::vector<double>> Rows(const std::string& csv,
                                      std::vector<std::int64_t>* stamps_ns) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    std::string field;
    std::getline(fields, field, ',');
    stamps_ns->push_back(std::stoll(field));
    rows.emplace_back();
    while (std::getline(fields, field, ',')) rows.back().push_back(std::stod(field));
  }
  return rows;
}

struct State {
  Eigen::Vector3d position, velocity;
  Eigen::Quaterniond rotation;
};

State TruthOf(const std::vector<double>& row) {
  return {{row[0], row[1], row[2]}, {row[7], row[8], row[9]}, {row[3], row[4], row[5], row[6]}};
}

/// The trapezoidal rule, as preintegration does it.
State Integrated(State state, const std::vector<double>& from, const std::vector<double>& to,
                 double dt) {
  const auto vector = [](const std::vector<double>& row, std::size_t at) {
    return Eigen::Vector3d(row[at], row[at + 1], row[at + 2]);
  };
  const Eigen::Vector3d turn = (vector(from, 0) + vector(to, 0)) / 2 * dt;
  const Eigen::Quaterniond before = state.rotation;
  if (turn.norm() > 0) {
    state.rotation = before * Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  }
  const Eigen::Vector3d acceleration =
      (before * vector(from, 3) + state.rotation * vector(to, 3)) / 2 - Eigen::Vector3d(0, 0, 9.81);
  state.position += state.velocity * dt + acceleration * dt * dt / 2;
  state.velocity += acceleration * dt;
  return state;
}

/// Farthest that an integration over 10 s gets from the truth, begun every second.
struct Drift {
  double position_m = 0, rotation_rad = 0;
};

Drift WorstDrift(const Path& path, double duration_s) {
  constexpr double kImu_hz = 200;
  constexpr std::size_t kFrames = 200;  // 10 s, a frame every 50 ms, 10 samples each
  const auto end_ns = static_cast<std::int64_t>(duration_s * 1e9);
  std::vector<std::int64_t> stamps, truth_stamps;
  const auto imu = Rows(FormatEurocImu(IdealImu(path, 0, end_ns, kImu_hz), kEpoch_ns), &stamps);
  Trajectory poses;
  std::vector<Eigen::Vector3d> velocities;
  for (std::int64_t t = 0; t <= end_ns; t += 50'000'000) {
    poses.push_back({t + kEpoch_ns, path(t)});
    velocities.push_back(VelocityAt(path, t, kImu_hz));
  }
  const auto truth = Rows(FormatEurocTruth(poses, velocities), &truth_stamps);
  Drift worst;
  for (std::size_t begin = 0; begin < truth.size(); begin += 20) {
    State state = TruthOf(truth[begin]);
    std::size_t k = 10 * begin;
    for (std::size_t i = begin + 1; i < truth.size() && i <= begin + kFrames; ++i) {
      for (; k < 10 * i; ++k) {
        state = Integrated(state, imu[k], imu[k + 1],
                           static_cast<double>(stamps[k + 1] - stamps[k]) * 1e-9);
      }
      EXPECT_EQ(stamps[k], truth_stamps[i]);
      const State then = TruthOf(truth[i]);
      worst.position_m = std::max(worst.position_m, (state.position - then.position).norm());
      worst.rotation_rad =
          std::max(worst.rotation_rad, state.rotation.angularDistance(then.rotation));
    }
  }
  return worst;
}

constexpr double kMost_m = 1e-3, kMost_rad = 0.01 * pi / 180;

TEST(IdealImu, OfARecordingThatBeginsInMotionFeelsNoStart) {
  const Eigen::Vector3d velocity(1.2, -0.3, 0);
  std::vector<sim::TimedPose> poses;
  for (std::int64_t i = 0; i <= 40; ++i) {
    poses.push_back({i * 50'000'000, Eigen::Isometry3d::Identity()});
    poses.back().T_world_body.translation() = 0.05 * static_cast<double>(i) * velocity;
  }
  const sim::RecordedPath recorded(poses);
  const auto path = [&](std::int64_t time_ns) { return recorded.At(time_ns); };
  const std::int64_t last_ns = poses.back().time_ns;
  for (const ImuSample& sample : IdealImu(path, 0, last_ns, 200)) {
    EXPECT_NEAR(sample.specific_force.norm(), kGravityMps2, 1e-6) << sample.stamp_ns;
    EXPECT_LT(sample.angular_velocity.norm(), 1e-9) << sample.stamp_ns;
  }
  for (const std::int64_t stamp_ns : {std::int64_t{0}, last_ns / 2, last_ns}) {
    EXPECT_LT((VelocityAt(path, stamp_ns, 200) - velocity).norm(), 1e-9) << stamp_ns;
  }
}

TEST(IdealImu, IntegratesToTheTrajectoryOfEveryScene) {
  int scenes = 0;
  for (const char* folder : {"paper", "paper_narrow", "weakness", "street", "smoke"}) {
    for (const auto& entry :
         fs::directory_iterator(fs::path(AISLE_SOURCE_DIR) / "scenes" / folder)) {
      const sim::Scene scene = sim::LoadScene(entry.path());
      const sim::RigSpec& rig = scene.rig;
      const sim::Route route(rig.route.plan, rig.route.limits);
      const Path path = [&](std::int64_t stamp_ns) {
        const double time_s = static_cast<double>(stamp_ns) * 1e-9;
        return sim::RigPose(route.At(time_s), rig.mount, rig.bumps, time_s);
      };
      const Drift worst = WorstDrift(path, scene.duration_s());
      EXPECT_LT(worst.position_m, kMost_m) << entry.path();
      EXPECT_LT(worst.rotation_rad, kMost_rad) << entry.path();
      ++scenes;
    }
  }
  EXPECT_GE(scenes, 33);
}

/// A drive that no scene has.
struct Drive {
  const char* what;
  std::vector<sim::RouteStep> steps;
  double jerk_mps3 = std::numeric_limits<double>::infinity();
};

void PrintTo(const Drive& drive, std::ostream* stream) { *stream << drive.what; }

sim::RouteStep Go(std::vector<Eigen::Vector2d> points, double speed_mps, double radius_m) {
  sim::RouteStep step;
  step.go = std::move(points);
  step.speed_mps = speed_mps;
  step.corner_radius_m = radius_m;
  return step;
}

sim::RouteStep TurnTo(double heading_rad) {
  sim::RouteStep step;
  step.turn_to_rad = heading_rad;
  return step;
}

sim::RouteStep Back(std::vector<Eigen::Vector2d> points) {
  sim::RouteStep step = Go(std::move(points), 0.5, 0.6);
  step.reverse = true;
  return step;
}

class OtherDrives : public testing::TestWithParam<Drive> {};

TEST_P(OtherDrives, AreIntegratedAsWell) {
  sim::RoutePlan plan;
  plan.start_s = 0.5037;  // on no sample
  plan.steps = GetParam().steps;
  sim::RouteLimits limits;
  limits.curvature_rate_per_m_s = 3;
  limits.lateral_jerk_mps3 = 4;
  limits.jerk_mps3 = GetParam().jerk_mps3;
  const sim::Route route(plan, limits);
  const sim::RigMount mount{1.1, 0.8, 0.35};
  const std::vector<sim::Bump> bumps = {{3.3333, 0.015, 0.02, 5, 0.2}, {7.1, -0.02, 0.03, 4, 0.25}};
  for (const auto& with : {std::vector<sim::Bump>{}, bumps}) {
    const Path path = [&](std::int64_t stamp_ns) {
      const double time_s = static_cast<double>(stamp_ns) * 1e-9;
      return sim::RigPose(route.At(time_s), mount, with, time_s);
    };
    const Drift worst = WorstDrift(path, route.duration_s() + 1);
    EXPECT_LT(worst.position_m, kMost_m) << with.size() << " bumps";
    EXPECT_LT(worst.rotation_rad, kMost_rad) << with.size() << " bumps";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Imu, OtherDrives,
    testing::Values(
        Drive{"straight", {Go({{7.13, 0}}, 0.93, 0.5)}},
        Drive{"acute corner", {Go({{6, 0}, {0.5, 1.5}, {4, 5}}, 0.9, 0.4)}},
        Drive{"s-bend", {Go({{3, 0}, {4.2, 1.2}, {7, 1.2}, {8.2, 0}, {11, 0}}, 1.1, 0.7)}},
        Drive{"u-turn", {Go({{5, 0}, {5, 1.5}, {0, 1.5}}, 1.3, 0.6)}},
        Drive{"corners in a row",
              {Go({{2, 0}, {2, 1.5}, {3.5, 1.5}, {3.5, 3}, {5, 3}, {5, 4.5}}, 0.8, 0.5)}},
        Drive{"short legs and stops", {Go({{1, 0}, {1, 0.4}, {1.3, 0.4}, {1.3, 0.2}}, 0.7, 0)}},
        Drive{"turns on the spot", {TurnTo(2.9), TurnTo(-1.3), Go({{1, -1}}, 0.6, 0.5), TurnTo(0)}},
        Drive{"back and forth", {Go({{4, 0}, {6, 2}}, 0.9, 0.8), Back({{4, 0}, {0, 0}})}},
        Drive{"changing speeds",
              {Go({{2, 0}}, 1.4, 0.5), Go({{3, 0}, {4, 2}}, 0.3, 0.5), Go({{4, 6}}, 1.2, 0.5)}},
        Drive{"within a jerk", {Go({{5, 0}, {5, 3}, {0, 3}}, 1.2, 0.6), TurnTo(0)}, 2}));

}  // namespace
}  // namespace aisle
