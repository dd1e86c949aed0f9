#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/bag/bag.h"
#include "harness/contract/estimate.h"

namespace aisle {

/// A topic of a bag, as a command line names it: FILE.mcap:/odom, FILE.db3:/tf#base_link;
/// the folder of a bag stands for its file.
struct BagTopic {
  std::filesystem::path file;
  std::string topic;  ///< empty: the only one of its kind
  std::string child;  ///< of a TFMessage: whose transform; else empty
};
/// Nothing where the text names no bag: "gt.txt", "C:/x".
std::optional<BagTopic> BagTopicFromText(const std::string& text);

/// The poses of a topic of PoseStamped, PoseWithCovarianceStamped, Odometry, TransformStamped,
/// TFMessage (of one child) or Path (its last message), by header stamp; of equal stamps the later
/// recorded stays. The body is whoever the publisher meant. Throws InputError: no such topic,
/// several and none named, a message that is damaged, poses without stamps.
Trajectory ReadBagTrajectory(const Bag& bag, const BagTopic& topic);
Trajectory ReadBagTrajectory(const BagTopic& topic);

}  // namespace aisle
