#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "simulator/camera/stereo_camera.h"

namespace aisle::sim {

/// The ray of every pixel of a camera: direction (x, y, 1) in the camera frame, row-major. Because
/// z is 1, the parameter t of a hit along the direction is its depth z in metres.
struct PixelRays {
  /// How (x, y) changes from one pixel to the next.
  struct Step {
    Eigen::Vector2f right, down;
  };

  int width = 0, height = 0;     ///< pixels
  float step_x = 0, step_y = 0;  ///< change of x per column, of y per row, at the optical axis
  bool straight = true;          ///< a pinhole's: x depends on the column alone, y on the row
  std::vector<float> x, y;       ///< width·height each, then kPadding zeros

  /// x and y of a pixel.
  Eigen::Vector2f At(int column, int row) const {
    const auto i = static_cast<std::size_t>(row * width + column);
    return {x[i], y[i]};
  }
  /// Step at a pixel; a pinhole's is the same everywhere.
  Step StepAt(int column, int row) const;

  static constexpr std::size_t kPadding = 8;  ///< so that a packet may start at any pixel
};

/// The rays through the pixel centres: x = (u - cx) / fx, y = (v - cy) / fy, unbent by the lens.
/// Throws std::invalid_argument naming the first pixel for which the lens has no ray.
PixelRays MakePixelRays(const StereoCamera& camera);

/// The rows [first, last) of a camera's rays.
PixelRays RowsOf(const PixelRays& rays, int first, int last);

/// The smallest window of pixels outside of which no ray lies in [low, high] (x and y of rays):
/// columns [x0, x1), rows [y0, y1).
struct PixelWindow {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
PixelWindow WindowOfRays(const PixelRays& rays, const Eigen::Vector2d& low,
                         const Eigen::Vector2d& high);

/// The same camera with pixels `factor` times as large, for a coarse look at the same view.
StereoCamera Coarser(const StereoCamera& camera, int factor);

/// Where one camera stands: T_world_camera of the pair whose rig (left camera) is at `T_world_rig`.
Eigen::Isometry3d CameraPose(const StereoCamera& camera, const Eigen::Isometry3d& T_world_rig,
                             StereoSide side);

}  // namespace aisle::sim
