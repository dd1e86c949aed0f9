#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "slam/camera/se3.h"
#include "slam/optimize/bundle.h"

namespace aisle::slam {

/// The sum of squares of a BundleProblem around its poses and points, to second order, in the
/// blocks that Triggs et al. (2000, section 6) tell apart: what poses and points have each by
/// themselves, and what each observation says of both. Poses move as Retract does.
struct NormalEquations {
  using PosePoint = Eigen::Matrix<double, 6, 3>;

  /// An observation of a point by a free pose.
  struct Coupling {
    int pose = 0;  ///< index among the free ones
    PosePoint H = PosePoint::Zero();
  };
  struct Point {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();  ///< gradient
    std::size_t begin = 0, end = 0;               ///< of its couplings
  };

  std::vector<Matrix6d> pose_H;  ///< of each free pose
  std::vector<Vector6d> pose_g;
  std::vector<Point> points;        ///< of each point that is seen
  std::vector<Coupling> couplings;  ///< by point, then by pose
};

/// The active observations of a problem in the order in which they are summed: by point, then by
/// pose. Which poses are free and which points are seen at all follows from them.
struct BundleOrder {
  struct Seen {
    std::size_t point = 0, begin = 0, end = 0;  ///< index in the problem; of `observations`
  };
  std::vector<std::size_t> observations;
  std::vector<Seen> points;
  std::vector<std::size_t> free_poses;  ///< indices in the problem
  std::vector<int> free_index;          ///< of each pose of the problem; -1: fixed or unused
};
BundleOrder OrderOf(const BundleProblem& problem, const std::vector<bool>& active);

/// Half the sum of (robust) squares; nothing where a point is not before its camera.
std::optional<double> CostOf(const BundleProblem& problem, const BundleOrder& order, bool robust);

/// Linearises around the problem as it stands; every observation has a cost (see CostOf).
NormalEquations Linearize(const BundleProblem& problem, const BundleOrder& order, bool robust);

/// What moves the problem from where it stands.
struct BundleStep {
  std::vector<Vector6d> poses;          ///< of each free pose
  std::vector<Eigen::Vector3d> points;  ///< of each seen point
};

/// Half the squares that a step of the damped equations takes away, if they were truly quadratic.
struct SolvedStep {
  BundleStep step;
  double predicted_decrease = 0;
};

/// Solves the equations, their diagonal raised by `damping` times itself, by eliminating the points
/// first (the Schur complement) and a dense Cholesky decomposition of what is left of the poses.
/// Nothing where they cannot be solved.
std::optional<SolvedStep> SolveDamped(const NormalEquations& equations, double damping);

}  // namespace aisle::slam
