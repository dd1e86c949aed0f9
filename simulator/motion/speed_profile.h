#pragma once

#include <limits>
#include <span>
#include <vector>

namespace aisle::sim {

/// Where a mover is along its path at one time.
struct Travel {
  double distance_m = 0;
  double speed_mps = 0;
  double acceleration_mps2 = 0;
};

/// A stretch of path and the speed allowed on it.
struct SpeedLimit {
  double length_m = 0;   ///< > 0
  double speed_mps = 0;  ///< > 0
};

/// Distance over time from rest to rest: speeding up and slowing down by the same acceleration, and
/// that built up and taken back within a jerk. Works for angles as well as for metres.
///
/// Without a jerk limit it is as fast as the limits allow: speed is made of trapezoids. With one it
/// is the moving average of such trapezoids over twice acceleration / jerk, the time from full
/// acceleration to full braking: no faster and no steeper anywhere, and of the same length.
class SpeedProfile {
 public:
  /// A time span of constant jerk.
  struct Phase {
    double start_s = 0;
    double duration_s = 0;
    Travel start;
    double jerk_mps3 = 0;
  };

  SpeedProfile() = default;
  /// Throws std::invalid_argument unless all lengths, speeds, acceleration and jerk are positive.
  static SpeedProfile FromRestToRest(std::span<const SpeedLimit> limits, double acceleration_mps2,
                                     double jerk_mps3 = std::numeric_limits<double>::infinity());

  /// Speeds that are known beforehand: each stretch goes evenly from the speed of the one before to
  /// its own within its time. Throws std::invalid_argument unless all times are positive.
  struct Stretch {
    double duration_s = 0;
    double to_mps = 0;
  };
  static SpeedProfile Paced(double from_mps, std::span<const Stretch> stretches);

  double duration_s() const { return duration_s_; }
  double length_m() const { return length_m_; }
  const std::vector<Phase>& phases() const { return phases_; }
  /// At a time after the start; at rest before it and after the end.
  Travel At(double time_s) const;

 private:
  static SpeedProfile Trapezoids(std::span<const SpeedLimit> limits, double acceleration_mps2);
  void Append(double from_mps, double to_mps, double length_m, double acceleration_mps2);
  SpeedProfile AveragedOver(double window_s) const;

  std::vector<Phase> phases_;
  double duration_s_ = 0;
  double length_m_ = 0;
};

}  // namespace aisle::sim
