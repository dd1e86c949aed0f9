#include "harness/bag/stereo_topics.h"

#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"

namespace aisle {
namespace {

constexpr std::pair<const char*, const char*> kSides[] = {
    {"left", "right"},      {"cam0", "cam1"},   {"infra1", "infra2"},    {"camera0", "camera1"},
    {"image_0", "image_1"}, {"cam_0", "cam_1"}, {"camera_0", "camera_1"}};
constexpr std::string_view kCompressed = "/compressed";

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Topics with pictures, by name; their types.
std::map<std::string, std::string> ImageTopics(const Bag& bag) {
  std::map<std::string, std::string> topics;
  for (const BagChannel& channel : bag.channels()) {
    if (IsImageType(channel.type) && channel.messages > 0) topics[channel.topic] = channel.type;
  }
  return topics;
}

std::vector<StereoTopics> PairsIn(const std::map<std::string, std::string>& topics) {
  std::vector<StereoTopics> pairs;
  for (const auto& [topic, type] : topics) {
    for (const auto& [left, right] : kSides) {
      const std::string partner = Replaced(topic, left, right);
      const auto found = topics.find(partner);
      if (partner == topic || found == topics.end() || found->second != type) continue;
      pairs.push_back({topic, partner});
      break;
    }
  }
  std::erase_if(pairs, [&](const StereoTopics& pair) {
    if (!pair.left.ends_with(kCompressed)) return false;
    return topics.contains(pair.left.substr(0, pair.left.size() - kCompressed.size()));
  });
  return pairs;
}

}  // namespace

bool IsImageType(const std::string& type) {
  return type == "sensor_msgs/msg/Image" || type == "sensor_msgs/msg/CompressedImage";
}

StereoTopics FindStereoTopics(const Bag& bag, const std::vector<std::string>& asked,
                              const std::string& file) {
  const std::map<std::string, std::string> topics = ImageTopics(bag);
  std::vector<std::string> names;
  for (const auto& [topic, type] : topics) names.push_back(topic);
  const std::string known =
      names.empty() ? "it has no images" : fmt::format("its images: {}", fmt::join(names, ", "));
  for (const std::string& topic : asked) {
    if (topics.contains(topic)) continue;
    throw InputError(
        file, 0,
        fmt::format("no images on {}{}; {}", Printable(topic), DidYouMean(topic, names), known));
  }
  if (asked.size() > 2) throw InputError("--topic: expected at most two topics");
  if (asked.size() == 2) return {asked[0], asked[1]};
  std::vector<StereoTopics> pairs = PairsIn(topics);
  if (!asked.empty()) {
    std::erase_if(pairs, [&](const StereoTopics& pair) { return pair.left != asked[0]; });
  }
  if (pairs.size() == 1) return pairs.front();
  if (pairs.empty()) {
    throw InputError(file, 0,
                     fmt::format("no two image topics are named like a left and a right one; {}: "
                                 "use --topic LEFT --topic RIGHT",
                                 known));
  }
  std::string choice;
  for (const StereoTopics& pair : pairs) {
    choice += fmt::format("\n  --topic {} --topic {}", pair.left, pair.right);
  }
  throw InputError(file, 0,
                   fmt::format("has {} stereo pairs; choose one:{}", pairs.size(), choice));
}

std::string CameraInfoTopicOf(const std::string& image_topic) {
  std::string image = image_topic;
  if (image.ends_with(kCompressed)) image.resize(image.size() - kCompressed.size());
  return image.substr(0, image.rfind('/') + 1) + "camera_info";
}

}  // namespace aisle
