#include "simulator/proof/picture_in_time.h"

#include "simulator/truth/correspondence.h"
#include "simulator/truth/moving_shadow.h"
#include "simulator/truth/truth.h"

namespace aisle::sim {

PictureWithFlow TakeWithFlow(const Studio& studio, const Moment& now, const Moment& next) {
  const World& world = studio.world;
  const Instant instant = studio.tracer.Pose(world.At(now.stamp_ns));
  const std::array view = {
      CameraView(studio.rays, CameraPose(studio.camera, now.T_world_rig, StereoSide::kLeft))};
  std::vector<HitImage> hits;
  TraceViews(instant, view, {}, &hits);
  const MovingNow moving(world, instant.snapshot(), studio.moving);
  const CameraTruth truth = LabelHits(world, instant, hits[0], moving);
  Correspondence found = FindCorrespondence(world, instant, studio.camera, view[0], hits[0],
                                            world.At(next.stamp_ns), next.T_world_rig);
  PictureWithFlow picture{.grey = {},
                          .depth = truth.depth,
                          .instance = truth.instance,
                          .mover = truth.actor,
                          .shadow = FindMovingShadows(world, instant, view[0], hits[0], moving),
                          .flow = found.flow,
                          .z_next = DepthInNextCamera(view[0], hits[0], found, next.T_world_rig)};
  studio.expose(studio.shader.Shade(instant, view, hits).front()).convertTo(picture.grey, CV_32F);
  return picture;
}

PictureChanges CompareInTime(const Studio& studio, const std::array<Moment, 3>& moments) {
  const PictureWithFlow first = TakeWithFlow(studio, moments[0], moments[1]);
  const PictureWithFlow second = TakeWithFlow(studio, moments[1], moments[2]);
  // Where the points of the third go next is not asked.
  return CompareInTime(first, second, TakeWithFlow(studio, moments[2], moments[2]));
}

}  // namespace aisle::sim
