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
  std::size_t undriven = 0;    ///< of the runs: never drove (teaching failed, killed, crashed)
  double docking_m = 0;        ///< median distance of the true vehicle from its goal at the end, of
                               ///< those that drove; 0 where none did
  std::size_t missed = 0;      ///< of those that drove: ended out of the goal's bounds
  std::size_t hit_things = 0;  ///< touched what stands
  std::size_t hit_people = 0;  ///< ran into somebody
  std::size_t hit_others = 0;  ///< ran into another vehicle
  bool drove() const { return undriven < runs; }
  bool is_clean() const { return undriven + missed + hit_things + hit_people + hit_others == 0; }
};

/// The outcome of each system by name, in the order of the scene. Where any run of the scene has
/// driven, one that has not is one that failed to; systems that cannot steer are left out.
std::vector<std::pair<std::string, DriveOutcome>> OutcomesOf(const SceneRuns& scene);

/// "misses its goal (in 2 of 9), touches people": what went wrong, or an empty string.
std::string WrongsInWords(const DriveOutcome& outcome);

/// "On drive/close_behind, plain docks 1.1 mm off; orbslam2 stands 8.80 m from its goal, misses its
/// goal and touches things and people." Empty where nobody steers.
std::string DriveSentence(const SceneRuns& scene);

/// A table: the docking error of every system that steers, and what it missed and touched; empty
/// where no scene has a drive.
std::string DriveOverview(const std::vector<SceneRuns>& scenes, SceneLinks links);

}  // namespace aisle
