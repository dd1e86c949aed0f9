#pragma once

#include <array>
#include <cstdint>

#include "slam/common/option_fields.h"
#include "slam/flow/dense_flow_options.h"
#include "slam/stereo/dense/semi_global_options.h"

// Every constant of the robust method on one page. Lengths are in pixels of the half-size images
// unless they say otherwise. What could depend on a scene is in units of noise that is measured
// while running, or in metres a second. What is no option is no matter of taste: bounds of
// chi-square, effort after which a solver changes nothing, limits of number types and of matchers.
// reports/sensitivity.md says what halving and doubling each of them does.

namespace aisle::slam::dynamic {

/// Distances in frames over which motion is looked for: displacement grows with the gap, noise far
/// less, so the long ones find slow movers and the short one is quick.
inline constexpr std::array<int, 3> kGaps = {1, 5, 15};
/// Gaps are known by slots: those of kGaps, and the keyframe's, whose gap is longer than them and
/// chosen in each frame.
inline constexpr std::size_t kKeyframeSlot = kGaps.size(), kSlots = kGaps.size() + 1;
/// Frames older than the longest of kGaps are kept up to this age, one in so many.
inline constexpr int kLongestGap = 60, kKeyframeEvery = 5;

/// What is known of a pixel before it is compared.
struct SurfaceOptions {
  double grey_noise = 2;           ///< grey levels, deviation of one pixel in the dark
  double brightness_noise = 0.02;  ///< what grows with brightness: photons, each pixel's own gain
  /// By which share of itself the mean of a few pixels may change: a lamp's glare wanders over a
  /// static surface as the rig passes it, and lamps are blotted out.
  double shading_noise = 0.1;
  int window_px = 7;  ///< side of the window in which texture is gathered, odd
};

/// How far two disparities of one surface may be apart, see DisparityTolerance.
struct ToleranceOptions {
  double sigmas = 2;    ///< deviations of the disparity, as it is learned while running
  double share = 0.04;  ///< of the disparity: surfaces stretch along the line of sight
  /// By which share a frame moves the noise that is learned, of disparity and of flow.
  double learning_rate = 0.1;
};

/// Motion of the rig between two frames.
struct EgoMotionOptions {
  int cell_px = 12;  ///< one point, that of the best texture, from each square of this side
  /// What a vehicle can do: deviation of its acceleration. A motion that would need many times this
  /// is not the vehicle's, however many points vote for it.
  double acceleration_mps2 = 1.5;
  double angular_acceleration_radps2 = 3;
  /// The same of a jolt, as a sill gives it: heave, and pitch and roll.
  double jolt_mps2 = 10, jolt_radps2 = 20;
  double trust_in_region = 0.02;  ///< in a point of a region that moves, whatever its own evidence
  std::uint64_t seed = 3;
};

/// From residual flow to the log-odds of moving.
struct EvidenceOptions {
  double mover_mps = 0.5;  ///< deviation of a mover's speed, along each axis of the image
  double mover_m = 0.5;    ///< and of its way over a longer gap: what goes farther is seen sooner
  /// Errors of calibration and rolling texture grow with the way a point has gone: deviation per
  /// pixel of displacement.
  double noise_per_displacement = 0.01;
  /// Pixels of a window that count as independent when the window's grey values are to say that it
  /// has moved, and what an ill fit of the moved window takes off.
  double independent_pixels = 10, difference_weight = 0.5;
  double hidden_difference = 1.5;  ///< limit of that difference where the static surface was hidden
  /// Where something nearer lies within a window of this side, odd, the flow is its flow.
  int edge_window_px = 13;
  /// Limits of what one frame may say over a gap: what looks static may be slow, what looks moved
  /// may have been uncovered.
  double least = -1, most = 2.5;
  /// What a longer gap saw moving has not stopped if it still goes at this share of its mean speed.
  double least_speed_share = 0.5;
  double mover_noise = 2;  ///< times by which its flow errs more than a static pixel's
  /// Weight of the gaps that say static where another has found motion: they were shorter, or saw
  /// another.
  double others_weight = 0.3;
};

/// The labelling of pixels.
struct FieldOptions {
  double memory = 0.75;  ///< share of the log-odds that survives from frame to frame
  double longer = 0.5;   ///< the same of what the longer gaps say that have not their turn
  double limit = 6;      ///< of the log-odds, either way
  /// Log-odds that every pixel leans to static: what nobody has seen move does not; and more where
  /// the disparity is unknown, and on the floor.
  double bias = -0.15, unlikely_bias = -0.5;
  double coupling = 1;   ///< log-odds by which equal neighbours on one surface agree
  double contrast = 14;  ///< grey levels between neighbours that halve it
  double moving = 0.5;   ///< from which on a gap, a pixel, the mean of a region says "moves"
  /// Growth from what says that it moves into what says nothing, along strong links, and how far:
  /// plain cloth has seams.
  double grow_to = -3, grow_link = 0.4;
  double grow_m = 0.15;  ///< metres
};

/// From labels to regions.
struct RegionOptions {
  double link = 0.25;  ///< weaker links part regions, as a share of the coupling
  /// Memory from which on a pixel is sure to move; nobody asks it for what looks the same.
  double core_log_odds = 3;
  int birth_core_px = 200, keep_core_px = 30;  ///< such pixels of a region
  /// What the smaller of two regions has in common with the other, as a share of it, if it is its
  /// predecessor (pixels), or a part of it at its distance (box).
  double overlap = 0.3;
};

struct RobustOptions {
  SemiGlobalOptions disparity;  ///< at half size, and at a quarter for what is nearer
  SurfaceOptions surface;
  ToleranceOptions tolerance;
  DenseFlowOptions flow;  ///< between the image and what the static world would look like
  EgoMotionOptions ego;
  EvidenceOptions evidence;
  FieldOptions field;
  RegionOptions region;
};

/// Each names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, SurfaceOptions& options);
void Describe(OptionFields& fields, ToleranceOptions& options);
void Describe(OptionFields& fields, EgoMotionOptions& options);
void Describe(OptionFields& fields, EvidenceOptions& options);
void Describe(OptionFields& fields, FieldOptions& options);
void Describe(OptionFields& fields, RegionOptions& options);
void Describe(OptionFields& fields, RobustOptions& options);

}  // namespace aisle::slam::dynamic
