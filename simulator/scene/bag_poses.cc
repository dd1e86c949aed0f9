#include "simulator/scene/bag_poses.h"

#include <stdexcept>

namespace aisle::sim {
std::pair<std::string, std::string> SplitBagTopic(const std::string& text) {
  for (const char* bag : {".mcap:", ".db3:"}) {
    const std::size_t at = text.find(bag);
    if (at == std::string::npos) continue;
    const std::size_t colon = at + std::string(bag).size() - 1;
    return {text.substr(0, colon), text.substr(colon + 1)};
  }
  return {text, ""};
}

std::string ReadBagPoses(const BagPoseReader& reader, const std::string& file_and_topic,
                         std::vector<TimedPose>* poses) {
  if (!reader) {
    return file_and_topic +
           ": this program cannot read bags (it gives the simulator no BagPoseReader);"
           " expected the poses as a TUM file";
  }
  try {
    *poses = reader(file_and_topic);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  for (std::size_t i = 0; i < poses->size(); ++i) {
    if (!(*poses)[i].T_world_body.matrix().allFinite()) {
      return file_and_topic + ": a pose is not finite";
    }
    if (i > 0 && (*poses)[i].time_ns <= (*poses)[i - 1].time_ns) {
      return file_and_topic + ": timestamps do not increase";
    }
  }
  return poses->empty() ? file_and_topic + ": no poses" : "";
}

}  // namespace aisle::sim
