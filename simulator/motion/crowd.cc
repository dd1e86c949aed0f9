#include "simulator/motion/crowd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "simulator/motion/crowd_forces.h"
#include "simulator/motion/crowd_random.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2d;

constexpr double kStep_s = kCrowdStep_s;
constexpr double kFastening_mps2 = 0.9, kBraking_mps2 = 2.0;
constexpr double kTurnRate_rad_s = 1.9;
constexpr double kMostCurvature_per_m = 2.2;
constexpr double kSlow_mps = 0.3;       // slower, a body turns on the spot rather than in a curve
constexpr double kSharpTurn_rad = 1.0;  // what it then turns at once
constexpr double kArrived_m = 0.45;
constexpr double kAhead_s = 3.5;     // for so long an intruder must not come to where one stands
constexpr double kPatience_s = 2.5;  // standing because of others; then another goal is better
constexpr int kAttempts = 24, kGoalTries = 120;

double Wrap(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

/// A body on its way, or standing (speed 0) while it turns or rests.
struct Walker {
  Vector2d position = Vector2d::Zero();
  double heading = 0, speed = 0;
  double likes_mps = 1.3;
  Vector2d goal = Vector2d::Zero();
  double busy_until_s = 0;  ///< turns or rests until then
  double held_s = 0;        ///< stands for others' sake
  double rest_s = 0;        ///< means to stop and to stand so long
  RoutePlan route;

  BodyNow now() const { return {position, heading, speed}; }
};

/// One step and what follows when it brakes: positions every step, the last is where it stands.
using Braking = std::vector<Vector2d>;

PathPoint Advance(const Vector2d& position, double heading, const PacedPiece& piece) {
  return AlongClothoid({position, heading, piece.curvature_per_m}, 0,
                       (piece.from_mps + piece.to_mps) / 2 * piece.duration_s);
}

/// Straight on, ever slower.
void Brake(Vector2d position, double heading, double speed, Braking* way) {
  while (speed > 0) {
    const double next = std::max(0.0, speed - kBraking_mps2 * kStep_s);
    position = Advance(position, heading, {kStep_s, speed, next, 0}).position;
    way->push_back(position);
    speed = next;
  }
}

class Crowd {
 public:
  Crowd(const CrowdPlan& plan, CrowdRandom random) : plan_(plan), random_(random) {}

  /// Whether all found a place and nobody was run into.
  bool Walk() {
    if (!Place()) return false;
    const int steps = static_cast<int>(std::ceil(plan_.duration_s / kStep_s));
    for (int i = 0; i < steps; ++i) {
      time_s_ = i * kStep_s;
      for (std::size_t k = 0; k < walkers_.size(); ++k) Step(k);
      if (!SafeNow(time_s_ + kStep_s)) return false;
    }
    time_s_ = steps * kStep_s;
    for (Walker& walker : walkers_) Finish(&walker);
    return true;
  }

  std::vector<RoutePlan> TakeRoutes() {
    std::vector<RoutePlan> routes;
    for (Walker& walker : walkers_) routes.push_back(std::move(walker.route));
    return routes;
  }
  bool placed() const { return walkers_.size() == static_cast<std::size_t>(plan_.people); }

 private:
  bool Inside(const Vector2d& at, double margin) const {
    return (at - plan_.from).minCoeff() >= margin && (plan_.to - at).minCoeff() >= margin;
  }

  bool FreeOfBlocks(const Vector2d& at, double margin) const {
    return Inside(at, margin) && std::ranges::all_of(plan_.blocks, [&](const CrowdBlock& block) {
             return DistanceTo(block, at) >= margin;
           });
  }

  /// Whether no intruder comes there between two times.
  bool FreeOfIntruders(const Vector2d& at, double from_s, double until_s, double margin) const {
    for (const CrowdIntruder& intruder : plan_.intruders) {
      for (double t = from_s; t <= until_s; t += kStep_s) {
        if ((intruder.At(t) - at).norm() < intruder.radius_m + plan_.radius_m + margin)
          return false;
      }
    }
    return true;
  }

  Vector2d SomePlace() {
    const double y = random_.Unit(), x = random_.Unit();
    return plan_.from + (plan_.to - plan_.from).cwiseProduct(Vector2d(x, y));
  }

  bool Place() {
    for (int i = 0; i < plan_.people; ++i) {
      std::optional<Vector2d> found;
      for (int k = 0; k < 20 * kGoalTries && !found; ++k) {
        const Vector2d at = SomePlace();
        const bool apart = std::ranges::all_of(walkers_, [&](const Walker& other) {
          return (other.position - at).norm() >= plan_.distance_m + 0.1;
        });
        if (apart && FreeOfBlocks(at, plan_.radius_m + 0.05) &&
            FreeOfIntruders(at, 0, kAhead_s + 1, 0.1)) {
          found = at;
        }
      }
      if (!found) return false;
      Walker walker;
      walker.position = *found;
      walker.likes_mps =
          std::clamp(plan_.speed_mps + plan_.speed_spread_mps * random_.Normal(), 0.4, 2.2);
      ChooseGoal(&walker);
      const Vector2d way = walker.goal - walker.position;
      walker.heading = std::atan2(way.y(), way.x());
      walker.route.start = walker.position;
      walker.route.heading_rad = walker.heading;
      walkers_.push_back(std::move(walker));
      plans_.push_back({walkers_.back().position});
    }
    return true;
  }

  bool Sees(const Vector2d& from, const Vector2d& to) const {
    const int steps = std::max(1, static_cast<int>((to - from).norm() / 0.2));
    for (int i = 1; i <= steps; ++i) {
      if (!FreeOfBlocks(from + (to - from) * i / steps, plan_.radius_m)) return false;
    }
    return true;
  }

  /// A place in sight, some way off, where nobody who does not give way will come.
  void ChooseGoal(Walker* walker) {
    double far = 3;
    for (int i = 0; i < kGoalTries; ++i, far *= 0.985) {
      const Vector2d at = SomePlace();
      const bool good = (at - walker->position).norm() > far &&
                        FreeOfBlocks(at, plan_.radius_m + 0.2) && Sees(walker->position, at) &&
                        FreeOfIntruders(at, time_s_, plan_.duration_s, 0.15);
      walker->goal = at;
      if (good) return;
    }
  }

  /// Somebody comes: to the nearest place out of the way.
  void Escape(Walker* walker) {
    walker->rest_s = 0;
    if (FreeOfIntruders(walker->goal, time_s_, time_s_ + 2 * kAhead_s, 0.1)) return;
    double nearest = 1e9;
    for (int i = 0; i < kGoalTries; ++i) {
      const double angle = 2 * std::numbers::pi * random_.Unit(), way = 0.4 + 2 * random_.Unit();
      const Vector2d at = walker->position + way * Vector2d(std::cos(angle), std::sin(angle));
      if (way > nearest || !FreeOfBlocks(at, plan_.radius_m + 0.05) ||
          !FreeOfIntruders(at, time_s_, time_s_ + 2 * kAhead_s, 0.1)) {
        continue;
      }
      nearest = way;
      walker->goal = at;
    }
  }

  /// Whether the next metre in a direction is free as all stand now.
  bool ClearAhead(std::size_t k, double heading, double way_m) const {
    const Vector2d ahead(std::cos(heading), std::sin(heading));
    for (double way = 0.2; way <= way_m; way += 0.2) {
      const Vector2d at = walkers_[k].position + way * ahead;
      if (!FreeOfBlocks(at, plan_.radius_m)) return false;
      for (std::size_t i = 0; i < walkers_.size(); ++i) {
        if (i == k) continue;
        const double apart = (walkers_[i].position - at).norm();
        if (apart < plan_.distance_m + 0.05 &&
            apart < (walkers_[i].position - walkers_[k].position).norm()) {
          return false;
        }
      }
    }
    return true;
  }

  /// The direction nearest to the goal's in which there is room; none: there is none.
  std::optional<double> ClearWay(std::size_t k) const {
    const Vector2d way = walkers_[k].goal - walkers_[k].position;
    const double straight = std::atan2(way.y(), way.x());
    const double reach = std::clamp(way.norm(), 0.4, 1.0);
    for (const double aside : {0.0, 0.4, -0.4, 0.8, -0.8, 1.2, -1.2, 1.6, -1.6}) {
      if (ClearAhead(k, straight + aside, reach)) return straight + aside;
    }
    return std::nullopt;
  }

  double TurnTime(double turn) const {
    const SpeedLimit limit{std::abs(turn), plan_.limits.turn_rate_rad_s};
    return SpeedProfile::FromRestToRest({&limit, 1}, plan_.limits.turn_acceleration_rad_s2)
        .duration_s();
  }

  /// Stands for a while: the route's last leg is a pause.
  static void Stand(Walker* walker, double duration_s) {
    std::vector<PacedLeg>& legs = walker->route.paced;
    if (legs.empty() || legs.back().pause_s == 0) legs.emplace_back();
    legs.back().pause_s += duration_s;
  }

  void Turn(Walker* walker, double turn) {
    // It takes whole steps of the clock, so that all keep time.
    const double needed = TurnTime(turn);
    const double whole = std::ceil(needed / kStep_s) * kStep_s;
    walker->route.paced.push_back({{}, turn, 0});
    if (whole - needed > 1e-9) Stand(walker, whole - needed);
    walker->heading += turn;
    walker->busy_until_s = time_s_ + whole;
  }

  void Step(std::size_t k) {
    Walker& walker = walkers_[k];
    if (time_s_ < walker.busy_until_s - 1e-9) return Remain(k);
    threatened_ = !FreeOfIntruders(walker.position, time_s_, time_s_ + kAhead_s, 0.1);
    if (threatened_) {
      Escape(&walker);
    } else if ((walker.goal - walker.position).norm() < kArrived_m) {
      Arrive(&walker);
    }
    if (walker.rest_s > 0) return Rest(k);
    const Vector2d force = ForceOn(k);
    if (walker.speed == 0 && StandStill(k)) return;
    if (TryWays(k, force)) return;
    const double next = std::max(0.0, walker.speed - kBraking_mps2 * kStep_s);
    if (walker.speed > 0) return Take(k, {kStep_s, walker.speed, next, 0});
    Stand(&walker, kStep_s);
    walker.held_s += kStep_s;
    Remain(k);
  }

  void Remain(std::size_t k) { plans_[k].assign(1, walkers_[k].position); }

  void Arrive(Walker* walker) {
    ChooseGoal(walker);
    walker->rest_s = std::floor(random_.Unit() * plan_.pause_s / kStep_s) * kStep_s;
  }

  /// Stops, gently if it can, and stands a while.
  void Rest(std::size_t k) {
    Walker& walker = walkers_[k];
    if (walker.speed == 0) {
      const bool free =
          FreeOfIntruders(walker.position, time_s_, time_s_ + walker.rest_s + kAhead_s, 0.1);
      if (free) {
        Stand(&walker, walker.rest_s);
        walker.busy_until_s = time_s_ + walker.rest_s;
      } else {
        Stand(&walker, kStep_s);
      }
      walker.rest_s = 0;
      return Remain(k);
    }
    for (const double braking : {kFastening_mps2, kBraking_mps2}) {
      const double next = std::max(0.0, walker.speed - braking * kStep_s);
      const PacedPiece piece{kStep_s, walker.speed, next, 0};
      if (braking == kBraking_mps2 || IsSafe(k, piece)) return Take(k, piece);
    }
  }

  /// Who stands turns first to where there is room; who has been held for long wants elsewhere.
  bool StandStill(std::size_t k) {
    Walker& walker = walkers_[k];
    if (time_s_ < walker.busy_until_s - 1e-9) {
      Remain(k);
      return true;
    }
    if (walker.held_s > kPatience_s) {
      walker.held_s = 0;
      ChooseGoal(&walker);
    }
    const std::optional<double> way = ClearWay(k);
    if (!way) {
      Stand(&walker, kStep_s);
      walker.held_s += kStep_s;
      Remain(k);
      return true;
    }
    const double turn = Wrap(*way - walker.heading);
    if (std::abs(turn) < kSharpTurn_rad) return false;
    Turn(&walker, turn);
    Remain(k);
    return true;
  }

  Vector2d ForceOn(std::size_t k) const {
    const Walker& walker = walkers_[k];
    const Vector2d way = walker.goal - walker.position;
    const bool near = way.norm() < 1.2;  // slows down where it means to stop
    const double wanted = walker.likes_mps * (near ? std::max(0.3, way.norm() / 1.2) : 1.0);
    Vector2d force = GoalForce(walker.now(), way, wanted);
    for (std::size_t i = 0; i < walkers_.size(); ++i) {
      if (i != k) force += PersonForce(walker.now(), walkers_[i].now());
    }
    for (const CrowdBlock& block : plan_.blocks) {
      force += BorderForce(NearestOf(block, walker.position), walker.position);
    }
    for (const Vector2d& wall : Walls(walker.position)) force += BorderForce(wall, walker.position);
    for (const CrowdIntruder& intruder : plan_.intruders) {
      force += IntruderForce(walker.now(), intruder, time_s_);
    }
    return force;
  }

  std::array<Vector2d, 4> Walls(const Vector2d& at) const {
    return {Vector2d(plan_.from.x(), at.y()), Vector2d(plan_.to.x(), at.y()),
            Vector2d(at.x(), plan_.from.y()), Vector2d(at.x(), plan_.to.y())};
  }

  /// The force's own way first, then slower and more turned ones.
  bool TryWays(std::size_t k, const Vector2d& force) {
    const Walker& walker = walkers_[k];
    const Vector2d ahead(std::cos(walker.heading), std::sin(walker.heading));
    const Vector2d left(-ahead.y(), ahead.x());
    double along = std::clamp(force.dot(ahead), -kBraking_mps2, kFastening_mps2);
    // Slow as it is, it goes on while there is room: forces alone would have it dither.
    if (walker.speed < kSlow_mps && ClearAhead(k, walker.heading, 0.4)) {
      along = std::max(along, 0.7 * kFastening_mps2);
    }
    const double yaw = std::clamp(force.dot(left) / std::max(walker.speed, kSlow_mps),
                                  -kTurnRate_rad_s, kTurnRate_rad_s);
    for (const double less : {0.0, 0.7, 1.4}) {
      for (const double more : {0.0, 0.8, -0.8, 1.6, -1.6}) {
        const double next =
            std::clamp(walker.speed + std::max(along - less, -kBraking_mps2) * kStep_s, 0.0,
                       1.3 * walker.likes_mps);
        const double mean = (walker.speed + next) / 2;
        if (mean <= 0) continue;
        const double curvature = std::clamp((yaw + more) / std::max(mean, kSlow_mps),
                                            -kMostCurvature_per_m, kMostCurvature_per_m);
        const PacedPiece piece{kStep_s, walker.speed, next, curvature};
        if (IsSafe(k, piece)) {
          Take(k, piece);
          return true;
        }
      }
    }
    return false;
  }

  Braking AfterStep(const Walker& walker, const PacedPiece& piece) const {
    const PathPoint then = Advance(walker.position, walker.heading, piece);
    Braking way = {then.position};
    Brake(then.position, then.heading_rad, piece.to_mps, &way);
    return way;
  }

  /// Whether all could still brake without meeting. Those before k in the list have already taken
  /// this step: their plan's first place is one step later than now, as k's is.
  bool IsSafe(std::size_t k, const PacedPiece& piece) const {
    const Braking way = AfterStep(walkers_[k], piece);
    for (const Vector2d& at : way) {
      if (!FreeOfBlocks(at, plan_.radius_m)) return false;
    }
    for (std::size_t i = 0; i < walkers_.size(); ++i) {
      if (i == k) continue;
      const Braking& other = plans_[i];
      // Who has not stepped yet brakes from now on: its plan's second place is for then.
      const std::size_t late = i < k ? 0 : 1;
      for (std::size_t s = 0; s < std::max(way.size(), other.size()); ++s) {
        const Vector2d& mine = way[std::min(s, way.size() - 1)];
        const Vector2d& theirs = other[std::min(s + late, other.size() - 1)];
        if ((mine - theirs).norm() < plan_.distance_m + kBetween_m) return false;
      }
    }
    const double stands_s = time_s_ + kStep_s * static_cast<double>(way.size());
    for (std::size_t s = 0; s + 1 < way.size(); ++s) {
      const double t = time_s_ + kStep_s * static_cast<double>(s + 1);
      if (!FreeOfIntruders(way[s], t, t, kBetween_m)) return false;
    }
    return FreeOfIntruders(way.back(), stands_s, stands_s + (threatened_ ? 0.5 : kAhead_s),
                           kBetween_m);
  }

  void Take(std::size_t k, const PacedPiece& piece) {
    Walker& walker = walkers_[k];
    plans_[k] = AfterStep(walker, piece);
    const PathPoint then = Advance(walker.position, walker.heading, piece);
    std::vector<PacedLeg>& legs = walker.route.paced;
    if (legs.empty() || legs.back().pieces.empty()) legs.emplace_back();
    legs.back().pieces.push_back(piece);
    walker.position = then.position;
    walker.heading = then.heading_rad;
    walker.speed = piece.to_mps;
    walker.held_s = 0;
  }

  /// Nobody is in an intruder's way as things are.
  bool SafeNow(double time_s) const {
    return std::ranges::all_of(walkers_, [&](const Walker& walker) {
      return FreeOfIntruders(walker.position, time_s, time_s, 0);
    });
  }

  /// The scene is over: legs go from rest to rest.
  static void Finish(Walker* walker) {
    while (walker->speed > 0) {
      const double next = std::max(0.0, walker->speed - kBraking_mps2 * kStep_s);
      walker->route.paced.back().pieces.push_back({kStep_s, walker->speed, next, 0});
      walker->speed = next;
    }
  }

  /// Between two steps bodies that go past each other at w m/s come nearer than at both ends by
  /// less than (w step)² / 8 distance: 28 mm at 3.6 m/s and half a metre.
  static constexpr double kBetween_m = 0.03;

  const CrowdPlan& plan_;
  CrowdRandom random_;
  double time_s_ = 0;
  bool threatened_ = false;  ///< who steps now stands where an intruder will come
  std::vector<Walker> walkers_;
  std::vector<Braking> plans_;  ///< of each: from its last step on
};

}  // namespace

std::vector<RoutePlan> WalkCrowd(const CrowdPlan& plan, std::uint64_t seed) {
  bool placed = true;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Crowd crowd(plan, CrowdRandom(seed, static_cast<std::uint64_t>(attempt)));
    if (crowd.Walk()) return crowd.TakeRoutes();
    placed = crowd.placed();
  }
  throw std::invalid_argument(
      placed ? fmt::format("somebody does not get out of the way of the rig or an actor in any of "
                           "{} attempts: give them more room, or fewer people",
                           kAttempts)
             : fmt::format("there is no room for {} people {:g} m apart between [{:g}, {:g}] and "
                           "[{:g}, {:g}]: fewer people, or a larger part of the hall",
                           plan.people, plan.distance_m, plan.from.x(), plan.from.y(), plan.to.x(),
                           plan.to.y()));
}

}  // namespace aisle::sim
