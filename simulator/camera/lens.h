#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace aisle::sim {

enum class LensModel {
  kPinhole,           ///< no distortion
  kRadialTangential,  ///< Brown's polynomial, coefficients k1 k2 p1 p2 as in OpenCV
  kEquidistant,       ///< Kannala & Brandt's, coefficients k1 k2 k3 k4 as in cv::fisheye
};

/// How a lens bends the ideal image. Works on the plane z = 1 of the camera, without focal length
/// or centre: a pixel is f · Distort(x/z, y/z) + c.
struct Lens {
  LensModel model = LensModel::kPinhole;
  std::array<double, 4> coefficients = {0, 0, 0, 0};
};

/// The tangent of the angle off the axis up to which the lens is one to one along a line from the
/// middle: beyond, its polynomial comes back. Infinite where it never does; at most 85 degrees'
/// where the image is by angle.
double WidestRay(const Lens& lens);

/// Where the ray (x, y, 1) meets the bent image; none where that is folded, which is beyond
/// `widest` (WidestRay of the lens, which is asked once) or where tangential terms turn it over.
std::optional<Eigen::Vector2d> Distort(const Lens& lens, double widest, const Eigen::Vector2d& ray);

/// The ray (x, y, 1) that meets the bent image at a place: Newton's method to 1e-12. None where the
/// lens has no such ray: beyond the fold of the polynomial, or 85 degrees and more off the axis.
/// `widest`: WidestRay of the lens, which is asked once.
std::optional<Eigen::Vector2d> Undistort(const Lens& lens, double widest,
                                         const Eigen::Vector2d& image);

}  // namespace aisle::sim
