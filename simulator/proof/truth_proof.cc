#include "simulator/proof/truth_proof.h"

#include "simulator/raster/raster.h"
#include "simulator/truth/correspondence.h"
#include "simulator/truth/truth.h"

namespace aisle::sim {
namespace {

/// Pixels that show anything.
int SurfacesIn(const cv::Mat1f& depth) {
  return cv::countNonZero(depth < std::numeric_limits<float>::infinity());
}

}  // namespace

VerifyReport ProveTruth(const Studio& studio, const Moment& now, const Moment& next) {
  const Instant instant = studio.At(now);
  const Instant instant_next = studio.At(next);
  const std::array<CameraView, 2> views = studio.Views(now);
  const std::array<CameraView, 2> views_next = studio.Views(next);
  std::vector<HitImage> hits, hits_next;
  TraceViews(instant, views, {}, &hits);
  TraceViews(instant_next, std::span(views_next).first(1), {}, &hits_next);
  const MovingNow moving(studio.world, instant.snapshot(), studio.moving);
  const MovingNow moving_then(studio.world, instant_next.snapshot(), studio.moving);
  const std::array<CameraTruth, 2> sides = {LabelHits(studio.world, instant, hits[0], moving),
                                            LabelHits(studio.world, instant, hits[1], moving)};
  const cv::Mat1f depth_next =
      LabelHits(studio.world, instant_next, hits_next[0], moving_then).depth;

  std::array<Agreement, 2> agreement;
  for (std::size_t side = 0; side < 2; ++side) {
    const Eigen::Isometry3d& T_world_camera = views[side].T_world_camera;
    const RasterView drawn =
        studio.rays.straight
            ? Rasterize(studio.world, instant.snapshot(), studio.camera, T_world_camera)
            : RasterizeThroughLens(studio.world, instant.snapshot(), studio.camera, T_world_camera);
    agreement[side] = Compare(drawn, sides[side].depth, sides[side].instance);
  }
  const Correspondence found =
      FindCorrespondence(studio.world, instant, studio.camera, views[0], hits[0],
                         instant_next.snapshot(), next.T_world_rig);
  const WarpCheck stereo =
      CheckStereo(studio.camera, studio.rays, sides[0].depth, sides[1].depth, found);
  const WarpCheck flow =
      CheckFlow(studio.camera, DepthInNextCamera(views[0], hits[0], found, next.T_world_rig),
                depth_next, found.flow);
  return VerifyReport{.raster_agreement_left = agreement[0].share(),
                      .raster_agreement_right = agreement[1].share(),
                      .raster_compared = agreement[0].compared + agreement[1].compared,
                      .raster_pixels = 2 * studio.camera.width * studio.camera.height,
                      .stereo_median_px = stereo.median_px,
                      .flow_median_px = flow.median_px,
                      .surface_pixels = SurfacesIn(sides[0].depth),
                      .stereo_compared = stereo.compared,
                      .flow_compared = flow.compared};
}

}  // namespace aisle::sim
