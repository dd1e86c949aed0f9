#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "simulator/camera/stereo_camera.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// What OpenGL's rasteriser says of a view: a second opinion that shares no code with the ray
/// tracer, neither its camera and lens nor its intersections.
struct RasterView {
  cv::Mat1f depth;     ///< z in metres along the optical axis, infinity where nothing was drawn
  cv::Mat1w instance;  ///< index into World::instances(), 0 where nothing was drawn
};

struct RasterOptions {
  float near_m = 0.1f;  ///< what is nearer than this along the optical axis is not drawn
};

/// Draws the world at a snapshot with OSMesa (in memory, no display), however far it reaches.
/// Throws std::runtime_error when OSMesa does not start.
RasterView Rasterize(const World& world, const Snapshot& snapshot, const StereoCamera& camera,
                     const Eigen::Isometry3d& T_world_camera, const RasterOptions& options = {});

/// The same through a lens: OpenGL draws straight lines only, so a wider pinhole picture is drawn
/// and read where each pixel's ray meets it, which OpenCV's own models of lenses say: 1/z between
/// four pixels of one plane. NaN and no instance where they are not, and where OpenCV finds no ray
/// that comes back to the pixel; Compare leaves these out.
RasterView RasterizeThroughLens(const World& world, const Snapshot& snapshot,
                                const StereoCamera& camera, const Eigen::Isometry3d& T_world_camera,
                                const RasterOptions& options = {});

/// How far two views of one scene agree away from silhouettes.
struct Agreement {
  int compared = 0;  ///< pixels farther than a pixel from any silhouette or label edge
  int agreeing = 0;  ///< of them, same label and depth within the tolerance
  /// 0 where nothing could be compared: then nothing was proved.
  double share() const { return compared ? static_cast<double>(agreeing) / compared : 0.0; }
};

/// Compares depth (relative tolerance) and labels. A pixel counts where its 3 × 3 neighbourhood in
/// both views shows one instance and no jump in depth.
Agreement Compare(const RasterView& raster, const cv::Mat1f& depth, const cv::Mat1w& instance,
                  float depth_tolerance = 1e-3f);

}  // namespace aisle::sim
