#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// All runs of one system on one version of one scene: they differ by seed and repeat.
struct SystemRuns {
  std::string system;
  int color = 0;  ///< style of its lines (StylesOf): the same in every report
  std::vector<const RunRecord*> runs;
};

/// All runs on one version of one scene: what belongs into the same charts.
struct SceneRuns {
  std::string scene, twin;
  std::vector<SystemRuns> systems;
};

/// Styles for systems: a colour, a dash and a marker each, of twelve. Ours have their own; others
/// get one of the remaining six by their name, so that a system looks the same on every page and in
/// every night while nobody else of that name's style is beside it.
inline constexpr int kStyles = 12;
std::map<std::string, int> StylesOf(const std::set<std::string>& systems);

/// The systems of all scenes with their styles, in the order of the runs.
std::vector<std::pair<std::string, int>> SystemsInOrder(const std::vector<SceneRuns>& scenes);

/// In the order of the runs. The pointers lead into `results`.
std::vector<SceneRuns> GroupByScene(const Results& results);

bool AllHave(const std::vector<const RunRecord*>& runs, const std::string& score);

/// Median over the seeds (ScoresOf); absent if one of the runs has no such score.
std::optional<double> MedianScore(const std::vector<const RunRecord*>& runs,
                                  const std::string& score);

/// Whether an error of these runs is one of whole drives and may be held against another's: every
/// run came to its end, and half of them have a pose for 99 % of the frames or more. A track with
/// the hard part missing has a small error. Runs that do not tell their coverage count as whole.
bool AreWholeDrives(const std::vector<const RunRecord*>& runs);

/// The score of each seed that has one, of a seed that ran several times the median of its repeats.
std::vector<double> ScoresOf(const std::vector<const RunRecord*>& runs, const std::string& score);

/// The run that went worst: one that failed first, else the one of the largest error
/// (`ate_rmse_m`), else the first. Never null for runs there are.
const RunRecord* WorstRun(const std::vector<const RunRecord*>& runs);

}  // namespace aisle
