#pragma once

#include <string>
#include <vector>

#include "harness/record/group.h"

namespace aisle {

/// Gives every live run the score `dynamic_penalty`: its ATE over that of its `empty` twin (same
/// scene, system and seed), where there is one.
void AddDynamicPenalty(std::vector<RunRecord>* runs);

/// The twin that a score cannot be told without; empty for one that each run has by itself.
std::string TwinNeededBy(const std::string& score);

/// Whether `other` is `system` without its rejection: it rejects nothing and stands on the same
/// base, with the same options but those of the rejection. False where the traits
/// of either are not known.
bool IsWithoutRejection(const SystemSpec& other, const SystemSpec& system);

/// Where one system's error on one scene comes from, told by its own drives alone: the same scene
/// with nobody in it (`empty`), with everybody standing still (`frozen`), and the same system
/// without its rejection. Medians over seeds, metres. What cannot be told apart is absent, and so
/// is what is not of whole drives (AreWholeDrives).
struct CostSplit {
  std::string scene, system;
  int color = 0;
  std::optional<double> live_m;       ///< the error as it is
  std::optional<double> empty_m;      ///< without anybody: the system itself
  std::optional<double> occlusion_m;  ///< frozen - empty: what standing in the way costs
  std::optional<double> motion_m;     ///< live - frozen: what it costs that they move
  /// live - live of its twin without rejection: below 0 what the rejection wins, above what it
  /// costs.
  std::optional<double> rejection_m;
  std::optional<double> penalty;  ///< live / empty
};

/// One entry per scene and system that has a live run and something to hold it against.
std::vector<CostSplit> SplitCosts(const std::vector<SceneRuns>& scenes);

}  // namespace aisle
