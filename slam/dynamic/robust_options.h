#pragma once

#include <array>
#include <cstdint>

#include "slam/dynamic/paper_options.h"

// Every constant of the robust method on one page. Those that could depend on a scene are in units
// of noise that is measured while running; reports/dynamic_methods.md says how the rest was found.

namespace aisle::slam::dynamic {

/// Distances in frames over which motion is looked for: displacement grows with the gap, noise far
/// less, so the long ones find slow movers and the short one is quick.
inline constexpr std::array<int, 3> kGaps = {1, 5, 15};
inline constexpr int kLongestGap = 15;

/// Points that are followed as long as they can be seen.
struct PointTrackOptions {
  SpreadOptions spread{.points = 600};
  FlowOptions flow{.window_px = 15, .pyramid_levels = 4, .iterations = 12};
  /// Ratio of the gradients' second moments below which a window shows an edge, along which it is
  /// not held: such a point is not believed to move.
  double cornerness = 0.1;
  double spacing_px = 22;  ///< one point per square of this side, the oldest
  /// Noise that grows with brightness, as a share of it: photons, and each pixel's own gain.
  double brightness_noise = 0.02;
  double disparity_gate_px = 3;  ///< refined disparity may differ this much from the dense one

  OptionError Validate() const {
    return FirstOf(spread.Validate(), flow.Validate(),
                   CheckRange("spacing_px", spacing_px, 1.0, 1000.0),
                   CheckRange("disparity_gate_px", disparity_gate_px, 0.1, 100.0));
  }
};

/// Motion of the rig between two frames.
struct EgoMotionOptions {
  int hypotheses = 60;       ///< three-point samples beside the prediction and standing still
  double gate_chi2 = 11.34;  ///< 99 % of chi-square with three degrees of freedom
  /// What a vehicle can do: deviation of its acceleration. A motion that would need many times this
  /// is not the vehicle's, however many points vote for it.
  double acceleration_mps2 = 4;
  double angular_acceleration_radps2 = 6;
  int rounds = 3;      ///< of re-weighting
  int iterations = 4;  ///< Gauss-Newton steps a round
  std::uint64_t seed = 3;

  OptionError Validate() const {
    return FirstOf(
        CheckRange("hypotheses", hypotheses, 0, 100000),
        CheckRange("gate_chi2", gate_chi2, 1.0, 100.0),
        CheckRange("acceleration_mps2", acceleration_mps2, 1e-3, 1e3),
        CheckRange("angular_acceleration_radps2", angular_acceleration_radps2, 1e-3, 1e3));
  }
};

/// Limits of the evidence that one frame may add, in log-odds, per gap: what looks static over a
/// short gap may be slow, what looks moved over a long one may have been uncovered.
struct EvidenceOptions {
  std::array<double, 3> point_static = {-1.0, -2.0, -2.5};
  std::array<double, 3> point_dynamic = {2.5, 2.5, 2.5};
  std::array<double, 3> dense_static = {-0.8, -1.2, -1.5};
  std::array<double, 3> dense_dynamic = {2.0, 2.0, 1.5};
  /// Of the way over a gap, the share that the next shorter gap must have seen: a track that has
  /// slipped onto another edge has gone all of it at once.
  double least_late_share = 0.03, most_late_share = 0.85;
  double intensity_noise = 2.5;  ///< grey levels; start of the measured deviation of one pixel
  /// Errors of calibration, scale and rolling texture grow with the way a point has gone: deviation
  /// per pixel of displacement, added to the measured noise.
  double noise_per_displacement = 0.01;
  double warp_noise_px = 0.3;  ///< half-size pixels; what pose and disparity move a pixel
  double free_space = 1.0;     ///< log-odds of a surface where an earlier frame looked through
  double dense_weight = 0.5;   ///< pixels of a node are not independent

  OptionError Validate() const {
    return FirstOf(CheckRange("intensity_noise", intensity_noise, 0.1, 100.0),
                   CheckRange("warp_noise_px", warp_noise_px, 0.01, 10.0));
  }
};

/// The labelling of nodes, 4x4 pixels each.
struct FieldOptions {
  double coupling = 0.9;          ///< log-odds by which equal neighbours on one surface agree
  double disparity_px = 1.5;      ///< step between neighbouring nodes that halves the coupling
  double disparity_share = 0.06;  ///< the same, as a share of the disparity
  double contrast = 25;           ///< grey levels; step that halves the coupling further
  double memory = 0.75;           ///< share of the log-odds that survives from frame to frame
  double limit = 6;               ///< of the log-odds, either way
  /// Log-odds that every node leans to static, each frame: what nobody has seen move does not.
  double bias = -0.25;
  double point_reach_px = 14;  ///< distance from a point at which its evidence has faded to a third
  int sweeps = 6;

  OptionError Validate() const {
    return FirstOf(CheckRange("coupling", coupling, 0.0, 100.0),
                   CheckRange("memory", memory, 0.0, 1.0), CheckRange("limit", limit, 1.0, 100.0),
                   CheckRange("sweeps", sweeps, 1, 1000));
  }
};

/// From labels to regions.
struct RegionOptions {
  double birth_share = 3;       ///< moving points for each static one, at birth ...
  double keep_share = 2;        ///< ... and later
  double birth_together = 0.4;  ///< share of its moving points that go one way, within 60 %
  double birth_log_odds = 3.0;  ///< a region is born where its best node reaches this
  double keep_log_odds = 0.5;   ///< and reaches as far as nodes above this
  int birth_points = 5;         ///< and where so many of its points move
  int keep_points = 4;          ///< and dies with fewer of them
  double vote_log_odds = 0.7;   ///< of a point, from which on it counts as moving or as static
  int min_nodes = 25;           ///< smaller regions are noise; 25 nodes are 20x20 pixels
  int dilate_nodes = 0;         ///< grown by this, for outlines that the stereo matcher shrinks

  OptionError Validate() const {
    return FirstOf(CheckRange("birth_log_odds", birth_log_odds, keep_log_odds, 1e3),
                   CheckRange("min_nodes", min_nodes, 1, 100000),
                   CheckRange("dilate_nodes", dilate_nodes, 0, 50));
  }
};

struct RobustOptions {
  /// On images of half size; 48 half-size pixels are 96.
  DisparityOptions disparity{.max_disparity_px = 48,
                             .block_px = 5,
                             .uniqueness_percent = 15,
                             .speckle_px = 40,
                             .left_right_px = 1};
  PointTrackOptions points;
  EgoMotionOptions ego;
  EvidenceOptions evidence;
  FieldOptions field;
  RegionOptions region;

  OptionError Validate() const {
    return FirstOf(disparity.Validate(), points.Validate(), ego.Validate(), evidence.Validate(),
                   field.Validate(), region.Validate());
  }
};

}  // namespace aisle::slam::dynamic
