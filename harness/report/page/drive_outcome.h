#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/record/group.h"
#include "harness/report/page/page.h"

namespace aisle {

/// How the drives of a system that steers ended, over the seeds.
struct DriveOutcome {
  std::size_t runs = 0;
  double docking_m = 0;        ///< median distance of the true vehicle from its goal at the end
  std::size_t missed = 0;      ///< of the runs: ended out of the goal's bounds
  std::size_t hit_things = 0;  ///< touched what stands
  std::size_t hit_people = 0;  ///< ran into somebody
  std::size_t hit_others = 0;  ///< ran into another vehicle
  bool is_clean() const { return missed + hit_things + hit_people + hit_others == 0; }
};

/// Nothing where no run was steered.
std::optional<DriveOutcome> OutcomeOf(const std::vector<const RunRecord*>& runs);

/// "misses its goal (in 2 of 9), touches people": what went wrong, or an empty string.
std::string WrongsInWords(const DriveOutcome& outcome);

/// "On drive/close_behind, plain docks 1.1 mm off; orbslam2 stands 8.80 m from its goal, misses its
/// goal and touches things and people." Empty where nobody steers.
std::string DriveSentence(const SceneRuns& scene);

/// A table: the docking error of every system that steers, and what it missed and touched; empty
/// where no scene has a drive.
std::string DriveOverview(const std::vector<SceneRuns>& scenes, SceneLinks links);

}  // namespace aisle
