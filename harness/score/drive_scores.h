#pragma once

#include "harness/contract/drive_log.h"
#include "harness/contract/score.h"

namespace aisle {

/// What became of a closed drive, of the true vehicle unless the name says otherwise: was the goal
/// reached, how far off its route was it, what did it touch, how long did it take. Beside each
/// error of the way stands that of the truth-steered twin (`…_truth_steered_…`): what is the
/// driver's own. Names and sentences: score_names.h.
Scorecard ScoreDrive(const DriveLog& log);

/// Whether the vehicle stands at its goal, within the tolerance that the scene asks for.
bool ReachedGoal(const DriveLog& log, const DriveTrack& track);

}  // namespace aisle
