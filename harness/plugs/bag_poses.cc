#include "harness/plugs/bag_poses.h"

#include "harness/bag/bag_trajectory.h"
#include "harness/io/input_error.h"

namespace aisle {

std::vector<sim::TimedPose> ReadPosesOfBag(const std::string& file_and_topic) {
  const std::optional<BagTopic> topic = BagTopicFromText(file_and_topic);
  if (!topic) throw InputError(file_and_topic + ": expected FILE.mcap:/topic");
  std::vector<sim::TimedPose> poses;
  for (const StampedPose& pose : ReadBagTrajectory(*topic)) {
    poses.push_back({pose.stamp_ns, pose.T_world_rig});
  }
  return poses;
}

}  // namespace aisle
