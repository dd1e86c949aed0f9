#pragma once

#include <vector>

#include "harness/loop/drive_scene.h"

namespace aisle {

/// The people and vehicles of a course over time: each goes through its script, and those who
/// yield wait, their clock slowing down and speeding up again within half a second. Somebody who
/// waits for a vehicle that has stood for three seconds goes on.
class Traffic {
 public:
  explicit Traffic(const DriveScene& scene);

  const std::vector<ScriptClock>& clocks() const { return clocks_; }
  /// Where all of them are.
  const std::vector<Capsule>& capsules() const { return capsules_; }
  /// Time passes; the vehicle's footprint is at `vehicle` and moves at that speed.
  void Advance(std::int64_t duration_ns, const Polygon& vehicle, double speed_mps);

 private:
  const DriveScene& scene_;
  std::vector<ScriptClock> clocks_;
  std::vector<Capsule> capsules_;
  double stood_s_ = 0;
};

}  // namespace aisle
