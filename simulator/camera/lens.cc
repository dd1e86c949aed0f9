#include "simulator/camera/lens.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

namespace aisle::sim {
namespace {

constexpr int kMaxSteps = 50;
constexpr double kConverged = 1e-12;
constexpr double kWidestAngle = 85 * std::numbers::pi / 180;

/// Image of a ray and how it changes with the ray.
struct Bent {
  Eigen::Vector2d image;
  Eigen::Matrix2d jacobian;
};

Bent BendRadialTangential(const std::array<double, 4>& k, const Eigen::Vector2d& ray) {
  const auto& [k1, k2, p1, p2] = k;
  const double x = ray.x(), y = ray.y(), r2 = ray.squaredNorm();
  const double radial = 1 + r2 * (k1 + r2 * k2);
  const double slope = 2 * (k1 + 2 * r2 * k2);  // of `radial`, per x or y
  Bent bent;
  bent.image = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  const double cross = x * y * slope + 2 * p1 * x + 2 * p2 * y;
  bent.jacobian << radial + x * x * slope + 2 * p1 * y + 6 * p2 * x, cross, cross,
      radial + y * y * slope + 6 * p1 * y + 2 * p2 * x;
  return bent;
}

/// Radius in the image of a ray at an angle to the axis, and its slope.
std::array<double, 2> EquidistantRadius(const std::array<double, 4>& k, double angle) {
  const double a2 = angle * angle;
  return {angle * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3])))),
          1 + a2 * (3 * k[0] + a2 * (5 * k[1] + a2 * (7 * k[2] + a2 * 9 * k[3])))};
}

/// Beyond this radius r (1 + k1 r^2 + k2 r^4) falls: the first zero of 1 + 3 k1 r^2 + 5 k2 r^4.
double FoldOfRadial(double k1, double k2) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double half = 1.5 * k1, root2 = half * half - 5 * k2;
  if (root2 < 0) return kNever;
  // Of the two zeros 1 / (-half +- root) in r^2 the smaller positive one.
  const double inverse = -half + std::sqrt(root2);
  return inverse > 0 ? std::sqrt(1 / inverse) : kNever;
}

/// The angle beyond which the radius falls, at most the widest that is unbent.
double FoldOfAngle(const std::array<double, 4>& k) {
  constexpr double kStep = 1e-3;
  double angle = 0;
  while (angle < kWidestAngle && EquidistantRadius(k, angle)[1] > 0) angle += kStep;
  return std::min(angle, kWidestAngle);
}

Eigen::Vector2d BendEquidistant(const std::array<double, 4>& k, const Eigen::Vector2d& ray) {
  const double r = ray.norm();
  if (r < 1e-12) return ray;
  return ray * (EquidistantRadius(k, std::atan(r))[0] / r);
}

std::optional<Eigen::Vector2d> UnbendRadialTangential(const std::array<double, 4>& k,
                                                      const Eigen::Vector2d& image) {
  Eigen::Vector2d ray = image;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Bent bent = BendRadialTangential(k, ray);
    // Beyond the fold the image comes back: the determinant has changed its sign there.
    if (!(bent.jacobian.determinant() > 0)) return std::nullopt;
    const Eigen::Vector2d miss = image - bent.image;
    if (miss.norm() < kConverged) return ray;
    ray += bent.jacobian.inverse() * miss;
  }
  return std::nullopt;
}

/// Up to the fold the radius rises, so that the angle is kept between what is too small and what is
/// too large: near the fold Newton's steps go far beyond it.
std::optional<Eigen::Vector2d> UnbendEquidistant(const std::array<double, 4>& k, double fold,
                                                 const Eigen::Vector2d& image) {
  const double radius = image.norm();
  if (radius < 1e-12) return image;
  if (radius > EquidistantRadius(k, fold)[0]) return std::nullopt;
  double low = 0, high = fold, angle = std::min(radius, fold);
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto [at, slope] = EquidistantRadius(k, angle);
    if (std::abs(radius - at) < kConverged) return image * (std::tan(angle) / radius);
    (at < radius ? low : high) = angle;
    const double next = angle + (radius - at) / slope;
    angle = next > low && next < high ? next : (low + high) / 2;
  }
  return std::nullopt;
}

}  // namespace

double WidestRay(const Lens& lens) {
  switch (lens.model) {
    case LensModel::kRadialTangential:
      return FoldOfRadial(lens.coefficients[0], lens.coefficients[1]);
    case LensModel::kEquidistant:
      return std::tan(FoldOfAngle(lens.coefficients));
    case LensModel::kPinhole:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

std::optional<Eigen::Vector2d> Distort(const Lens& lens, double widest,
                                       const Eigen::Vector2d& ray) {
  if (ray.norm() > widest) return std::nullopt;
  switch (lens.model) {
    case LensModel::kRadialTangential: {
      const Bent bent = BendRadialTangential(lens.coefficients, ray);
      if (!(bent.jacobian.determinant() > 0)) return std::nullopt;
      return bent.image;
    }
    case LensModel::kEquidistant:
      return BendEquidistant(lens.coefficients, ray);
    case LensModel::kPinhole:
      break;
  }
  return ray;
}

std::optional<Eigen::Vector2d> Undistort(const Lens& lens, double widest,
                                         const Eigen::Vector2d& image) {
  switch (lens.model) {
    case LensModel::kRadialTangential:
      return UnbendRadialTangential(lens.coefficients, image);
    case LensModel::kEquidistant:
      return UnbendEquidistant(lens.coefficients, std::atan(widest), image);
    case LensModel::kPinhole:
      break;
  }
  return image;
}

}  // namespace aisle::sim
