#include "simulator/motion/joint.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace aisle::sim {
namespace {

constexpr double kGravity_mps2 = 9.80665;

/// First zeros of the Bessel function J0, and how much of each mode a push gives.
constexpr std::array<double, 2> kZeros = {2.404825557695773, 5.520078110286311};
constexpr std::array<double, 2> kShares = {0.85, 0.15};

/// Bessel functions of the first kind by their power series, good to 1e-12 up to arguments of 8:
/// the same bits everywhere, which a library does not promise.
struct Bessel {
  double j0 = 0, j1 = 0;
};
Bessel BesselOf(double x) {
  const double quarter = x * x / 4;
  Bessel sum;
  double term = 1;  // (-x²/4)^k / k!²
  for (int k = 0; k < 40; ++k) {
    sum.j0 += term;
    sum.j1 += term * (x / 2) / (k + 1);
    term *= -quarter / ((k + 1.0) * (k + 1.0));
  }
  return sum;
}

Eigen::Matrix3d Cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Turned about an axis, by Rodrigues' formula.
Placement Turned(const Eigen::Vector3d& axis, Timed angle) {
  const Eigen::Matrix3d k = Cross(axis);
  const double s = std::sin(angle.value), c = std::cos(angle.value);
  Placement placed;
  placed.pose.topLeftCorner<3, 3>() += s * k + (1 - c) * k * k;
  placed.rate.topLeftCorner<3, 3>() = angle.rate * (c * k + s * k * k);
  return placed;
}

Placement Shifted(const Eigen::Vector3d& way, const Eigen::Vector3d& velocity) {
  Placement placed;
  placed.pose.topRightCorner<3, 1>() = way;
  placed.rate.topRightCorner<3, 1>() = velocity;
  return placed;
}

/// The push's decaying sine of a frequency.
Timed Ringing(const Joint& joint, double omega, double time_s) {
  const double t = time_s - joint.at_s;
  if (t <= 0) return {};
  const double left = std::exp(-t / joint.decay_s);
  const double s = std::sin(omega * t), c = std::cos(omega * t);
  return {left * s, left * (omega * c - s / joint.decay_s)};
}

Placement LinkAt(const Joint& joint, int copy, int copies, double time_s) {
  const double link_m = joint.length_m / copies;
  const double above_m = joint.length_m - (copy + 0.5) * link_m;
  const ChainShape shape = ChainAt(joint, above_m, time_s);
  // The slope leans the link's lower end along the axis.
  const Eigen::Vector3d about = Eigen::Vector3d::UnitZ().cross(joint.axis);
  const double angle = std::atan(shape.slope.value);
  const double rate = shape.slope.rate / (1 + shape.slope.value * shape.slope.value);
  return Shifted(shape.shift_m.value * joint.axis -
                     (joint.length_m - above_m) * Eigen::Vector3d::UnitZ(),
                 shape.shift_m.rate * joint.axis) *
         Turned(about, {angle, rate});
}

double BeltRounds(const Joint& joint, int copy, int copies, double time_s) {
  return Ran(joint.run, joint.speed, time_s).value / joint.length_m +
         static_cast<double>(copy) / copies;
}

}  // namespace

Timed Moved(std::span<const JointMove> moves, double start, double time_s) {
  Timed now{start, 0};
  for (const JointMove& move : moves) {
    if (time_s <= move.at_s) break;
    const double t = (time_s - move.at_s) / move.over_s;
    if (t >= 1) {
      now = {move.to, 0};
      continue;
    }
    const double way = move.to - now.value;
    now.rate = way * 30 * t * t * (1 - t) * (1 - t) / move.over_s;
    now.value += way * t * t * t * (t * (6 * t - 15) + 10);
    break;
  }
  return now;
}

std::string MovesError(std::span<const JointMove> moves) {
  for (std::size_t i = 1; i < moves.size(); ++i) {
    const double free_s = moves[i - 1].at_s + moves[i - 1].over_s;
    if (moves[i].at_s < free_s) {
      return fmt::format("move {} begins at {:g} s, but the one before needs until {:g} s", i,
                         moves[i].at_s, free_s);
    }
  }
  return "";
}

Timed Ran(const RunTimes& run, double speed, double time_s) {
  // Of a ramp that begins at a time: seconds at full speed that the way since then is worth.
  const auto since = [&](double begin_s) -> Timed {
    const double t = time_s - begin_s;
    if (t <= 0) return {};
    if (t >= run.ramp_s) return {t - run.ramp_s / 2, 1};
    return {t * t / (2 * run.ramp_s), t / run.ramp_s};
  };
  Timed full = std::isfinite(run.from_s) ? since(run.from_s) : Timed{time_s, 1};
  if (std::isfinite(run.to_s)) {
    const Timed less = since(run.to_s);
    full = {full.value - less.value, full.rate - less.rate};
  }
  return {speed * full.value, speed * full.rate};
}

Timed Swung(const Joint& joint, double time_s) {
  const Timed ring = Ringing(joint, std::sqrt(kGravity_mps2 / joint.length_m), time_s);
  return {joint.swing * ring.value, joint.swing * ring.rate};
}

ChainShape ChainAt(const Joint& joint, double above_m, double time_s) {
  ChainShape shape;
  const double root = std::sqrt(above_m / joint.length_m);
  for (std::size_t k = 0; k < kZeros.size(); ++k) {
    const double omega = kZeros[k] / 2 * std::sqrt(kGravity_mps2 / joint.length_m);
    const Timed ring = Ringing(joint, omega, time_s);
    const Bessel form = BesselOf(kZeros[k] * root);
    const double amount = joint.swing * kShares[k];
    shape.shift_m.value += amount * form.j0 * ring.value;
    shape.shift_m.rate += amount * form.j0 * ring.rate;
    // d J0(j sqrt(z/L)) / dz = -J1 j / (2 L sqrt(z/L)), which is -j²/(4 L) at the free end.
    const double slope = root > 1e-9 ? -form.j1 * kZeros[k] / (2 * joint.length_m * root)
                                     : -kZeros[k] * kZeros[k] / (4 * joint.length_m);
    shape.slope.value += amount * slope * ring.value;
    shape.slope.rate += amount * slope * ring.rate;
  }
  return shape;
}

Placement JointAt(const Joint& joint, int copy, int copies, double time_s) {
  switch (joint.kind) {
    case Joint::Kind::kFixed:
      break;
    case Joint::Kind::kHinge:
      return Turned(joint.axis, Moved(joint.moves, joint.start, time_s));
    case Joint::Kind::kSlider: {
      const Timed way = Moved(joint.moves, joint.start, time_s);
      return Shifted(way.value * joint.axis, way.rate * joint.axis);
    }
    case Joint::Kind::kPendulum:
      return Turned(joint.axis, Swung(joint, time_s));
    case Joint::Kind::kSpin:
      return Turned(joint.axis, Ran(joint.run, joint.speed, time_s));
    case Joint::Kind::kBelt: {
      const double rounds = BeltRounds(joint, copy, copies, time_s);
      const double along = joint.length_m * (rounds - std::floor(rounds));
      return Shifted(along * joint.axis, Ran(joint.run, joint.speed, time_s).rate * joint.axis);
    }
    case Joint::Kind::kChain:
      return LinkAt(joint, copy, copies, time_s);
  }
  return {};
}

int RoundsOf(const Joint& joint, int copy, int copies, double time_s) {
  if (joint.kind != Joint::Kind::kBelt) return 0;
  return static_cast<int>(std::floor(BeltRounds(joint, copy, copies, time_s)));
}

}  // namespace aisle::sim
