#include "harness/bag/odometry_covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace aisle {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kMostVariance = 1e15;  // a deviation of 3e7 m/s
constexpr double kTolerance = 1e-6;     // messages are often computed in single precision

bool IsUnknown(const Matrix6d& matrix) { return matrix(0, 0) == -1 || matrix.isZero(0); }

/// Each entry over the deviations of its two directions; 0 where one of them has none.
Matrix6d Correlations(const Matrix6d& matrix) {
  const auto reciprocal = [](double variance) {
    return variance > 0 ? 1 / std::sqrt(variance) : 0;
  };
  const Eigen::Matrix<double, 6, 1> scale = matrix.diagonal().unaryExpr(reciprocal);
  return scale.asDiagonal() * matrix * scale.asDiagonal();
}

}  // namespace

bool SaysCovariance(const Matrix6d& matrix) {
  return !IsUnknown(matrix) && matrix.llt().info() == Eigen::Success;
}

std::string CovarianceFault(const Matrix6d& matrix) {
  if (IsUnknown(matrix)) return "";
  for (int i = 0; i < 36; ++i) {
    const int row = i / 6, column = i % 6;
    const double value = matrix(row, column);
    if (!std::isfinite(value)) return fmt::format("[{}] is {}, not a finite number", i, value);
    if (row == column && !(value >= 0 && value <= kMostVariance)) {
      return fmt::format("[{}] is {:g}, but a variance is from 0 to {:g}", i, value, kMostVariance);
    }
  }
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < row; ++column) {
      const double one = matrix(row, column), other = matrix(column, row);
      const double most = std::sqrt(matrix(row, row)) * std::sqrt(matrix(column, column));
      if (std::abs(one - other) > kTolerance * most) {
        return fmt::format("[{}] is {:g} and [{}] is {:g}, but it must be symmetric",
                           6 * row + column, one, 6 * column + row, other);
      }
      if (std::abs(one) > (1 + kTolerance) * most) {
        return fmt::format("[{}] is {:g}, more than the variances of its two directions allow",
                           6 * row + column, one);
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(Correlations(matrix),
                                                       Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() < -kTolerance
             ? "its correlations contradict each other: it is not positive semidefinite"
             : "";
}

}  // namespace aisle
