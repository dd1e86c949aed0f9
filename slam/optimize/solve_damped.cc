#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "slam/optimize/normal_equations.h"

namespace aisle::slam {
namespace {

/// What the diagonal is raised by. What nothing is known of must not run away: it has a least.
template <int N>
Eigen::Matrix<double, N, 1> Raise(const Eigen::Matrix<double, N, N>& H, double damping) {
  constexpr double kLeast = 1e-6;
  return damping * H.diagonal().cwiseMax(kLeast);
}

using PosePoint = NormalEquations::PosePoint;

}  // namespace

std::optional<SolvedStep> SolveDamped(const NormalEquations& equations, double damping) {
  const std::size_t poses = equations.pose_H.size();
  const auto at = [](std::size_t pose) { return static_cast<Eigen::Index>(6 * pose); };
  // Only the lower triangle is filled, in blocks.
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(at(poses), at(poses));
  Eigen::VectorXd rhs(at(poses));
  for (std::size_t p = 0; p < poses; ++p) {
    auto block = reduced.block<6, 6>(at(p), at(p));
    block = equations.pose_H[p];
    block.diagonal() += Raise<6>(equations.pose_H[p], damping);
    rhs.segment<6>(at(p)) = -equations.pose_g[p];
  }

  std::vector<Eigen::Matrix3d> inverses;
  inverses.reserve(equations.points.size());
  std::vector<PosePoint> scaled;  // of one point: its couplings times its inverse
  for (const NormalEquations::Point& point : equations.points) {
    Eigen::Matrix3d H = point.H;
    H.diagonal() += Raise<3>(point.H, damping);
    const Eigen::Matrix3d& inverse = inverses.emplace_back(H.inverse());
    scaled.clear();
    for (std::size_t i = point.begin; i < point.end; ++i) {
      const NormalEquations::Coupling& row = equations.couplings[i];
      const PosePoint& own = scaled.emplace_back(row.H * inverse);
      const Eigen::Index row_at = at(static_cast<std::size_t>(row.pose));
      rhs.segment<6>(row_at).noalias() += own * point.g;
      for (std::size_t j = point.begin; j <= i; ++j) {
        const NormalEquations::Coupling& column = equations.couplings[j];
        const Matrix6d share = own * column.H.transpose();
        auto block = reduced.block<6, 6>(row_at, at(static_cast<std::size_t>(column.pose)));
        block -= share;
        // A pose that sees the point twice.
        if (i != j && row.pose == column.pose) block -= share.transpose();
      }
    }
  }

  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>, Eigen::Lower> decomposition(reduced);
  if (poses > 0 && decomposition.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd by_poses = poses > 0 ? decomposition.solve(rhs).eval() : rhs;
  if (!by_poses.allFinite()) return std::nullopt;

  SolvedStep solved;
  double decrease = 0;  // twice: damping's own share of the step, and the way down the gradient
  for (std::size_t p = 0; p < poses; ++p) {
    const Vector6d& step = solved.step.poses.emplace_back(by_poses.segment<6>(at(p)));
    const Vector6d raise = Raise<6>(equations.pose_H[p], damping);
    decrease += step.dot(raise.cwiseProduct(step) - equations.pose_g[p]);
  }
  for (std::size_t i = 0; i < equations.points.size(); ++i) {
    const NormalEquations::Point& point = equations.points[i];
    Eigen::Vector3d wanted = -point.g;
    for (std::size_t k = point.begin; k < point.end; ++k) {
      const NormalEquations::Coupling& coupling = equations.couplings[k];
      wanted.noalias() -=
          coupling.H.transpose() * solved.step.poses[static_cast<std::size_t>(coupling.pose)];
    }
    const Eigen::Vector3d& step = solved.step.points.emplace_back(inverses[i] * wanted);
    decrease += step.dot(Raise<3>(point.H, damping).cwiseProduct(step) - point.g);
  }
  solved.predicted_decrease = decrease / 2;
  if (!std::isfinite(decrease)) return std::nullopt;
  return solved;
}

}  // namespace aisle::slam
