#include "simulator/motion/vehicle.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace aisle::sim {

double RolledAngle(const Wheel& wheel, const RouteState& now, double heading_at_start_rad) {
  const double turned = now.heading_rad - heading_at_start_rad;
  return (now.odometer_m - wheel.y_m * turned) / wheel.radius_m;
}

double SteeringAngle(const Wheel& wheel, double curvature_per_m) {
  return std::atan2(wheel.x_m * curvature_per_m, 1 - wheel.y_m * curvature_per_m);
}

double SmoothCurvature(const Route& route, double time_s, double window_s) {
  constexpr int kTaps = 15;
  double sum = 0;
  for (int i = 0; i < kTaps; ++i) {
    const double offset = window_s * ((i + 0.5) / kTaps - 0.5);
    sum += route.At(time_s + offset).curvature_per_m;
  }
  return sum / kTaps;
}

MastLift::MastLift(std::span<const MastMove> moves, double speed_mps, double acceleration_mps2) {
  double height = 0, free_s = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const double rise = moves[i].height_m - height;
    if (moves[i].at_s < free_s) {
      throw std::invalid_argument(
          fmt::format("move {} begins at {:g} s, but the one before needs until {:.2f} s", i,
                      moves[i].at_s, free_s));
    }
    if (rise == 0) continue;
    const SpeedLimit limit{std::abs(rise), speed_mps};
    runs_.push_back({moves[i].at_s, height, rise < 0 ? -1.0 : 1.0,
                     SpeedProfile::FromRestToRest({&limit, 1}, acceleration_mps2)});
    height = moves[i].height_m;
    free_s = moves[i].at_s + runs_.back().profile.duration_s();
  }
}

double MastLift::HeightAt(double time_s) const {
  double height = 0;
  for (const Run& run : runs_) {
    if (time_s < run.start_s) break;
    height = run.from_m + run.sign * run.profile.At(time_s - run.start_s).distance_m;
  }
  return height;
}

}  // namespace aisle::sim
