#include "harness/plugs/simulated_frame.h"

namespace aisle {
namespace {

ObjectTruth Convert(const sim::ObjectTruth& object, const std::string& object_class) {
  ObjectTruth result;
  result.instance = object.instance;
  result.object_class = object_class;
  result.box_visible = object.box_visible;
  result.box_full = object.box_full;
  result.center_m = object.center_m;
  result.extent_m = object.extent_m;
  result.T_world_object = object.T_world_object;
  result.velocity_mps = object.velocity_mps;
  result.visible_fraction = object.visible_fraction;
  result.visible_pixels = object.visible_pixels;
  result.dynamic_pixels = object.dynamic_pixels;
  return result;
}

FrameTruth Convert(const sim::FrameTruth& truth, const std::vector<sim::InstanceInfo>& instances) {
  FrameTruth result;
  result.T_world_rig = truth.T_world_rig;
  result.depth = truth.depth;
  result.instance = truth.instance;
  result.depth_right = truth.depth_right;
  result.instance_right = truth.instance_right;
  result.dynamic = truth.dynamic;
  result.dynamic_right = truth.dynamic_right;
  result.actor = truth.actor;
  result.actor_right = truth.actor_right;
  for (const sim::ObjectTruth& object : truth.objects) {
    result.objects.push_back(Convert(object, instances.at(object.instance).object_class));
  }
  return result;
}

}  // namespace

StereoCalibration CalibrationOf(const sim::RigInfo& rig) {
  return {.width = rig.width,
          .height = rig.height,
          .fx = rig.fx,
          .fy = rig.fy,
          .cx = rig.cx,
          .cy = rig.cy,
          .baseline_m = rig.baseline_m};
}

SequenceFrame FrameOf(std::int64_t id, sim::RenderedFrame frame,
                      const std::vector<sim::InstanceInfo>& instances) {
  FrameTruth truth = Convert(frame.truth, instances);
  truth.smear_ms = frame.smear_ms;
  return {.images = {id, frame.stamp_ns, frame.left, frame.right}, .truth = std::move(truth)};
}

}  // namespace aisle
