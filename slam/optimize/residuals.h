#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Geometry>
#include <array>

#include "slam/camera/stereo_camera.h"

namespace aisle::slam {

/// A pose as Ceres sees it: unit quaternion x y z w, then translation, of T_rig_world.
using PoseBlock = std::array<double, 7>;

PoseBlock ToBlock(const Eigen::Isometry3d& T_rig_world);
Eigen::Isometry3d FromBlock(const double* block);

/// Moves a PoseBlock by a six-vector (translation, rotation) as Retract does.
///
/// Derivatives of the cost functions here are with respect to that six-vector, written to the first
/// six columns with a seventh of zeros; PlusJacobian is the identity over a zero row, so that their
/// product is the true derivative on the manifold.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// Metres before the camera; a nearer point has no projection to speak of. Far below
/// kNearestVisible_m: an adjustment may bring a point near on its way without ending there.
inline constexpr double kNearestProjectable_m = 1e-3;

/// Whitened error of a point seen by a pose: sqrt_information (measured - projected) over
/// (u, v, disparity). Parameters: PoseBlock, point (world).
class ReprojectionResidual final : public ceres::SizedCostFunction<3, 7, 3> {
 public:
  ReprojectionResidual(const StereoCamera& camera, const Eigen::Vector3d& uvd,
                       const Eigen::Matrix3d& sqrt_information)
      : camera_(camera), uvd_(uvd), sqrt_information_(sqrt_information) {}

  /// False for a point nearer than kNearestProjectable_m or behind: at the start that ends the
  /// solver, later it makes Ceres try a shorter step.
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  StereoCamera camera_;
  Eigen::Vector3d uvd_;
  Eigen::Matrix3d sqrt_information_;
};

/// How far two poses stand from a measured relative pose, over its deviations: translation, then
/// rotation (see Difference). Parameters: PoseBlock from, PoseBlock to.
class RelativePoseResidual final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  RelativePoseResidual(const Eigen::Isometry3d& T_from_to, double sigma_m, double sigma_rad)
      : T_from_to_(T_from_to), sigma_m_(sigma_m), sigma_rad_(sigma_rad) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::Isometry3d T_from_to_;
  double sigma_m_, sigma_rad_;
};

}  // namespace aisle::slam
