#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/map/frame.h"

namespace aisle::slam {

/// Poses, points and observations of one from the other: everything that an adjustment needs,
/// detached from any map. Local and global adjustment differ in what they put in here.
struct BundleProblem {
  struct Pose {
    Eigen::Isometry3d T_rig_world = Eigen::Isometry3d::Identity();
    bool fixed = false;
  };
  struct Observation {
    int pose = 0, point = 0;                        ///< indices
    Eigen::Vector3d uvd = Eigen::Vector3d::Zero();  ///< pixels and disparity
    /// Square root of the information over (u, v, disparity): the residual is this times the
    /// error. A zero last row leaves the disparity out.
    Eigen::Matrix3d sqrt_information = Eigen::Matrix3d::Identity();
    double chi2_bound = 0;  ///< beyond: an outlier
  };

  StereoCamera camera;
  std::vector<Pose> poses;
  std::vector<Eigen::Vector3d> points;  ///< metres, world
  std::vector<Observation> observations;
};

/// An observation with the noise its measurement states.
BundleProblem::Observation MakeObservation(int pose, int point, const Measurement& measurement);

struct BundleOptions {
  int iterations = 10;  ///< at most
  bool robust = true;   ///< Huber's cost at each observation's chi2_bound, or plain squares
  double relative_tolerance = 1e-4;  ///< of the cost's decrease: good enough to stop
};

/// How an adjustment went.
struct BundleSummary {
  double initial_cost = 0, final_cost = 0;  ///< half the sum of (robustified) squares
  int iterations = 0;
  bool usable = false;  ///< numerically sound; if not, the problem is as it was
  std::string message;
};

/// Bundle adjustment (Triggs et al. 2000): minimises the reprojection error over free poses and all
/// points. Observations not `active` (by index; empty: all are) are left out. One thread, same
/// bits.
BundleSummary Solve(BundleProblem& problem, const std::vector<bool>& active,
                    const BundleOptions& options);

/// Squared whitened error of an observation as the problem stands; infinite behind the camera.
double Chi2(const BundleProblem& problem, const BundleProblem::Observation& observation);

/// Observations (by index) of points that lie before their camera: a point behind it, as two nearly
/// parallel rays may place one, has no projection to start from, and Solve would end before its
/// first step.
std::vector<bool> WithProjection(const BundleProblem& problem);

/// Observations within their bound.
std::vector<bool> WithinBounds(const BundleProblem& problem);

}  // namespace aisle::slam
