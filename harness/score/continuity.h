#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/common/seconds.h"
#include "harness/contract/run.h"
#include "harness/score/masks.h"

namespace aisle {

/// How movers are followed over time.
struct ContinuityOptions {
  /// An object that the rule does not ask for in up to so many frames goes on with its spell: its
  /// pixels or its speed fell below a threshold for a moment, or a post hid it. Such frames count
  /// for nothing: they are not covered, are no gap and end none. A longer pause ends the spell, and
  /// the object must be found anew.
  int max_pause_frames = 2;
  /// The rig turns in a frame that it came to, from the one before, at this rate or faster, deg/s.
  double turning_dps = 10;
  double within_s = 1;  ///< in this time a mover should be found
};

/// A time in which one object was asked for: from its first frame by the rule to its last.
struct MoverSpell {
  int instance = 0;
  std::string object_class;  ///< in the first frame
  std::int64_t first_ns = 0, last_ns = 0;
  int frames = 0;             ///< in which it was asked for
  double mean_speed_mps = 0;  ///< over these
  double largest_share = 0;   ///< of the image
  /// From the first frame to the first in which it was covered (IsCovered); absent: it never was.
  std::optional<double> delay_s;
  int gap_frames = 0;          ///< longest run of frames in which it was not covered any more
  int turning_frames = 0;      ///< since it was first covered, in which the rig turned
  int gap_turning_frames = 0;  ///< the most of these that fell into one gap

  double length_s() const { return ToSeconds(last_ns - first_ns); }
};

/// All spells in the given frames (in time) of the objects that `asked_for` holds for, by instance
/// and then by time. An object that moves already in the first frame starts its spell there. Frames
/// without mask facts ask for nothing.
std::vector<MoverSpell> FollowMovers(std::span<const FrameFacts> frames,
                                     const ObjectRule& asked_for,
                                     const ContinuityOptions& options = {});

/// What many spells come to. After nuScenes' tracking metrics (Caesar et al., nuScenes, CVPR 2020),
/// on masks: `delay` is the track initialization duration (TID), `gap` the longest gap duration
/// (LGD), which here says nothing of a mover that never was found.
struct Continuity {
  /// Spells that lasted within_s or longer. Shorter ones do not show whether the mover would have
  /// been found in time, so they have no part in the delays, not even where it was found: counting
  /// those alone would flatter.
  std::size_t judged = 0;
  std::size_t found_in_time = 0;  ///< of the judged
  /// Of the judged. Their delays are longer than anybody saw: each counts with its whole length, so
  /// that median and maximum are lower bounds where this is not 0.
  std::size_t never_found = 0;
  std::optional<double> delay_median_s, delay_max_s;

  std::size_t found = 0;              ///< spells of any length in which the mover was ever covered
  std::optional<int> gap_max_frames;  ///< over these
  std::size_t turning = 0;            ///< of them, those with a turning rig after the first cover
  std::optional<int> gap_turning_max_frames;  ///< over these
};
Continuity Summarize(std::span<const MoverSpell> spells, const ContinuityOptions& options = {});

/// Spells by the kind of mover: "large" (IsLargeMover) and "slow" (IsSlowMover). A mover that
/// slows down from one to the other has a spell of each.
using SpellsByKind = std::map<std::string, std::vector<MoverSpell>>;
SpellsByKind FollowKinds(std::span<const FrameFacts> frames, const ContinuityOptions& options = {});

/// For each kind K, and only where there is something to say:
/// - mover_K_found_within_1s: share of the judged spells in which the mover was found in time
/// - mover_K_found: share of them in which it was found at all
/// - mover_K_delay_median_s, mover_K_delay_max_s: lower bounds where mover_K_found is below 1
/// - mover_K_gap_max_frames: longest time, in frames, for which a mover once found was lost
/// - mover_K_gap_turning_max_frames: the most frames of one gap in which the rig turned
void AddContinuity(const SpellsByKind& spells, const ContinuityOptions& options, Scorecard* scores);

}  // namespace aisle
