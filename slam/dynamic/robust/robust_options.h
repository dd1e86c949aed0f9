#pragma once

#include <array>
#include <cstdint>

#include "slam/common/option_fields.h"
#include "slam/flow/dense_flow_options.h"
#include "slam/stereo/dense/semi_global_options.h"

// Every constant of the robust method on one page. Lengths are in pixels of the half-size images
// unless they say otherwise. What could depend on a scene is in units of noise that is measured
// while running, or in metres a second; reports/dynamic_methods.md says how the rest was found.

namespace aisle::slam::dynamic {

/// Distances in frames over which motion is looked for: displacement grows with the gap, noise far
/// less, so the long ones find slow movers and the short one is quick.
inline constexpr std::array<int, 3> kGaps = {1, 5, 15};
inline constexpr int kLongestGap = 15;

/// What is known of a pixel before it is compared.
struct SurfaceOptions {
  double grey_noise = 2;           ///< grey levels, deviation of one pixel in the dark
  double brightness_noise = 0.02;  ///< what grows with brightness: photons, each pixel's own gain
  int window_px = 7;               ///< side of the window in which texture is gathered, odd
  /// The stereo matcher sees only padding where a match comes this close to the right image's edge.
  int border_px = 4;
};

/// Motion of the rig between two frames.
struct EgoMotionOptions {
  int cell_px = 12;          ///< one point, that of the best texture, from each square of this side
  int hypotheses = 60;       ///< three-point samples beside the prediction and standing still
  double gate_chi2 = 11.34;  ///< 99 % of chi-square with three degrees of freedom
  /// What a vehicle can do: deviation of its acceleration. A motion that would need many times this
  /// is not the vehicle's, however many points vote for it.
  double acceleration_mps2 = 1.5;
  double angular_acceleration_radps2 = 3;
  int rounds = 3;      ///< of re-weighting
  int iterations = 4;  ///< Gauss-Newton steps a round
  std::uint64_t seed = 3;
};

/// From residual flow to the log-odds of moving.
struct EvidenceOptions {
  double mover_mps = 0.5;         ///< deviation of a mover's speed, along each axis of the image
  double disparity_noise = 0.25;  ///< deviation of a disparity
  /// Errors of calibration and rolling texture grow with the way a point has gone: deviation per
  /// pixel of displacement.
  double noise_per_displacement = 0.01;
  /// Pixels of a window that count as independent when the window's grey values are to say that it
  /// has moved, and what an ill fit of the moved window takes off.
  double independent_pixels = 10, difference_weight = 0.5;
  double hidden_difference = 1.5;  ///< limit of that difference where the static surface was hidden
  /// Disparities so far apart are two matches, not one measured ill.
  double other_disparity = 1.5;
  /// Log-odds of earlier frames from which on nobody asks for what looks the same.
  double sure = 4.5;
  /// As far as something static may be looked for that looks the same: [0, this), at most 128.
  int alias_disparities = 64;
  /// A step of disparity up to which two measurements may show one surface: a constant part and a
  /// share of the disparity, to which comes what a mover's speed makes of it.
  double same_surface = 0.5, same_surface_share = 0.04, same_surface_speeds = 4;
  /// So close to the right image's edge the earlier frame may not have known a mover's disparity.
  int blind_px = 6;
  /// Where something nearer by this step lies within reach, the flow is its flow.
  double edge_step = 0.7, edge_share = 0.08;
  int edge_window_px = 13;  ///< side of that reach, odd
  /// Limits of what one frame may say, per gap: what looks static over a short gap may be slow,
  /// what looks moved over a long one may have been uncovered.
  std::array<double, 3> least = {-0.7, -1.5, -1.0};
  std::array<double, 3> most = {2.5, 2.5, 1.0};
  /// What a longer gap saw moving has not stopped if it still goes at this share of its mean speed.
  double least_speed_share = 0.5;
  double mover_noise = 2;      ///< times by which its flow errs more than a static pixel's
  double motion_found = 0.5;   ///< evidence of one gap from which on the others count less ...
  double others_weight = 0.3;  ///< ... when they say static: they were shorter, or saw another
};

/// The floor as a plane of disparity.
struct FloorOptions {
  int hypotheses = 80;
  double disparity = 0.3, disparity_share = 0.02;  ///< distance of an inlier from the plane
  double most_roll = 0.25;     ///< tangent of the floor's slope across the image
  double below_weight = 2;     ///< a point below a floor speaks so many times against it
  double least_support = 0.1;  ///< share of the points of the lower half
  std::uint64_t seed = 5;
};

/// The labelling of pixels.
struct FieldOptions {
  double memory = 0.75;  ///< share of the log-odds that survives from frame to frame
  double limit = 6;      ///< of the log-odds, either way
  /// Log-odds that every pixel leans to static: what nobody has seen move does not; where the
  /// disparity is unknown; on the floor.
  double bias = -0.15, unknown_bias = -0.5, floor_bias = -0.5;
  double coupling = 1;  ///< log-odds by which equal neighbours on one surface agree
  double disparity = 0.4, disparity_share = 0.04;  ///< step between neighbours that halves it
  double contrast = 14;                            ///< grey levels; step that halves it further
  double floor_link = 0.1;  ///< share of the coupling between the floor and what stands on it
  int sweeps = 4;
  double moving = 0.5;  ///< log-odds from which on a pixel moves
  /// Growth into what says nothing, along strong links, and how far: plain cloth has seams.
  double grow_from = 1, grow_to = -3, grow_link = 0.4;
  double grow_m = 0.15;  ///< metres
};

/// From labels to regions.
struct RegionOptions {
  double link = 0.25;  ///< weaker links part regions, as a share of the coupling
  int least_px = 60;   ///< smaller regions are noise
  /// Mean memory of a region's pixels: what has grown around little evidence does not move.
  double least_log_odds = 0.5;
  double core_log_odds = 3;                    ///< memory from which on a pixel is sure to move
  int birth_core_px = 200, keep_core_px = 30;  ///< such pixels of a region
  int birth_inner_px = 20, keep_inner_px = 4;  ///< pixels with the region all around, in ...
  int inner_window_px = 5;                     ///< ... a window of this side, odd
  /// Share of the smaller one of a region and its predecessor that they must have in common.
  double least_overlap = 0.25;
  /// A region is part of a larger one if this share of its box lies in the other's and their mean
  /// disparities differ by no more than a step: a constant part and a share.
  double join_overlap = 0.3, join_disparity = 0.5, join_disparity_share = 0.04;
};

struct RobustOptions {
  SemiGlobalOptions disparity;
  SurfaceOptions surface;
  DenseFlowOptions flow;  ///< between the image and what the static world would look like
  EgoMotionOptions ego;
  EvidenceOptions evidence;
  FloorOptions floor;
  FieldOptions field;
  RegionOptions region;
};

/// Each names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, SurfaceOptions& options);
void Describe(OptionFields& fields, EgoMotionOptions& options);
void Describe(OptionFields& fields, EvidenceOptions& options);
void Describe(OptionFields& fields, FloorOptions& options);
void Describe(OptionFields& fields, FieldOptions& options);
void Describe(OptionFields& fields, RegionOptions& options);
void Describe(OptionFields& fields, RobustOptions& options);

}  // namespace aisle::slam::dynamic
