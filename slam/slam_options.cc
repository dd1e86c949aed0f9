#include "slam/slam_options.h"

#include <fmt/format.h>

namespace aisle::slam {
namespace {

std::string Validate(const ScheduleOptions& schedule) {
  for (const auto& [name, value] :
       {std::pair{"mapping_frames", schedule.mapping_frames},
        {"loop_frames", schedule.loop_frames},
        {"keyframes_per_loop_frame", schedule.keyframes_per_loop_frame},
        {"global_frames", schedule.global_frames},
        {"keyframes_per_global_frame", schedule.keyframes_per_global_frame}}) {
    if (value < 1) return fmt::format("{} = {}; at least 1", name, value);
  }
  if (schedule.free_running && !schedule.background) {
    return "free_running = true, background = false; free running is about threads";
  }
  return {};
}

}  // namespace

std::string Validate(const SlamOptions& options) {
  if (options.threads < 0) return fmt::format("threads = {}; 0 or more", options.threads);
  if (!(options.keypoint_noise_px > 0)) {
    return fmt::format("keypoint_noise_px = {}; it must be positive", options.keypoint_noise_px);
  }
  if (options.localise_only && options.map_file.empty()) {
    return "localise_only = true, map_file is empty; there is nothing to localise in";
  }
  if (!(options.new_part_after_s >= 0)) {
    return fmt::format("new_part_after_s = {}; not negative", options.new_part_after_s);
  }
  for (const std::string& error : {Validate(options.schedule), Validate(options.dynamic),
                                   Validate(options.feature), Validate(options.stereo)}) {
    if (!error.empty()) return error;
  }
  return {};
}

}  // namespace aisle::slam
