#pragma once

#include <cstdint>

#include "slam/common/option_fields.h"

// Every constant of the paper's method ("Robust Stereo Visual SLAM for Dynamic Environments With
// Moving Object", sections III-A and III-B) on one page. The paper prints none of their values and
// says that they were set by experience. Those marked "searched" were found together, by trying
// sets of them on stretches of drives (reports/paper_constants.md): each is good beside the others.

namespace aisle::slam::dynamic {

/// Semi-global block matching.
struct DisparityOptions {
  int max_disparity_px = 96;   ///< multiple of 16; 96 px is 0.54 m with the default rig
  int block_px = 5;            ///< side of the matched block, odd
  int uniqueness_percent = 5;  ///< margin by which the best cost must win
  int speckle_px = 100;        ///< smaller islands of disparity are dropped
  int left_right_px = 2;       ///< allowed disagreement of left-to-right and right-to-left
  /// Match images of half the size: an eighth of the work. All of the above stay in pixels of the
  /// whole image but block_px, which covers twice as much of the scene then. The matcher compares
  /// left to right in whole pixels of its images: left_right_px then is 0 or even, 1 is taken as 2,
  /// other odd values as one less.
  bool half_size = true;
};

/// FAST corners from square regions, thinned by a quadtree.
struct SpreadOptions {
  int points = 305;             ///< N, the leaves of the quadtree; searched
  int cell_px = 23;             ///< side of the square regions; searched
  int fast_threshold = 20;      ///< grey levels
  int fast_threshold_low = 10;  ///< grey levels, where the first finds nothing; searched
  int border_px = 8;            ///< no point closer than this to the image's edge
};

/// Lucas-Kanade.
struct FlowOptions {
  int window_px = 21;      ///< side of the tracked window, odd
  int pyramid_levels = 4;  ///< 1 = full resolution only
  int iterations = 20;     ///< per level
  /// Largest distance between a point and itself tracked there and back; 0 switches the check off,
  /// as the paper does not mention one.
  double forward_backward_px = 1.0;
};

/// Fundamental matrix: nine-point algorithm inside RANSAC.
struct FundamentalOptions {
  double inlier_px = 0.201;   ///< epipolar distance (2) of a pair that supports one; searched
  int max_iterations = 300;   ///< hypotheses at most
  double confidence = 0.999;  ///< stop when a clean sample has been drawn with this probability
  std::uint64_t seed = 1;     ///< of the samples
  /// Median length of the flow up to which the camera is taken to stand still. Then every
  /// skew-symmetric matrix satisfies the static points and RANSAC picks the one that explains the
  /// movers too; the epipolar line is replaced by what it shrinks to, the point itself. The paper
  /// does not mention the case but reports that its scene 1, a standing camera, works. 0: never.
  double standing_flow_px = 0.2;
};

/// Threshold of the epipolar distance, equation (3): T_epi = alpha + beta * d.
struct EpipolarOptions {
  double alpha_px = 0.654;  ///< alpha_epi; searched
  double beta = 0.00522;    ///< beta_epi, pixels of distance per pixel of disparity; searched
};

/// Groups of dynamic points, equation (4): T_s = alpha + beta * d, and their regions of interest.
struct GroupOptions {
  double alpha_px = 49.4;     ///< alpha_s; searched
  double beta = 3.22;         ///< beta_s, pixels of distance per pixel of disparity; searched
  double disparity_px = 3.5;  ///< T_disp; searched
  int min_points = 5;         ///< "more than four dynamic features"
  /// A region of interest is the box of its points grown by this share of T_s: the outline to be
  /// found lies outside the outermost points. Searched.
  double roi_margin = 0.567;
};

/// SLIC, equations (5) to (7).
struct SuperpixelOptions {
  double step_px = 16.3;  ///< S_step = N_s, equation (6): K = image area / S_step^2; searched
  int iterations = 10;    ///< at most; fewer once nothing changes
  /// N_c as a share of the image's grey range (5th to 95th percentile): "determined from the
  /// image".
  double colour_share = 0.12;
};

/// Disparity plane of a superpixel, equation (8), by RANSAC.
struct PlaneOptions {
  int iterations = 30;     ///< three-point hypotheses per superpixel
  double inlier_px = 1.0;  ///< disparity residual up to which a pixel supports a plane
  int min_pixels = 12;     ///< superpixels with fewer known disparities have no plane
  std::uint64_t seed = 2;  ///< of the samples
};

/// Boundary energy, equations (9) to (11); all in squared pixels of disparity, all searched.
struct BoundaryOptions {
  double lambda_occlusion = 18.7;  ///< price of an occlusion
  double lambda_hinge = 10.7;      ///< price of a hinge, below the occlusion's
  double lambda_penalty = 17.6;    ///< added when the surface named as the front lies behind
};

/// The search from dynamic points to occlusion boundaries.
struct MarkOptions {
  /// A point counts only where this many of its four rays found an occlusion: "points not
  /// surrounded by boundaries labelled as occlusion" make no region. Searched: one is enough, as
  /// what faces the floor or fills the region of interest has no boundary on most of its sides.
  int min_rays = 1;
};

/// All of them.
struct PaperOptions {
  DisparityOptions disparity;
  SpreadOptions spread;
  FlowOptions flow;
  FundamentalOptions fundamental;
  EpipolarOptions epipolar;
  GroupOptions group;
  SuperpixelOptions superpixel;
  PlaneOptions plane;
  BoundaryOptions boundary;
  MarkOptions mark;
};

/// Each names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, DisparityOptions& options);
void Describe(OptionFields& fields, SpreadOptions& options);
void Describe(OptionFields& fields, FlowOptions& options);
void Describe(OptionFields& fields, FundamentalOptions& options);
void Describe(OptionFields& fields, EpipolarOptions& options);
void Describe(OptionFields& fields, GroupOptions& options);
void Describe(OptionFields& fields, SuperpixelOptions& options);
void Describe(OptionFields& fields, PlaneOptions& options);
void Describe(OptionFields& fields, BoundaryOptions& options);
void Describe(OptionFields& fields, MarkOptions& options);
void Describe(OptionFields& fields, PaperOptions& options);

}  // namespace aisle::slam::dynamic
