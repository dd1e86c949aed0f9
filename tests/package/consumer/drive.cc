// drive SCENE ASSETS: renders four frames of a scene and drives the SLAM through them.
#include <cstdio>

#include "simulator/simulator.h"
#include "slam/stereo_slam.h"

int main(int argc, char** argv) {
  if (argc != 3) return 4;
  using namespace aisle;
  const auto simulator = sim::Simulator::Load(argv[1], argv[2], {.light_spacing = 8});
  const sim::RigInfo& rig = simulator.rig();
  slam::StereoCamera camera;
  camera.width = rig.width, camera.height = rig.height;
  camera.fx = rig.fx, camera.fy = rig.fy, camera.cx = rig.cx, camera.cy = rig.cy;
  camera.baseline_m = rig.baseline_m;
  slam::StereoSlam slam(camera, {});
  int tracked = 0;
  for (int k = 0; k < 4; ++k) {
    const std::int64_t stamp_ns = simulator.Stamp(k);
    const sim::RenderedFrame frame = simulator.Render(k, stamp_ns, simulator.PlannedPose(stamp_ns));
    const slam::TrackedFrame at = slam.Track({k, stamp_ns, frame.left, frame.right});
    tracked += at.state == slam::TrackingState::kTracking ? 1 : 0;
  }
  std::printf("%d of 4 tracked\n", tracked);
  return tracked == 4 ? 0 : 1;
}
