#include "harness/loop/traffic.h"

#include <algorithm>

#include "harness/contract/drive_log.h"

namespace aisle {
namespace {

constexpr double kSlowing_s = 0.5;  // from walking to standing
constexpr double kPatience_s = 3;   // a vehicle that stands as long is not waited for

}  // namespace

Traffic::Traffic(const DriveScene& scene) : scene_(scene), clocks_(scene.course().actors.size()) {
  for (std::size_t i = 0; i < clocks_.size(); ++i) capsules_.push_back(scene_.ActorAt(i, 0));
}

void Traffic::Advance(std::int64_t duration_ns, const Polygon& vehicle, double speed_mps) {
  const double duration_s = 1e-9 * static_cast<double>(duration_ns);
  stood_s_ = std::abs(speed_mps) < kUnderWay_mps ? stood_s_ + duration_s : 0;
  const std::vector<CourseActor>& actors = scene_.course().actors;
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    ScriptClock& clock = clocks_[i];
    const bool waits = actors[i].yields && stood_s_ < kPatience_s &&
                       Distance(vehicle, capsules_[i]) < actors[i].yields_within_m;
    const double step = duration_s / kSlowing_s;
    clock.rate = std::clamp(clock.rate + (waits ? -step : step), 0.0, 1.0);
    clock.time_ns += std::llround(clock.rate * static_cast<double>(duration_ns));
  }
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    if (actors[i].goes_with >= 0)
      clocks_[i] = clocks_[static_cast<std::size_t>(actors[i].goes_with)];
    capsules_[i] = scene_.ActorAt(i, clocks_[i].time_ns);
  }
}

}  // namespace aisle
