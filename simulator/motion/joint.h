#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

namespace aisle::sim {

/// A value over time and its rate, per second.
struct Timed {
  double value = 0;
  double rate = 0;
};

/// Begin at a time to go to a value (rad or m), and be there so much later.
struct JointMove {
  double at_s = 0;
  double to = 0;
  double over_s = 1;  ///< > 0
};

/// Something that runs between two times, and speeds up and slows down evenly.
struct RunTimes {
  double from_s = -std::numeric_limits<double>::infinity();  ///< -inf: it has always run
  double to_s = std::numeric_limits<double>::infinity();     ///< begins to slow down
  double ramp_s = 0.5;                                       ///< of speeding up and slowing down
};

/// How one part of a mechanism moves against the one it is fixed to.
struct Joint {
  enum class Kind {
    kFixed,
    kHinge,     ///< turns about the axis by moves
    kSlider,    ///< shifts along the axis by moves
    kPendulum,  ///< is pushed at `at_s` and swings about the axis, ever less
    kSpin,      ///< turns about the axis at a rate while it runs
    kBelt,      ///< shifts along the axis while it runs; comes round after `length_m`
    kChain,     ///< hangs from its top, swings along the axis: one link of it a copy
  } kind = Kind::kFixed;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit; in the part's own frame
  std::vector<JointMove> moves;                     ///< hinge (rad) and slider (m)
  double start = 0;                                 ///< their value before the first move
  double speed = 0;                                 ///< spin (rad/s) and belt (m/s)
  RunTimes run;                                     ///< spin and belt
  double length_m = 1;  ///< pendulum: of the equal simple one; chain: its own; belt: a round
  double swing = 0;     ///< pendulum: first swing undamped (rad); chain: of its free end (m)
  double decay_s = std::numeric_limits<double>::infinity();  ///< time constant of the swinging
  double at_s = 0;                                           ///< pendulum, chain: when it is pushed
};

/// A placement and its rate of change: both 4 × 4, p_parent = pose p, v_parent = rate p.
struct Placement {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d rate = Eigen::Matrix4d::Zero();

  /// By the product rule.
  friend Placement operator*(const Placement& a, const Placement& b) {
    return {a.pose * b.pose, a.rate * b.pose + a.pose * b.rate};
  }
};

/// Values that go from one to the next by the least jerk (Flash and Hogan, J. Neurosci. 5, 1985):
/// 6 t^5 - 15 t^4 + 10 t^3, at rest and without acceleration at either end.
Timed Moved(std::span<const JointMove> moves, double start, double time_s);
/// What is wrong with moves (one begins before the last ends), or an empty string.
std::string MovesError(std::span<const JointMove> moves);

/// Way at a speed: 0 at from_s (at time 0 where it has always run), even ramps.
Timed Ran(const RunTimes& run, double speed, double time_s);

/// Angle of a simple pendulum in small swings: swing · e^(-t/decay) · sin(sqrt(g/length) t) since
/// the push, 0 before it.
Timed Swung(const Joint& joint, double time_s);

/// A hanging chain's small swing: sideways shift at `above_m` over its free end, and its slope
/// against the plumb line, each with its rate. The modes are Bernoulli's, J0(j_k sqrt(z/length)) at
/// j_k/2 sqrt(g/length) (Lamb, Hydrodynamics, 1932, par. 192); it is pushed in the first two.
struct ChainShape {
  Timed shift_m, slope;
};
ChainShape ChainAt(const Joint& joint, double above_m, double time_s);

/// Where a part is in its own resting frame. `copy` of `copies` says which link of a chain or which
/// box of a belt it is; others move alike.
Placement JointAt(const Joint& joint, int copy, int copies, double time_s);

/// How often that copy has come round: once over, it is another box. 0 for all but belts.
int RoundsOf(const Joint& joint, int copy, int copies, double time_s);

}  // namespace aisle::sim
