#pragma once

#include <string>
#include <vector>

namespace aisle {

/// What the name of a score stands for.
struct ScoreDescription {
  std::string name;  ///< "ate_rmse_m"; a '*' stands for a stage or class that runs bring with them
  std::string unit;  ///< "1" for shares and counts
  std::string help;  ///< one sentence
  bool is_share = false;  ///< from 0 to 1
};

/// Every score that a run can have, in the order in which a page explains them.
const std::vector<ScoreDescription>& ScoreNames();

/// Whether a run can have a score of that name.
bool IsScoreName(const std::string& name);

/// The unit of its values; empty for what is no score.
std::string UnitOf(const std::string& name);

/// Whether it is a share, from 0 to 1; false for what is no score.
bool IsShare(const std::string& name);

/// Whether only a run can have it whose vehicle the system steers: of a scene with a `drive`.
bool IsDriveScore(const std::string& name);

}  // namespace aisle
