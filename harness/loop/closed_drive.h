#pragma once

#include <cstdint>
#include <memory>

#include "harness/contract/drive_log.h"
#include "harness/contract/steering.h"
#include "harness/loop/localiser.h"
#include "harness/loop/scanner.h"

namespace aisle {

/// A way that was taught (TaughtWay) and the map that it was taught in.
struct TaughtCourse {
  Way way;
  Eigen::Isometry3d T_site_slam = Eigen::Isometry3d::Identity();
};

struct LoopOptions {
  Steering steering;
  std::uint64_t seed = 1;  ///< of the odometry and the latency profile
  ScannerOptions scanner = {};
  /// What the vehicle drives by instead of the course's own way; scores stay with that one.
  std::optional<TaughtCourse> taught = {};
  double no_progress_after_s = 30;  ///< of standing, pauses and steering aside: the end
  /// The end after so many times the planned time, and so much more.
  double timeout_over_planned = 3, timeout_extra_s = 60;
};

/// What is wrong with how a system steers, or an empty string.
std::string Validate(const Steering& steering);

/// Drives the vehicle through the course, steered by what the localiser says: in ticks of control,
/// plant, traffic, wheels and camera in one thread, in a time that no clock decides. Of `steering`,
/// `steered_by_truth` shows the frames to `localiser` and steers by their true pose.
DriveTrack DriveClosed(const DriveScene& scene, Localiser* localiser, const LoopOptions& options);

/// The same drive from frame to frame, for who asks it rather than being asked:
///
///   while (const Exposure* frame = drive.Next()) drive.Tell(pose_of(*frame));
///
/// The scene must outlive it.
class ClosedDrive {
 public:
  ClosedDrive(const DriveScene& scene, const LoopOptions& options);
  ClosedDrive(ClosedDrive&&) noexcept;
  ~ClosedDrive();

  /// Drives on to the next frame that the system looks at; null when the drive is over. The same
  /// one again until something is told of it.
  const Exposure* Next();
  /// What the system says of that frame: T_slam_rig in a world of its own, or nothing: lost. The
  /// vehicle joins each world of another `map_id` to the site anew, by where its wheels put it.
  void Tell(const std::optional<Eigen::Isometry3d>& T_slam_rig, int map_id = 0);
  /// It crashed or spoke nonsense: the drive ends at this instant.
  void Fail();
  /// The vehicle now.
  DriveSample Now() const;
  /// What has been driven so far; whole when the drive is over.
  const DriveTrack& track() const;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

/// What a log says of a course and how it was driven; tracks left aside.
DriveLog LogOf(const Course& course, const Steering& steering);

}  // namespace aisle
