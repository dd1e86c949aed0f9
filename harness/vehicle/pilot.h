#pragma once

#include <deque>
#include <optional>

#include "harness/contract/drive_log.h"
#include "harness/vehicle/driver.h"
#include "harness/vehicle/watch.h"

namespace aisle {

struct PilotOptions {
  DriverOptions driver;
  WatchOptions watch;
  /// T_vehicle_rig: where the camera is mounted, as commissioned.
  Eigen::Isometry3d T_vehicle_rig = Eigen::Isometry3d::Identity();
  /// Where the SLAM's world lies on the site, where a teaching has told; else the first pose does.
  std::optional<Eigen::Isometry3d> T_site_slam = {};
};

/// The computer of a vehicle: what its wheels and its SLAM say goes in, commands come out. It knows
/// its planned way and where it was put at the start, nothing else; truth has no way in.
///
/// The SLAM's world is joined to the site's once, by the first pose: at that frame the vehicle is
/// where its wheels put it, which at the first frame is the start; or beforehand, by a teaching. A
/// world that the SLAM begins anew (another `map_id`) is joined in the same way. From then on poses
/// are believed as they are. Between them, and over their age, the wheels carry the belief on.
class Pilot {
 public:
  Pilot(const Way& way, const FloorPose& start, const PilotOptions& options);

  /// The wheels turned: the vehicle's motion in its own frame up to `now_ns`. Times rise.
  void Rolled(std::int64_t now_ns, const FloorPose& motion);
  /// The SLAM's answer to the frame of `frame_ns` arrives at `now_ns`: T_slam_rig, or nothing; and
  /// which of its worlds that is of.
  void Told(std::int64_t frame_ns, std::int64_t now_ns,
            const std::optional<Eigen::Isometry3d>& T_slam_rig, int map_id = 0);
  /// What to do until the next call, `duration_s` after the last.
  DriveCommand Decide(std::int64_t now_ns, double duration_s);

  FloorPose belief() const { return belief_; }
  DriveMode mode() const { return mode_; }
  bool arrived() const { return driver_.arrived; }
  /// Which frame's pose it steers by; nothing before the first.
  std::optional<std::int64_t> steers_by_ns() const { return steers_by_ns_; }
  const DriverState& driver() const { return driver_; }

 private:
  struct Rolling {
    std::int64_t stamp_ns = 0;
    FloorPose pose;  ///< dead-reckoned from the start
    double way_m = 0, turn_rad = 0;
  };
  const Rolling& RollingAt(std::int64_t stamp_ns) const;
  DriverInput Input(std::int64_t now_ns, double duration_s) const;

  const PilotOptions options_;
  const Way way_;
  std::deque<Rolling> rolled_;
  FloorPose belief_;
  std::optional<Eigen::Isometry3d> T_site_slam_;
  int map_id_ = 0;  ///< of the world that T_site_slam_ places
  std::optional<std::int64_t> steers_by_ns_;
  WatchState watch_;
  DriverState driver_;
  DriveMode mode_ = DriveMode::kWaiting;
};

}  // namespace aisle
