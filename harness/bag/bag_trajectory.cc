#include "harness/bag/bag_trajectory.h"

#include "harness/contract/rigid.h"
#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"
#include "harness/ros/geometry.h"

namespace aisle {
namespace {

// A trajectory of a bag reaches as far as one of a file.
static_assert(ros::kMostCoordinate_m == kFarthest_m);

struct Poses {
  std::map<std::int64_t, Eigen::Isometry3d> by_stamp;
  std::size_t taken = 0;  ///< those of equal stamps too

  void Add(const ros::Time& stamp, const Eigen::Isometry3d& pose) {
    by_stamp[ros::NanosecondsOf(stamp)] = pose;
    ++taken;
  }
};
/// Adds what a message says.
using Taker = void (*)(const std::string& bytes, const std::string& child, Poses* poses);

template <class T>
void TakePose(const std::string& bytes, const std::string& /*child*/, Poses* poses) {
  const T message = ros::Deserialize<T>(bytes);
  if constexpr (requires { message.transform; }) {
    poses->Add(message.header.stamp, ros::IsometryOf(message.transform));
  } else if constexpr (requires { message.pose.pose; }) {
    poses->Add(message.header.stamp, ros::IsometryOf(message.pose.pose));
  } else {
    poses->Add(message.header.stamp, ros::IsometryOf(message.pose));
  }
}

void TakePath(const std::string& bytes, const std::string& /*child*/, Poses* poses) {
  *poses = {};
  for (const ros::PoseStamped& pose : ros::Deserialize<ros::Path>(bytes).poses) {
    poses->Add(pose.header.stamp, ros::IsometryOf(pose.pose));
  }
}

void TakeTransforms(const std::string& bytes, const std::string& child, Poses* poses) {
  for (const ros::TransformStamped& one : ros::Deserialize<ros::TFMessage>(bytes).transforms) {
    if (one.child_frame_id != child) continue;
    poses->Add(one.header.stamp, ros::IsometryOf(one.transform));
  }
}

struct Kind {
  std::string type;
  Taker take;
};
const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {
      {"geometry_msgs/msg/PoseStamped", TakePose<ros::PoseStamped>},
      {"geometry_msgs/msg/PoseWithCovarianceStamped", TakePose<ros::PoseWithCovarianceStamped>},
      {"nav_msgs/msg/Odometry", TakePose<ros::Odometry>},
      {"geometry_msgs/msg/TransformStamped", TakePose<ros::TransformStamped>},
      {"nav_msgs/msg/Path", TakePath},
      {"tf2_msgs/msg/TFMessage", TakeTransforms}};
  return kinds;
}

const Kind* KindOf(const BagChannel& channel) {
  const auto found = std::ranges::find(Kinds(), channel.type, &Kind::type);
  return found == Kinds().end() ? nullptr : &*found;
}

std::set<std::string> TopicsWithPoses(const Bag& bag) {
  std::set<std::string> topics;
  for (const BagChannel& channel : bag.channels()) {
    const bool counts = KindOf(channel) != nullptr && channel.messages > 0;
    if (counts && channel.type != "tf2_msgs/msg/TFMessage") topics.insert(channel.topic);
  }
  return topics;
}

std::string ChooseTopic(const Bag& bag, const BagTopic& asked) {
  const std::set<std::string> topics = TopicsWithPoses(bag);
  if (asked.topic.empty()) {
    if (topics.size() == 1) return *topics.begin();
    throw InputError(
        asked.file.string(), 0,
        topics.empty()
            ? "no topic with poses"
            : fmt::format(
                  "several topics with poses: name one of {} after a colon, for example {}:{}",
                  fmt::join(topics, ", "), asked.file.string(), *topics.begin()));
  }
  const auto is_asked = [&](const BagChannel& channel) {
    return channel.topic == asked.topic && KindOf(channel) != nullptr;
  };
  if (std::ranges::none_of(bag.channels(), is_asked)) {
    throw InputError(
        asked.file.string(), 0,
        fmt::format("no poses on {}{}; topics with poses: {}", Printable(asked.topic),
                    DidYouMean(asked.topic, {topics.begin(), topics.end()}),
                    topics.empty() ? "none" : fmt::format("{}", fmt::join(topics, ", "))));
  }
  return asked.topic;
}

}  // namespace

std::optional<BagTopic> BagTopicFromText(const std::string& text) {
  const std::size_t colon = text.find(":/");
  BagTopic topic{.file = text.substr(0, colon), .topic = {}, .child = {}};
  if (!IsBagFile(topic.file) && !std::filesystem::exists(topic.file / "metadata.yaml")) {
    return std::nullopt;
  }
  if (colon != std::string::npos) {
    const std::size_t hash = text.find('#', colon);
    topic.topic = text.substr(colon + 1, hash == std::string::npos ? hash : hash - colon - 1);
    if (hash != std::string::npos) topic.child = text.substr(hash + 1);
  }
  return topic;
}

Trajectory ReadBagTrajectory(const Bag& bag, const BagTopic& asked) {
  const std::string topic = ChooseTopic(bag, asked);
  Poses poses;
  for (const BagEntry& entry : bag.entries()) {
    const BagChannel& channel = bag.channels()[entry.channel];
    if (channel.topic != topic) continue;
    const Kind* kind = KindOf(channel);
    if (kind == nullptr) continue;
    if (kind->take == TakeTransforms && asked.child.empty()) {
      throw InputError(asked.file.string(), 0,
                       fmt::format("{} has transforms of several bodies: name the child frame, for "
                                   "example {}:{}#base_link",
                                   topic, asked.file.string(), topic));
    }
    try {
      kind->take(bag.Read(entry), asked.child, &poses);
    } catch (const ros::CdrError& error) {
      throw InputError(asked.file.string(), 0,
                       fmt::format("a message of {} {}", topic, error.what()));
    }
  }
  if (poses.by_stamp.empty()) {
    throw InputError(asked.file.string(), 0,
                     asked.child.empty()
                         ? fmt::format("{} has no messages", topic)
                         : fmt::format("{} has no transforms of '{}'", topic, asked.child));
  }
  if (poses.taken > 1 && poses.by_stamp.size() == 1 && poses.by_stamp.contains(0)) {
    throw InputError(
        asked.file.string(), 0,
        fmt::format(
            "the {} poses of {} have no timestamps in their headers, so their times are unknown",
            poses.taken, topic));
  }
  Trajectory trajectory;
  for (const auto& [stamp_ns, pose] : poses.by_stamp) trajectory.push_back({stamp_ns, pose});
  return trajectory;
}

Trajectory ReadBagTrajectory(const BagTopic& topic) {
  return ReadBagTrajectory(*OpenBag(topic.file), topic);
}

}  // namespace aisle
