#pragma once

#include <cstdint>
#include <string>

#include "harness/vehicle/plant.h"

namespace aisle {

/// How the wheels' own measurement errs. The systematic parts are drawn once a run, as normal
/// deviates of these widths; the rest at every step. Of a differential drive both wheels are
/// measured, of a tricycle the driven wheel's way and its steering angle.
///
///   way' = way (1 + radius + side * inequality / 2 + slip * acceleration) + N(0, noise * |way|)
///
/// counted in whole encoder counts; the pose follows from it by the nominal track or wheelbase
/// (Borenstein & Feng 1996 name the two systematic errors).
struct OdometryOptions {
  double radius_error = 0.003;        ///< share, of all wheels alike
  double inequality = 0.001;          ///< share, of the right wheel over the left
  double track_error = 0.005;         ///< share, of track width or wheelbase
  double steering_error_rad = 0.003;  ///< tricycle: zero of the steering encoder
  double noise_m = 1e-5;              ///< variance a metre of way, m^2/m
  double slip_per_mps2 = 0.004;       ///< share of the way, per m/s^2 of acceleration
  int counts_per_rev = 4096;
  double wheel_radius_m = 0.1;
};

/// What an odometer has made of a drive so far.
struct Reckoning {
  FloorPose pose;                  ///< of the vehicle, from where it began
  double way_m = 0, turn_rad = 0;  ///< all that it rolled and turned, whichever way

  void Add(const FloorPose& moved) {
    pose = pose * moved;
    way_m += moved.position.norm();
    turn_rad += std::abs(moved.heading_rad);
  }
};

/// Reads a vehicle's encoders. A plain value: a copy goes on as the original would. Numbers are
/// drawn from (seed, step, wheel) alone.
class Odometer {
 public:
  Odometer(const OdometryOptions& options, const PlantOptions& plant, std::uint64_t seed);

  /// What the encoders make of a step: the vehicle's motion in its own frame.
  FloorPose Measure(const PlantStep& step);

 private:
  double Counted(double way_m, double error, double acceleration, int wheel);

  OdometryOptions options_;
  PlantOptions plant_;
  std::uint64_t seed_ = 0, step_ = 0;
  double radius_ = 0, inequality_ = 0, base_ = 0, steering_ = 0;  ///< of this run
  double way_m_[2] = {0, 0};                                      ///< measured, uncounted
  std::int64_t counts_[2] = {0, 0};
};

}  // namespace aisle
