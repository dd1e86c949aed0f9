#include "harness/bag/bag_wheels.h"

#include <map>
#include <set>

#include "harness/bag/odometry_covariance.h"
#include "harness/common/seconds.h"
#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"
#include "harness/io/trajectory.h"
#include "harness/ros/sensor.h"

namespace aisle {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr const char* kStatic = "/tf_static";

/// Hands a message on; what is wrong with it names its topic.
template <class T, class Take>
void TakeMessage(const Bag& bag, const BagEntry& entry, const std::string& file, const Take& take) {
  try {
    take(ros::Deserialize<T>(bag.Read(entry)));
  } catch (const ros::CdrError& error) {
    throw InputError(
        file, 0,
        fmt::format("a message of {} {}", bag.channels()[entry.channel].topic, error.what()));
  }
}

/// tf2 takes names with a slash before them as those without.
std::string FrameName(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

/// Frames that stand fixed to each other: each child's parent and pose in it.
class StaticFrames {
 public:
  StaticFrames(const Bag& bag, const std::string& file) : file_(file) {
    for (const BagEntry& entry : bag.entries()) {
      const BagChannel& channel = bag.channels()[entry.channel];
      if (channel.topic != kStatic || channel.type != "tf2_msgs/msg/TFMessage") continue;
      TakeMessage<ros::TFMessage>(bag, entry, file, [&](const ros::TFMessage& message) {
        for (const ros::TransformStamped& one : message.transforms) {
          parents_[FrameName(one.child_frame_id)] = {FrameName(one.header.frame_id),
                                                     ros::IsometryOf(one.transform)};
        }
      });
    }
  }

  /// T_a_b. Throws InputError where they are not joined.
  Eigen::Isometry3d Between(const std::string& a, const std::string& b) const {
    std::string root_a, root_b;
    const Eigen::Isometry3d T_root_a = InRoot(a, &root_a), T_root_b = InRoot(b, &root_b);
    if (root_a == root_b) return T_root_a.inverse() * T_root_b;
    throw InputError(
        file_, 0,
        fmt::format(
            "no transform of {} leads from the wheels' frame '{}' to the left image's "
            "'{}'{}: record {} as well, with the camera's mounting",
            kStatic, Printable(a), Printable(b),
            parents_.empty() ? ", as the bag has none" : fmt::format("; it connects {}", Names()),
            kStatic));
  }

 private:
  struct Parent {
    std::string frame;
    Eigen::Isometry3d T_parent_child;
  };

  Eigen::Isometry3d InRoot(const std::string& frame, std::string* root) const {
    Eigen::Isometry3d T_root_frame = Eigen::Isometry3d::Identity();
    *root = frame;
    // As many steps as there are frames: then they go round in a circle.
    for (std::size_t step = 0; step <= parents_.size(); ++step) {
      const auto parent = parents_.find(*root);
      if (parent == parents_.end()) return T_root_frame;
      T_root_frame = parent->second.T_parent_child * T_root_frame;
      *root = parent->second.frame;
    }
    throw InputError(
        file_, 0, fmt::format("the frames of {} form a cycle at '{}'", kStatic, Printable(frame)));
  }

  std::string Names() const {
    std::set<std::string> names;
    for (const auto& [child, parent] : parents_) {
      names.insert(Printable(child));
      names.insert(Printable(parent.frame));
    }
    return fmt::format("{}", fmt::join(names, ", "));
  }

  const std::string file_;
  std::map<std::string, Parent> parents_;  ///< by child
};

/// The frame of a topic's images; empty where they name none.
std::string FrameOfImages(const Bag& bag, const std::string& topic, const std::string& file) {
  for (const BagEntry& entry : bag.entries()) {
    const BagChannel& channel = bag.channels()[entry.channel];
    if (channel.topic != topic) continue;
    std::string frame;
    const auto take = [&](const auto& image) { frame = image.header.frame_id; };
    if (channel.type == "sensor_msgs/msg/Image") {
      TakeMessage<ros::Image>(bag, entry, file, take);
    } else {
      TakeMessage<ros::CompressedImage>(bag, entry, file, take);
    }
    return frame;
  }
  return {};
}

struct Reading {
  Eigen::Isometry3d T_odom_base;
  Matrix6d twist_covariance;  ///< base_link: m/s, then rad/s, squared
};

/// By header stamp; of equal ones the later recorded stays. `base` becomes their child frame.
std::map<std::int64_t, Reading> Readings(const Bag& bag, const std::string& topic,
                                         const std::string& file, std::string* base) {
  std::map<std::int64_t, Reading> readings;
  std::size_t taken = 0;
  for (const BagEntry& entry : bag.entries()) {
    const BagChannel& channel = bag.channels()[entry.channel];
    if (channel.topic != topic || channel.type != "nav_msgs/msg/Odometry") continue;
    TakeMessage<ros::Odometry>(bag, entry, file, [&](const ros::Odometry& message) {
      if (taken++ > 0 && message.child_frame_id != *base) {
        throw InputError(file, 0,
                         fmt::format("{} is about two bodies, '{}' and '{}'", topic,
                                     Printable(*base), Printable(message.child_frame_id)));
      }
      *base = message.child_frame_id;
      using RowMajor = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
      readings[ros::NanosecondsOf(message.header.stamp)] = {
          ros::IsometryOf(message.pose.pose),
          Eigen::Map<const RowMajor>(message.twist.covariance.data())};
    });
  }
  if (readings.empty()) throw InputError(file, 0, topic + " has no messages");
  if (taken > 1 && readings.size() == 1) {
    throw InputError(file, 0,
                     fmt::format("the {} messages of {} all have the same timestamp in their "
                                 "headers, so their times are unknown",
                                 taken, topic));
  }
  return readings;
}

/// Whether all say how well they know their twists. No motion leads to the first: an odometer that
/// has just begun may say anything of it.
bool AllSayCovariances(const std::map<std::int64_t, Reading>& readings, const std::string& topic,
                       const std::string& file) {
  bool all = true;
  for (auto at = std::next(readings.begin()); at != readings.end(); ++at) {
    const Matrix6d& covariance = at->second.twist_covariance;
    if (const std::string fault = CovarianceFault(covariance); !fault.empty()) {
      throw InputError(
          file, 0,
          fmt::format(
              "twist.covariance of the message of {} at {} s: {}; leave these wheels out, or "
              "rewrite the bag with zeros there, which stand for an unknown covariance",
              topic, FormatSeconds(at->first), fault));
    }
    all = all && SaysCovariance(covariance);
  }
  return all;
}

/// In order.
std::vector<std::string> OdometryTopics(const Bag& bag) {
  std::set<std::string> topics;
  for (const BagChannel& channel : bag.channels()) {
    if (channel.type == "nav_msgs/msg/Odometry" && channel.messages > 0) {
      topics.insert(channel.topic);
    }
  }
  return {topics.begin(), topics.end()};
}

}  // namespace

WheelTrack ReadBagWheels(const Bag& bag, const std::string& topic, const std::string& left_topic,
                         const std::string& file) {
  const std::vector<std::string> topics = OdometryTopics(bag);
  if (std::ranges::find(topics, topic) == topics.end()) {
    throw InputError(
        file, 0,
        fmt::format("no nav_msgs/Odometry on {}{}; topics of that type: {}", Printable(topic),
                    DidYouMean(topic, topics),
                    topics.empty() ? "none" : fmt::format("{}", fmt::join(topics, ", "))));
  }
  std::string base;
  const std::map<std::int64_t, Reading> readings = Readings(bag, topic, file, &base);
  WheelTrack track;
  track.T_base_left = StaticFrames(bag, file).Between(
      FrameName(base), FrameName(FrameOfImages(bag, left_topic, file)));
  const bool all_say = AllSayCovariances(readings, topic, file);
  for (const auto& [stamp_ns, reading] : readings) {
    const double seconds =
        track.poses.empty() ? 0 : ToSeconds(stamp_ns - track.poses.back().stamp_ns);
    track.poses.push_back({stamp_ns, reading.T_odom_base});
    if (all_say) track.covariances.push_back(reading.twist_covariance * seconds * seconds);
  }
  return track;
}

}  // namespace aisle
