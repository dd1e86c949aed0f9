#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "harness/contract/steering.h"
#include "harness/loop/drive_scene.h"

namespace aisle {

/// What the system will have said of a frame, and when.
struct Answer {
  std::int64_t frame_ns = 0;
  std::int64_t due_ns = 0;
  std::optional<Eigen::Isometry3d> T_slam_rig;
  int map_id = 0;  ///< which world of the SLAM's that is of
};

/// Latency as a model: one system that takes a while for each frame. Time is the scene's, never the
/// clock's: what it says of a frame is told at once, and handed out when it is due.
class Server {
 public:
  /// `latency_ns` tells how long a frame takes, by its id.
  Server(QueueRule rule, std::function<std::int64_t(std::int64_t frame)> latency_ns);

  /// A frame arrives at its stamp.
  void Offer(const Exposure& exposure);
  /// The frame that the system has begun and has not said anything of yet; null: none. Until it is
  /// told, nothing else goes on.
  const Exposure* asked() const { return asked_ ? &*asked_ : nullptr; }
  /// What the system says of that frame: T_slam_rig, or nothing; and of which world of its own.
  void Tell(const std::optional<Eigen::Isometry3d>& T_slam_rig, int map_id = 0);
  /// The answers that are due by now, in order, as far as they are told. A frame that waited is
  /// begun when the one before it is done.
  std::vector<Answer> Due(std::int64_t now_ns);
  /// The next time at which something is due; nothing while it is idle.
  std::optional<std::int64_t> NextDue() const;
  QueueRule rule() const { return rule_; }
  int shown() const { return shown_; }

 private:
  void Begin(const Exposure& exposure, std::int64_t at_ns);

  QueueRule rule_;
  std::function<std::int64_t(std::int64_t)> latency_ns_;
  std::deque<Answer> working_;  ///< by time due; of `asked_` the last
  std::optional<Exposure> asked_, waiting_;
  std::optional<Reckoning> wheels_before_;  ///< at the frame begun last
  int shown_ = 0;
};

}  // namespace aisle
