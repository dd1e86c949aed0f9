#include "slam/dynamic/dynamic_stages.h"

#include "slam/common/seconds.h"
#include "slam/dynamic/robust/dense_frame.h"

namespace aisle::slam {

RobustTrace TraceOf(const dynamic::RobustState& before, const dynamic::RobustResult& result,
                    const StereoCamera& camera) {
  RobustTrace trace;
  trace.stages = result.stages;
  trace.probability = result.probability;
  if (trace.stages.gaps.empty()) return trace;
  const dynamic::GapTrace& shortest = trace.stages.gaps.front();
  trace.gap_s = SecondsBetween(before.stamp_ns, result.state.stamp_ns);
  trace.flow_noise = before.noise.flow.front();
  const cv::Mat2f expected =
      dynamic::WhereStatic(result.state.frames.back().filled,
                           shortest.motion.T_now_before.inverse(), dynamic::HalfCamera(camera))
          .place;
  cv::subtract(shortest.way.flow, expected, trace.residual);
  return trace;
}

}  // namespace aisle::slam
