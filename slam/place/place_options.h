#pragma once

#include "slam/common/option_fields.h"
#include "slam/optimize/optimize_options.h"

namespace aisle::slam {

/// When a place counts as seen before.
struct LoopOptions {
  int candidates = 3;             ///< keyframes looked at closely, most alike first
  int recent_keyframes = 10;      ///< the newest ones are no loop
  double similarity_ratio = 0.8;  ///< of the similarity to the least alike neighbour
  int descriptor_distance = 50;   ///< bits
  double descriptor_ratio = 0.8;  ///< best to second best
  AlignPointsOptions align;       ///< the pose between the two keyframes
  int least_inliers = 40;         ///< landmarks of the old place that the new view confirms
  double radius_px = 8;           ///< search for those, pixels of the predicted level
  /// Loops that must tell the same correction before it is made, and the landmarks that they must
  /// confirm together: three loops that just suffice, or two clear ones.
  int consistent_loops = 2, consistent_inliers = 120;
  int neighbours = 3;            ///< keyframes before the newest that are asked for its loop, ...
  int neighbour_shared = 30;     ///< ... of those that share so many landmarks with it
  int pending_keyframes = 10;    ///< keyframes after which an unconfirmed loop is forgotten
  double consistency_m = 0.1;    ///< translation by which two corrections may differ
  double consistency_deg = 1.0;  ///< rotation by which two corrections may differ
  double drift_share = 0.02;     ///< of the path in between: no correction may be larger, ...
  double drift_m = 0.3;          ///< ... this aside: racks that look alike stand further apart
  LoopSpreadOptions spread;      ///< of a correction that is made
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, LoopOptions& options);

}  // namespace aisle::slam
