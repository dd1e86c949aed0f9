#pragma once

#include "slam/common/option_fields.h"
#include "slam/optimize/optimize_options.h"

namespace aisle::slam {

/// The constants of the published ORB-SLAM2, stereo (Mur-Artal and Tardos 2017, and what its
/// authors released), for whatever it decides differently from us. They are its authors': changing
/// one makes another system of it.
struct OrbSlam2Options {
  int first_features = 500;  ///< more than this many in the frame that starts a map

  // The last frame's points where the motion before leads, and twice as wide if they are too few.
  double motion_radius_px = 7;  ///< pixels of the last frame's level
  int motion_distance = 100;    ///< bits
  int least_motion_matches = 20;
  // Else the points of the reference keyframe by their looks.
  int reference_distance = 50;  ///< bits
  double reference_ratio = 0.7;
  int least_reference_matches = 15;
  int least_first_inliers = 10;  ///< of either pose

  // The other points around.
  double ahead_radius_px = 2.5;   ///< pixels of the predicted level, of points seen as before ...
  double ahead_cosine = 0.998;    ///< ... from within this angle,
  double aside_radius_px = 4;     ///< and of others
  double found_again_factor = 5;  ///< on both, ...
  int found_again_frames = 2;     ///< ... in so many frames, the first one that was found included
  int map_distance = 100;         ///< bits
  double map_ratio = 0.8;
  int local_keyframes = 80;  ///< the observers of the frame's points are joined by others up to it
  int neighbours = 10;       ///< of which each observer may bring one
  int least_inliers = 30;    ///< fewer: lost
  int least_inliers_after_loss = 50;  ///< for as long as `settles_s` after being found again
  double settles_s = 1;               ///< published as the frames of a second, as is `longest_s`

  // Finding a lost frame.
  double lost_ratio = 0.75;
  int least_lost_matches = 15;
  AlignPointsOptions align{.least_inliers = 10};
  int least_found_inliers = 50;     ///< of the pose, ...
  int least_narrow_inliers = 30;    ///< ... for which more of these are asked before
  double wide_radius_px = 10;       ///< search for more
  int wide_distance = 100;          ///< bits
  double narrow_radius_px = 3;      ///< search for the last ones
  int narrow_distance = 64;         ///< bits
  int least_keyframes_to_keep = 5;  ///< a map of no more than these is given up once it is lost

  // When a frame becomes a keyframe, and what it brings.
  double close_baselines = 35;  ///< depth up to which a stereo point counts as close
  int few_close = 100;          ///< tracked close points below this ...
  int many_new_close = 70;      ///< ... with more untracked than this: close points are needed
  double tracked_share = 0.75;  ///< of the reference keyframe's points ...
  double tracked_share_at_first = 0.4;  ///< ... and while it is the only one
  double alarming_share = 0.25;         ///< below: though the mapper is at work
  int least_keyframe_inliers = 15;      ///< a keyframe has more
  double longest_s = 1;                 ///< since the last keyframe
  int most_waiting = 3;                 ///< keyframes that wait for the mapper
  int most_unsettled = 20;              ///< keyframes of a map that takes others while it settles
  int proven_weight = 3;                ///< observation weight of a reference point that counts
  int nearest_points = 100;             ///< made of stereo points at least, however far
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, OrbSlam2Options& options);

}  // namespace aisle::slam
