#pragma once

#include "slam/common/option_fields.h"

namespace aisle::slam {

/// How landmarks meet features.
struct MatchOptions {
  double radius_px = 4;           ///< search radius in pixels of the predicted level
  int descriptor_distance = 100;  ///< bits; no match beyond
  double ratio = 0.8;             ///< best at most this x second best (of the same level)
};

/// How a landmark is found to a fraction of a pixel: FAST's corners lie on whole pixels and jump
/// from frame to frame, what surrounds them does not.
struct PatchOptions {
  int radius_px = 4;    ///< of the square compared, pixels of the level; 0: corners stay as found
  int iterations = 10;  ///< at most; not settled by then: not aligned
  double most_shift_px = 2;        ///< pixels of the level, from the corner
  double most_scale = 1.25;        ///< of one patch's pixels in the other's, either way
  double least_correlation = 0.8;  ///< normalised; below: not the same thing
  double image_noise = 3;          ///< grey levels: deviation of one pixel's brightness
  /// Of the corner's deviation: what remains once its patch is aligned, however good the texture.
  double noise_share = 0.5;
};

/// Which stereo points of a keyframe become landmarks.
struct CreateLandmarksOptions {
  /// A stereo point becomes a landmark where its depth is known this well (deviation over depth).
  double worst_depth_ratio = 0.1;
  /// With fewer of those, the best of the others make up the number: far points say little of where
  /// the rig is, but more than nothing.
  int least = 200;
  double worst_depth_ratio_then = 0.5;  ///< of these others
};

/// How features without depth of their own find each other in two keyframes.
struct TriangulateOptions {
  int neighbours = 5;              ///< keyframes compared with, most covisible first; 0: none
  int descriptor_distance = 50;    ///< bits; no match beyond
  double descriptor_ratio = 0.8;   ///< best to second best on the epipolar line
  double worst_depth_ratio = 0.1;  ///< deviation over depth; what two views place worse is left out
};

/// Which landmarks and keyframes leave the map.
struct CullOptions {
  double least_found_ratio = 0.25;  ///< of the frames that should have seen a landmark
  int probation_keyframes = 2;      ///< after this many more keyframes a landmark must be confirmed
  int least_weight = 3;             ///< observation weight (depth counts 2) of a confirmed one
  double redundant_share = 0.9;     ///< of a keyframe's landmarks seen elsewhere: it is not needed
  int redundant_observers = 3;      ///< "seen elsewhere" is in this many keyframes as sharply
  int recent_keyframes = 2;         ///< the newest keyframes are never culled
};

/// How landmarks of neighbouring keyframes become one.
struct FuseOptions {
  int neighbours = 10;           ///< keyframes, most covisible first
  int least_shared = 15;         ///< landmarks; fewer make no neighbours
  double radius_px = 3;          ///< search radius in pixels of the predicted level
  int descriptor_distance = 50;  ///< bits; no match beyond
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, MatchOptions& options);
void Describe(OptionFields& fields, PatchOptions& options);
void Describe(OptionFields& fields, CreateLandmarksOptions& options);
void Describe(OptionFields& fields, TriangulateOptions& options);
void Describe(OptionFields& fields, CullOptions& options);
void Describe(OptionFields& fields, FuseOptions& options);

}  // namespace aisle::slam
