#pragma once

#include <map>
#include <vector>

#include "harness/judge/cell.h"
#include "harness/judge/compare.h"

namespace aisle {

using RunsByCell = std::map<CellOfNight, std::vector<const RunRecord*>>;

/// Each judged score of each system over all cells that two nights share, two or more: what is lost
/// in the scatter of any one of them shows over many. Decided, by p of their own share of alpha
/// (kAlphaOfPooled).
///
/// Each seed of each cell is held against its own past (Worsenings), and all of them together by a
/// sign test and Wilcoxon's signed-rank test, of which the stronger counts. The seed is the unit,
/// as it is within a cell: with nothing changed each is as likely to get worse as better, and no
/// seed's luck is another's. Scenes are not drawn by lot: what befalls all seeds of one is a change
/// and no chance. But it is one of that cell, so that worse and better need more than half of the
/// cells as well, each beyond the score's smallest effect by its middle seed.
std::vector<Comparison> ComparePooled(const RunsByCell& before, const RunsByCell& after,
                                      const CompareOptions& options);

}  // namespace aisle
