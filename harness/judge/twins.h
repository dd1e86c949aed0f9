#pragma once

#include <string>
#include <vector>

#include "harness/record/group.h"

namespace aisle {

/// Gives every live run the score `dynamic_penalty`: its ATE over that of its `empty` twin (same
/// scene, system and seed), where there is one.
void AddDynamicPenalty(std::vector<RunRecord>* runs);

/// Where one system's error on one scene comes from; medians over seeds, metres. What cannot be
/// told apart is absent.
struct CostSplit {
  std::string scene, system;
  int color = 0;
  std::optional<double> live_m;   ///< the error as it is
  std::optional<double> empty_m;  ///< without anybody: the system itself
  std::optional<double>
      occlusion_m;                 ///< oracle live - oracle empty: what standing in the way costs
  std::optional<double> motion_m;  ///< system live - system frozen: what it costs that they move
  std::optional<double> mask_m;    ///< system live - oracle live: what imperfect rejection costs
  std::optional<double> penalty;   ///< live / empty
};

/// One entry per scene and system that has a live run and something to hold it against.
std::vector<CostSplit> SplitCosts(const std::vector<SceneRuns>& scenes);

}  // namespace aisle
