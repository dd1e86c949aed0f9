#pragma once

#include <vector>

#include "harness/loop/drive_scene.h"

namespace aisle {

/// The people and vehicles of a course over time: each goes through its script, and those who
/// yield wait, their clock slowing down and speeding up again within half a second. Somebody who
/// waits for a vehicle that has stood for three seconds goes on. A train, a tractor with its
/// trailers or a person with a cart, has one clock and waits where any of its parts would; a part
/// that does not say how near it yields does as who moves it.
class Traffic {
 public:
  explicit Traffic(const DriveScene& scene);

  const std::vector<ScriptClock>& clocks() const { return clocks_; }
  /// Where all of them are.
  const std::vector<Capsule>& capsules() const { return capsules_; }
  /// Time passes; the vehicle is there and moves at that speed. It stands while none of its
  /// corners is under way.
  void Advance(std::int64_t duration_ns, const FloorPose& vehicle, double speed_mps,
               double turn_rate_rad_s);

 private:
  bool Waits(std::size_t actor, const Polygon& vehicle) const;

  const DriveScene& scene_;
  std::vector<std::size_t> leaders_;  ///< per actor: who moves it, or itself
  std::vector<ScriptClock> clocks_;
  std::vector<Capsule> capsules_;
  double stood_s_ = 0;
};

}  // namespace aisle
