#include "simulator/motion/route.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "simulator/motion/cornering.h"

namespace aisle::sim {
namespace {

constexpr double kSameHeading_rad = 1e-6;

/// A corner as the planner sees it: where, how rounded, by which step.
struct Corner {
  DriveCorner drive;
  int step = 0;
};

/// When a profile has come so far: to the last bit, since speed may be nothing there.
double TimeAt(const SpeedProfile& profile, double distance_m) {
  double before_s = 0, reached_s = profile.duration_s();
  while (true) {
    const double middle_s = (before_s + reached_s) / 2;
    if (middle_s <= before_s || middle_s >= reached_s) return reached_s;
    (profile.At(middle_s).distance_m < distance_m ? before_s : reached_s) = middle_s;
  }
}

double HeadingBetween(const Corner& from, const Corner& to) {
  const Eigen::Vector2d side = to.drive.position - from.drive.position;
  return std::atan2(side.y(), side.x());
}

/// The largest radius with which the corners fit, for the message that theirs does not; empty if
/// there is none.
std::string RadiusThatFits(std::vector<DriveCorner> corners, const RouteLimits& limits) {
  constexpr double kSmaller = 0.95;
  double largest = 0;
  for (const DriveCorner& corner : corners) largest = std::max(largest, corner.radius_m);
  for (double radius = largest; radius > 0.01; radius *= kSmaller) {
    for (DriveCorner& corner : corners) corner.radius_m = std::min(corner.radius_m, radius);
    try {
      Path::Through(TakeCorners(corners, limits).waypoints);
      return fmt::format("; {:.2g} m fits", std::floor(radius * 100) / 100);
    } catch (const std::invalid_argument&) {
    }
  }
  return "";
}

/// Lays legs one after another; the state at the end of the last leg is `now`.
class Planner {
 public:
  Planner(const RoutePlan& plan, const RouteLimits& limits) : limits_(limits) {
    now_.position = plan.start;
    now_.heading_rad = plan.heading_rad;
    Pause(plan.start_s);
  }

  void BeginStep(int step) {
    now_.step = step;
    step_start_s_ = time_s_;
  }

  void Pause(double duration_s) {
    if (duration_s > 0) Append({}, duration_s);
  }

  void TurnTo(double heading_rad) {
    const double turn = WrapAngle(heading_rad - now_.heading_rad);
    if (std::abs(turn) < kSameHeading_rad) return;
    if (!limits_.turns_on_the_spot) {
      throw RouteError(
          now_.step,
          fmt::format("it would have to turn by {:.3g} degrees on the spot, which this vehicle "
                      "cannot; let it begin with heading_deg: {:.3g}, or round the corner "
                      "(corner_radius_m)",
                      turn * 180 / std::numbers::pi, heading_rad * 180 / std::numbers::pi));
    }
    Route::Leg leg;
    leg.turn_sign = turn < 0 ? -1 : 1;
    const SpeedLimit limit{std::abs(turn), limits_.turn_rate_rad_s};
    leg.profile = SpeedProfile::FromRestToRest({&limit, 1}, limits_.turn_acceleration_rad_s2,
                                               limits_.turn_jerk_rad_s3());
    const double duration = leg.profile.duration_s();
    Append(std::move(leg), duration);
  }

  /// Drives through corners; every sharp one is a stop and a turn on the spot.
  void Drive(const std::vector<Corner>& corners, bool reverse) {
    std::vector<Corner> piece = {{{now_.position, 0, 1}, now_.step}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      piece.push_back(corners[i]);
      const bool last = i + 1 == corners.size();
      if (!last && !IsSharp(piece[piece.size() - 2], corners[i], corners[i + 1])) continue;
      DrivePiece(piece, reverse);
      piece = {{{now_.position, 0, 1}, corners[i].step}};
    }
  }

  void Follow(const PacedLeg& paced) {
    if (paced.pause_s > 0) Pause(paced.pause_s);
    if (paced.turn_rad != 0) TurnTo(now_.heading_rad + paced.turn_rad);
    if (paced.pieces.empty()) return;
    std::vector<Path::Arc> arcs;
    std::vector<SpeedProfile::Stretch> stretches;
    Route::Leg leg;
    for (const PacedPiece& piece : paced.pieces) {
      arcs.push_back(
          {(piece.from_mps + piece.to_mps) / 2 * piece.duration_s, piece.curvature_per_m});
      stretches.push_back({piece.duration_s, piece.to_mps});
    }
    leg.path = Path::OfArcs({now_.position, now_.heading_rad, 0}, arcs);
    leg.profile = SpeedProfile::Paced(paced.pieces.front().from_mps, stretches);
    leg.segment_steps.resize(leg.path.segments().size());
    const double duration = leg.profile.duration_s();
    Append(std::move(leg), duration);
  }

  std::vector<Route::Leg> TakeLegs() { return std::move(legs_); }
  RouteState now() const { return now_; }
  double time_s() const { return time_s_; }

 private:
  static bool IsSharp(const Corner& before, const Corner& corner, const Corner& after) {
    const double turn = WrapAngle(HeadingBetween(corner, after) - HeadingBetween(before, corner));
    return corner.drive.radius_m <= 0 && std::abs(turn) > kSameHeading_rad;
  }

  void DrivePiece(const std::vector<Corner>& corners, bool reverse) {
    const int step = corners[1].step;
    std::vector<DriveCorner> drive;
    for (const Corner& corner : corners) drive.push_back(corner.drive);
    Cornering taken;
    Route::Leg leg;
    try {
      taken = TakeCorners(drive, limits_);
      leg.path = Path::Through(taken.waypoints);
    } catch (const std::invalid_argument& error) {
      throw RouteError(step, error.what() + RadiusThatFits(drive, limits_));
    }
    const double behind = reverse ? std::numbers::pi : 0;
    if (step != now_.step) BeginStep(step);
    TurnTo(leg.path.At(0).heading_rad + behind);
    leg.reverse = reverse;
    std::vector<SpeedLimit> limits;
    for (const Path::Segment& segment : leg.path.segments()) {
      const std::size_t end = static_cast<std::size_t>(segment.side) + 1;
      const double speed = segment.IsLine() ? drive[end].cruise_mps : taken.speeds_mps[end];
      limits.push_back({segment.length_m, speed});
      leg.segment_steps.push_back({.step = corners[end].step});
      if (!segment.IsLine()) leg.segment_steps.back().followed_mps = taken.followed_mps[end];
    }
    leg.profile =
        SpeedProfile::FromRestToRest(limits, limits_.acceleration_mps2, limits_.jerk_mps3);
    const double duration = leg.profile.duration_s();
    const double last_step_start_s = TimeSteps(&leg);
    Append(std::move(leg), duration);
    step_start_s_ = last_step_start_s;
  }

  /// Steps that join in one drive begin where the segment before ends. Returns when the last began.
  double TimeSteps(Route::Leg* leg) const {
    double start_s = step_start_s_;
    int step = now_.step;
    for (std::size_t i = 0; i < leg->segment_steps.size(); ++i) {
      Route::Leg::SegmentStep& segment = leg->segment_steps[i];
      if (segment.step != step) {
        start_s = time_s_ + TimeAt(leg->profile, leg->path.segments()[i].start_m);
      }
      step = segment.step;
      segment.start_s = start_s;
    }
    return start_s;
  }

  void Append(Route::Leg leg, double duration_s);

  RouteLimits limits_;
  std::vector<Route::Leg> legs_;
  RouteState now_;
  double time_s_ = 0;
  double step_start_s_ = 0;
};

RouteState StateIn(const Route::Leg& leg, double elapsed_s) {
  const Travel travel = leg.profile.At(elapsed_s);
  RouteState state = leg.start;
  double step_start_s = leg.step_start_s;
  if (leg.turn_sign != 0) {
    state.heading_rad += leg.turn_sign * travel.distance_m;
    state.yaw_rate_rad_s = leg.turn_sign * travel.speed_mps;
  } else if (leg.path.length_m() > 0) {
    const PathPoint point = leg.path.At(travel.distance_m);
    const double sign = leg.reverse ? -1 : 1;
    state.position = point.position;
    state.heading_rad = leg.start.heading_rad + point.heading_rad - leg.path.At(0).heading_rad;
    state.speed_mps = sign * travel.speed_mps;
    state.acceleration_mps2 = sign * travel.acceleration_mps2;
    state.yaw_rate_rad_s = point.curvature_per_m * travel.speed_mps;
    state.curvature_per_m = sign * point.curvature_per_m;
    state.odometer_m += sign * travel.distance_m;
    const auto& segments = leg.path.segments();
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (segments[i].start_m > travel.distance_m) break;
      state.step = leg.segment_steps[i].step;
      step_start_s = leg.segment_steps[i].start_s;
    }
  }
  state.step_elapsed_s = leg.start_s + elapsed_s - step_start_s;
  return state;
}

void Planner::Append(Route::Leg leg, double duration_s) {
  leg.start_s = time_s_;
  leg.duration_s = duration_s;
  leg.start = now_;
  leg.step_start_s = step_start_s_;
  legs_.push_back(std::move(leg));
  time_s_ += duration_s;
  now_ = StateIn(legs_.back(), duration_s);
  now_.speed_mps = now_.acceleration_mps2 = now_.yaw_rate_rad_s = now_.curvature_per_m = 0;
}

/// The corners of the `go` steps from `step` on that join without a stop between them.
std::vector<Corner> CornersFrom(const RoutePlan& plan, std::size_t step) {
  std::vector<Corner> corners;
  for (std::size_t i = step; i < plan.steps.size(); ++i) {
    const RouteStep& next = plan.steps[i];
    if (next.go.empty() || next.reverse != plan.steps[step].reverse) break;
    for (const Eigen::Vector2d& point : next.go) {
      corners.push_back({{point, next.corner_radius_m, next.speed_mps}, static_cast<int>(i)});
    }
  }
  return corners;
}

}  // namespace

Route::Route(const RoutePlan& plan, const RouteLimits& limits) {
  Planner planner(plan, limits);
  for (const PacedLeg& leg : plan.paced) planner.Follow(leg);
  for (std::size_t i = 0; i < plan.steps.size();) {
    const RouteStep& step = plan.steps[i];
    planner.BeginStep(static_cast<int>(i));
    if (step.turn_to_rad) planner.TurnTo(*step.turn_to_rad);
    if (step.wait_s) planner.Pause(*step.wait_s);
    std::size_t joined = 1;
    if (!step.go.empty()) {
      const std::vector<Corner> corners = CornersFrom(plan, i);
      planner.Drive(corners, step.reverse);
      joined = static_cast<std::size_t>(corners.back().step) - i + 1;
    }
    i += joined;
  }
  legs_ = planner.TakeLegs();
  start_.position = plan.start;
  start_.heading_rad = plan.heading_rad;
  end_ = planner.now();
  end_.finished = true;
  duration_s_ = planner.time_s();
  behind_m_ = plan.behind_m;
  for (const Leg& leg : legs_) {
    if (behind_m_ == 0 || (!leg.reverse && leg.turn_sign == 0)) continue;
    throw RouteError(leg.start.step, leg.reverse ? "a trailer cannot follow backwards"
                                                 : "a trailer cannot follow a turn on the spot");
  }
}

RouteState Route::At(double time_s) const {
  const RouteState lead = LeadAt(time_s);
  if (behind_m_ == 0) return lead;
  RouteState state = lead;
  state.odometer_m = lead.odometer_m - behind_m_;
  state.position =
      start_.position + state.odometer_m * Eigen::Vector2d(std::cos(start_.heading_rad),
                                                           std::sin(start_.heading_rad));
  state.heading_rad = start_.heading_rad;
  state.curvature_per_m = 0;
  for (const Leg& leg : legs_) {
    const double along = state.odometer_m - leg.start.odometer_m;
    if (along < 0) break;
    if (leg.path.length_m() == 0) continue;
    const PathPoint point = leg.path.At(along);
    const double turned = point.heading_rad - leg.path.At(0).heading_rad;
    state.position = point.position;
    state.heading_rad = leg.start.heading_rad + turned;
    state.curvature_per_m = along <= leg.path.length_m() ? point.curvature_per_m : 0;
  }
  state.yaw_rate_rad_s = state.curvature_per_m * state.speed_mps;
  return state;
}

RouteState Route::LeadAt(double time_s) const {
  if (legs_.empty() || time_s >= duration_s_) {
    RouteState state = end_;
    state.step_elapsed_s = time_s - duration_s_;
    return state;
  }
  const auto after =
      std::upper_bound(legs_.begin() + 1, legs_.end(), time_s,
                       [](double time, const Leg& leg) { return time < leg.start_s; });
  const Leg& leg = *std::prev(after);
  return StateIn(leg, std::max(0.0, time_s - leg.start_s));
}

}  // namespace aisle::sim
