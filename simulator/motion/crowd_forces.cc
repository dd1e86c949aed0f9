#include "simulator/motion/crowd_forces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aisle::sim {
namespace {

using Eigen::Vector2d;

constexpr double kRelaxation_s = 0.5;
constexpr double kPersonPotential = 2.1, kPersonRange_m = 0.3;  // V0 (m²/s²), sigma
constexpr double kBorderPotential = 10, kBorderRange_m = 0.2;   // U0 (m²/s²), R
constexpr double kStride_s = 2;                                 // Delta t of the ellipse
const double kSightCosine = std::cos(100 * std::numbers::pi / 180);
constexpr double kUnseen = 0.5;
constexpr double kForesight_s = 3;      // how far people see an intruder coming
constexpr double kIntruder_mps2 = 2.2;  // most that one pushes
constexpr double kMost_mps2 = 6;        // bounds each push

Vector2d Bounded(const Vector2d& force) {
  const double norm = force.norm();
  return norm > kMost_mps2 ? Vector2d(force * (kMost_mps2 / norm)) : force;
}

}  // namespace

Vector2d GoalForce(const BodyNow& body, const Vector2d& way, double wanted_mps) {
  const double length = way.norm();
  const Vector2d wanted = length > 1e-9 ? Vector2d(way * (wanted_mps / length)) : Vector2d(0, 0);
  return (wanted - body.velocity()) / kRelaxation_s;
}

Vector2d PersonForce(const BodyNow& body, const BodyNow& other) {
  const Vector2d r = body.position - other.position;
  const Vector2d y = kStride_s * other.velocity();
  const Vector2d s = r - y;
  const double rn = std::max(r.norm(), 1e-6), sn = std::max(s.norm(), 1e-6);
  const double b = std::sqrt(std::max((rn + sn) * (rn + sn) - y.squaredNorm(), 1e-6)) / 2;
  // Minus the gradient of V0 exp(-b / sigma).
  const Vector2d force = kPersonPotential / kPersonRange_m * std::exp(-b / kPersonRange_m) *
                         ((rn + sn) / (4 * b)) * (r / rn + s / sn);
  const bool is_seen = body.ahead().dot(-force) >= kSightCosine * force.norm();
  return Bounded((is_seen ? 1 : kUnseen) * force);
}

Vector2d BorderForce(const Vector2d& nearest, const Vector2d& at) {
  const Vector2d off = at - nearest;
  const double distance = off.norm();
  if (distance < 1e-9) return {0, 0};
  return Bounded(kBorderPotential / kBorderRange_m * std::exp(-distance / kBorderRange_m) *
                 (off / distance));
}

Vector2d IntruderForce(const BodyNow& body, const CrowdIntruder& intruder, double time_s) {
  constexpr double kStep_s = 0.3;
  Vector2d force(0, 0);
  double strongest = 0;
  for (double ahead_s = 0; ahead_s <= kForesight_s; ahead_s += kStep_s) {
    const Vector2d then = body.position + ahead_s * body.velocity();
    const Vector2d off = then - intruder.At(time_s + ahead_s);
    const double gap = off.norm() - intruder.radius_m;
    const double push = kIntruder_mps2 * std::exp(-std::max(gap - 0.35, 0.0) / 0.25) *
                        (1 - 0.7 * ahead_s / kForesight_s);
    if (push <= strongest || off.norm() < 1e-6) continue;
    strongest = push;
    force = push * off.normalized();
  }
  return force;
}

Vector2d NearestOf(const CrowdBlock& block, const Vector2d& at) {
  const Eigen::Rotation2Dd turn(block.heading_rad);
  const Vector2d local = turn.inverse() * Vector2d(at - block.center);
  return block.center + turn * Vector2d(local.cwiseMax(-block.half).cwiseMin(block.half));
}

double DistanceTo(const CrowdBlock& block, const Vector2d& at) {
  return (at - NearestOf(block, at)).norm();
}

}  // namespace aisle::sim
