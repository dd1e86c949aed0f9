#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/disparity_tolerance.h"
#include "slam/dynamic/robust/motion_ended.h"
#include "slam/dynamic/robust/robust_options.h"
#include "slam/dynamic/robust/squared_difference.h"

namespace aisle::slam::dynamic {

/// Log-odds of "has moved" against "is static" for a displacement r that the rig's motion leaves
/// unexplained. Measured with information G (1 / squared pixels); static points err by
/// `static_variance` besides, movers by `mover_variance` more; all errors normal. Zero where G is.
float DisplacementLogOdds(const Eigen::Matrix2f& G, const Eigen::Vector2f& r, float static_variance,
                          float mover_variance);

/// A frame beside an earlier one.
struct Comparison {
  const DenseFrame& now;
  const DenseFrame& then;
  const cv::Mat2f& flow;  ///< from FollowBack
  DisparityTolerance tolerance;
  Eigen::Isometry3d T_then_now;
  double seconds;     ///< between the two
  double flow_noise;  ///< half-size pixels, deviation of the flow where the texture is strong
  int disparities;    ///< that the matcher searched, and something static may have
  double sure;        ///< log-odds of `memory`: from there on nothing alike and static is searched
  cv::Mat1i regions = {};  ///< of the current pixels: > 0 where something known to move has come
  cv::Mat1f memory = {};   ///< log-odds of what earlier frames said of them; may be empty
  /// Whether to ask of what only the left camera sees, too: over a long gap much of it was hidden
  /// by what nobody knows the distance of.
  bool monocular = false;
};

/// What is asked of the current frame whatever it is compared with.
struct Surroundings {
  DifferenceNoise noise;  ///< of its pixels
  cv::Mat1f nearest;      ///< largest disparity within EvidenceOptions::edge_window_px
};
Surroundings LookAround(const DenseFrame& frame, const SurfaceOptions& surface,
                        const EvidenceOptions& options);

struct MotionEvidence {
  /// Of moving, per pixel of half size, without limits; 0 where nothing is known.
  cv::Mat1f log_odds;
  LatestStep step;                   ///< what it says that of
  std::optional<double> flow_noise;  ///< what this comparison measured, where it could
};

/// What this comparison says of each pixel. Nothing is known without disparity (but see
/// ExplainMonocular), of what is seen from outside the earlier image, was hidden then by something
/// else, or lies beside something nearer whose flow has spilled over. Motion needs more than a
/// flow: the earlier image must agree better where the flow leads than where the static world would
/// have it, and must show a surface of like distance there, if any distance is known.
MotionEvidence CompareMotion(const Comparison& comparison, const Texture& texture,
                             const Surroundings& around, const StereoCamera& half,
                             const EvidenceOptions& options);

/// One evidence from that of several gaps, the shortest first, each within its limits: their sum
/// where none has found motion, which is evidence beyond `moving`; else the strongest, and little
/// of what speaks against it. All but the shortest may be empty: they say nothing.
cv::Mat1f CombineGaps(const std::vector<cv::Mat1f>& gaps, double moving,
                      const EvidenceOptions& options);

}  // namespace aisle::slam::dynamic
