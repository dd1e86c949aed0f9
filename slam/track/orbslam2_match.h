#pragma once

#include <span>
#include <vector>

#include "slam/map/match_by_projection.h"

namespace aisle::slam {

/// A landmark and which features of a frame may show it.
struct Sought {
  const Landmark* landmark = nullptr;
  Eigen::Vector3d uvd = Eigen::Vector3d::Zero();  ///< predicted pixel and disparity
  double radius_px = 0;                           ///< in x, in y and along the right image's row
  int lowest = 0, highest = 0;                    ///< pyramid levels
};

/// The pyramid level that ORB-SLAM2 predicts: the next one above, where PredictLevel rounds.
int PredictLevelAbove(const Landmark& landmark, double distance_m, double scale, int levels);

/// Gives each landmark in turn the feature that looks most like it: at most `distance` bits off
/// and, where the second best is of the same level, at most `ratio` times as far. A feature goes to
/// the first that asks; `taken` features (by index; grows) to none. In the order of `sought`.
std::vector<Match> MatchInTurn(const Frame& frame, std::span<const Sought> sought, int distance,
                               double ratio, std::vector<bool>& taken);

/// Keeps the matches that turned as most did: `turns_deg[i]`, of matches[i], is by how much its
/// feature turned. Of the sectors of 30 degrees the fullest three remain, those aside that hold
/// less than a tenth of the fullest.
std::vector<Match> KeepCommonTurns(const std::vector<Match>& matches,
                                   const std::vector<float>& turns_deg);

}  // namespace aisle::slam
