#include "slam/mapping/mapping_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, MappingOptions& options) {
  fields.Group("create", &options.create);
  fields.Group("triangulate", &options.triangulate);
  fields.Group("cull", &options.cull);
  fields.Group("fuse", &options.fuse);
  fields.Group("adjust", &options.adjust);
}

void Describe(OptionFields& fields, ScheduleOptions& options) {
  constexpr OptionRange kFrames{1, 1e6};
  fields.Integer("mapping_frames", &options.mapping_frames, kFrames, "frames",
                 "Frames from a keyframe to the frame that first sees what mapping made of it.");
  fields.Integer(
      "loop_frames", &options.loop_frames, kFrames, "frames",
      "Frames from a confirmed loop to the frame that first sees it closed, in a small map.");
  fields.Integer("keyframes_per_loop_frame", &options.keyframes_per_loop_frame, kFrames,
                 "keyframes",
                 "Number of keyframes in the map for which closing a loop takes one frame more.");
  fields.Integer("global_frames", &options.global_frames, kFrames, "frames",
                 "Frames from a closed loop to the frame that first sees the whole map adjusted, "
                 "in a small map.");
  fields.Integer(
      "keyframes_per_global_frame", &options.keyframes_per_global_frame, kFrames, "keyframes",
      "Number of keyframes in the map for which the global adjustment takes one frame more.");
  fields.Require(!options.free_running || options.background, "free_running", options.free_running,
                 "be false where background is: free running is about threads");
}

}  // namespace aisle::slam
