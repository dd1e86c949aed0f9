#include "harness/plugs/stage_bits.h"

#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/plugs/bag_poses.h"
#include "harness/plugs/systems.h"
#include "simulator/proof/proofs.h"

namespace aisle {
namespace {

template <typename T>
std::uint64_t HashOf(const std::vector<T>& values, std::uint64_t seed) {
  return Hash({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)}, seed);
}

std::uint64_t HashOf(const Trajectory& track) {
  std::uint64_t hash = 0;
  for (const StampedPose& pose : track) {
    const Eigen::Matrix4d matrix = pose.T_world_rig.matrix();
    hash = Hash({reinterpret_cast<const char*>(matrix.data()), sizeof(double) * 16}, hash);
  }
  return hash;
}

sim::Simulator Load(const StageBitsOptions& options) {
  try {
    return sim::Simulator::Load(options.scene_file, options.assets_dir,
                                {.threads = options.threads,
                                 .light_spacing = options.light_spacing,
                                 .keep_light = false,
                                 .bags = ReadPosesOfBag});
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

std::unique_ptr<Estimator> MakeSlam(const sim::RigInfo& rig, int threads) {
  return MakeSystem(BuiltIn("plain"),
                    {.width = rig.width,
                     .height = rig.height,
                     .fx = rig.fx,
                     .fy = rig.fy,
                     .cx = rig.cx,
                     .cy = rig.cy,
                     .baseline_m = rig.baseline_m},
                    {.threads = threads});
}

}  // namespace

std::vector<StageBits> HashStages(const StageBitsOptions& options) {
  const sim::Simulator simulator = Load(options);
  const std::unique_ptr<Estimator> slam =
      options.drive ? MakeSlam(simulator.rig(), options.threads) : nullptr;
  std::vector<StageBits> bits;
  for (const char* stage : sim::kStages) bits.push_back({stage, 0});
  std::uint64_t features = 0;
  for (int k = 0; k < std::min(options.drive ? options.frames : options.hashed_frames,
                               simulator.frame_count());
       ++k) {
    const std::int64_t stamp_ns = simulator.Stamp(k);
    if (k < options.hashed_frames) {
      const sim::StageHashes hashes = sim::HashStages(simulator, k);
      for (std::size_t i = 0; i < bits.size(); ++i) {
        bits[i].hash = HashOf(std::vector{hashes[i]}, bits[i].hash);
      }
    }
    if (!slam) continue;
    const sim::RenderedFrame frame = simulator.Render(k, stamp_ns, simulator.PlannedPose(stamp_ns));
    const FrameEstimate seen = slam->Process({k, stamp_ns, frame.left, frame.right}, {});
    features = HashOf(seen.keypoints, features);
  }
  if (slam) {
    bits.push_back({"features", features});
    bits.push_back({"trajectory", HashOf(slam->Finish())});
  }
  return bits;
}

}  // namespace aisle
