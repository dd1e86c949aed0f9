#include "harness/vehicle/pilot.h"

#include <algorithm>

#include "harness/common/seconds.h"

namespace aisle {
namespace {

constexpr std::int64_t kRemember_ns = 30'000'000'000;  // answers older than this are too old
/// Over this time the wheels' speed is read: encoders count, so a shorter one would see steps.
constexpr std::int64_t kSpeedOver_ns = 100'000'000;

}  // namespace

Pilot::Pilot(const Way& way, const FloorPose& start, const PilotOptions& options)
    : options_(options),
      way_(Prepare(way, options.driver)),
      belief_(start),
      T_site_slam_(options.T_site_slam) {
  rolled_.push_back({.stamp_ns = 0, .pose = start});
}

const Pilot::Rolling& Pilot::RollingAt(std::int64_t stamp_ns) const {
  const auto after =
      std::upper_bound(rolled_.begin(), rolled_.end(), stamp_ns,
                       [](std::int64_t at, const Rolling& entry) { return at < entry.stamp_ns; });
  return after == rolled_.begin() ? rolled_.front() : *std::prev(after);
}

void Pilot::Rolled(std::int64_t now_ns, const FloorPose& motion) {
  const Rolling& last = rolled_.back();
  const double sign = motion.position.x() < 0 ? -1 : 1;
  rolled_.push_back({.stamp_ns = now_ns,
                     .pose = last.pose * motion,
                     .way_m = last.way_m + sign * motion.position.norm(),
                     .turn_rad = last.turn_rad + motion.heading_rad});
  belief_ = belief_ * motion;
  while (rolled_.front().stamp_ns < now_ns - kRemember_ns) rolled_.pop_front();
}

void Pilot::Told(std::int64_t frame_ns, std::int64_t now_ns,
                 const std::optional<Eigen::Isometry3d>& T_slam_rig, int map_id) {
  if (!T_slam_rig) {
    watch_ = AfterAnswer(watch_, false, 0, now_ns, options_.watch);
    return;
  }
  const FloorPose since = RollingAt(frame_ns).pose.inverse() * rolled_.back().pose;
  const FloorPose wheels_then = belief_ * since.inverse();
  if (!T_site_slam_ || map_id != map_id_) {
    map_id_ = map_id;
    T_site_slam_ = InSpace(wheels_then) * options_.T_vehicle_rig * T_slam_rig->inverse();
  }
  FloorPose told = FromAbove(*T_site_slam_ * *T_slam_rig * options_.T_vehicle_rig.inverse());
  told.heading_rad =
      wheels_then.heading_rad + WrapAngle(told.heading_rad - wheels_then.heading_rad);
  const double jump_m = (told.position - wheels_then.position).norm();
  watch_ = AfterAnswer(watch_, true, jump_m, now_ns, options_.watch);
  if (watch_.trust != Trust::kGood) return;
  belief_ = told * since;
  steers_by_ns_ = frame_ns;
}

DriverInput Pilot::Input(std::int64_t now_ns, double duration_s) const {
  const Rolling& before = RollingAt(now_ns - kSpeedOver_ns);
  const Rolling& last = rolled_.back();
  const double over_s = ToSeconds(last.stamp_ns - before.stamp_ns);
  DriverInput input{.belief = belief_, .duration_s = duration_s};
  input.degraded = watch_.trust == Trust::kCreep;
  if (over_s > 0) {
    input.speed_mps = (last.way_m - before.way_m) / over_s;
    input.turn_rate_rad_s = (last.turn_rad - before.turn_rad) / over_s;
  }
  return input;
}

DriveCommand Pilot::Decide(std::int64_t now_ns, double duration_s) {
  watch_ = AfterTime(watch_, now_ns, options_.watch);
  if (watch_.trust == Trust::kFirst) {
    mode_ = DriveMode::kWaiting;
    return {};
  }
  if (watch_.trust == Trust::kStop) {
    mode_ = DriveMode::kStopped;
    return {.protective_stop = true};
  }
  const DriverStep step = DriveAlong(way_, driver_, Input(now_ns, duration_s), options_.driver);
  driver_ = step.state;
  const bool pauses = driver_.leg < way_.size() && way_[driver_.leg].kind == WayLeg::Kind::kPause;
  mode_ = driver_.arrived                 ? DriveMode::kArrived
          : watch_.trust == Trust::kCreep ? DriveMode::kDegraded
          : pauses                        ? DriveMode::kWaiting
                                          : DriveMode::kDriving;
  return step.command;
}

}  // namespace aisle
