#include "harness/loop/traffic.h"

#include <algorithm>

#include "harness/common/seconds.h"
#include "harness/contract/drive_log.h"

namespace aisle {
namespace {

constexpr double kSlowing_s = 0.5;  // from walking to standing
constexpr double kPatience_s = 3;   // a vehicle that stands as long is not waited for

}  // namespace

Traffic::Traffic(const DriveScene& scene) : scene_(scene), clocks_(scene.course().actors.size()) {
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    const int with = scene_.course().actors[i].goes_with;
    leaders_.push_back(with < 0 ? i : static_cast<std::size_t>(with));
    capsules_.push_back(scene_.ActorAt(i, 0));
  }
}

bool Traffic::Waits(std::size_t actor, const Polygon& vehicle) const {
  const std::vector<CourseActor>& actors = scene_.course().actors;
  const CourseActor& rule = actors[actor].yields ? actors[actor] : actors[leaders_[actor]];
  return rule.yields && Distance(vehicle, capsules_[actor]) < rule.yields_within_m;
}

void Traffic::Advance(std::int64_t duration_ns, const FloorPose& vehicle, double speed_mps,
                      double turn_rate_rad_s) {
  const double duration_s = ToSeconds(duration_ns);
  const Polygon& footprint = scene_.course().footprint;
  const double fastest_mps = FastestCorner(footprint, speed_mps, turn_rate_rad_s);
  stood_s_ = fastest_mps <= kUnderWay_mps ? stood_s_ + duration_s : 0;
  std::vector<bool> waits(clocks_.size());  // per leader
  if (stood_s_ < kPatience_s) {
    const Polygon there = At(vehicle, footprint);
    for (std::size_t i = 0; i < clocks_.size(); ++i) {
      if (Waits(i, there)) waits[leaders_[i]] = true;
    }
  }
  const double step = duration_s / kSlowing_s;
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    ScriptClock& clock = clocks_[i];
    clock.rate = std::clamp(clock.rate + (waits[leaders_[i]] ? -step : step), 0.0, 1.0);
    clock.time_ns += std::llround(clock.rate * static_cast<double>(duration_ns));
    capsules_[i] = scene_.ActorAt(i, clock.time_ns);
  }
}

}  // namespace aisle
