#pragma once

#include <array>
#include <optional>
#include <vector>

namespace aisle {

/// What happens to frames that arrive while the system works.
enum class QueueRule {
  kNewest,    ///< the newest is kept for when it is done
  kDrop,      ///< none is kept
  kPipeline,  ///< it takes every frame, answers are late only
};
/// Their words in options and files, in that order.
inline constexpr std::array kQueueRuleWords = {"newest", "drop", "pipeline"};

/// How a driver turns towards its way.
enum class SteeringLaw {
  /// Regulated pure pursuit (Coulter 1992; Macenski et al. 2023): an arc through a point of the way
  /// a look-ahead d away, curvature = 2 y / d^2. Cuts corners a little, hides latency.
  kPurePursuit,
  /// Kanayama et al. 1990, along the way: turn = curvature v + v (k_y y + k_theta sin theta).
  kKanayama,
};
/// Their words in options and files, in that order.
inline constexpr std::array kSteeringLawWords = {"pure_pursuit", "kanayama"};

/// Who takes longer than that for a frame steers nothing.
inline constexpr double kLongestLatency_ms = 10'000;

/// How a system steers the vehicle of a closed drive; scenes without a `drive` do not look at it.
struct Steering {
  /// What the system takes for a frame, milliseconds: from the middle of the exposure until its
  /// pose can be used, but for frames that waited while it worked, which are older by their wait.
  double latency_ms = 0;
  /// Instead: measured times, milliseconds, one of which is drawn for each frame from (seed,
  /// frame). Empty: latency_ms holds.
  std::vector<double> latency_profile_ms = {};
  QueueRule queue = QueueRule::kNewest;
  bool scanner = false;           ///< a safety scanner stops the vehicle
  bool steered_by_truth = false;  ///< the system is shown the drive but does not steer it
  /// The way is taught first: the vehicle is led along it once, in the scene without actors, and
  /// then drives as the system's own map of that says. Needs a system that keeps a map.
  bool taught = false;
  std::optional<SteeringLaw> driver = {};  ///< none: as the scene says

  bool operator==(const Steering&) const = default;
};

}  // namespace aisle
