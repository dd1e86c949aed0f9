#include "harness/bag/bag_recording.h"

#include "harness/bag/bag_calibration.h"
#include "harness/bag/bag_trajectory.h"
#include "harness/bag/grey_image.h"
#include "harness/io/input_error.h"
#include "harness/ros/cdr.h"

namespace aisle {
namespace {

constexpr std::int64_t kTogetherNs = 1'000'000;  ///< images of one instant, at most

using Images = std::map<std::int64_t, BagEntry>;  ///< by header stamp; the later recorded stays

struct EntryPair {
  std::int64_t stamp_ns;  ///< the left image's
  BagEntry left, right;
};

Images ImagesOf(const Bag& bag, const std::string& topic) {
  Images images;
  for (const BagEntry& entry : bag.entries()) {
    const BagChannel& channel = bag.channels()[entry.channel];
    if (channel.topic == topic && IsImageType(channel.type)) images[entry.header_ns] = entry;
  }
  return images;
}

/// The image nearest to a stamp.
Images::const_iterator Nearest(const Images& images, std::int64_t stamp_ns) {
  auto after = images.lower_bound(stamp_ns);
  if (after == images.begin()) return after;
  const auto before = std::prev(after);
  if (after == images.end() || stamp_ns - before->first <= after->first - stamp_ns) return before;
  return after;
}

/// Each with the one that is nearest to it and to which it is nearest.
std::vector<EntryPair> Pair(const Images& left, const Images& right) {
  std::vector<EntryPair> pairs;
  for (const auto& [stamp_ns, entry] : left) {
    const auto partner = Nearest(right, stamp_ns);
    if (std::abs(partner->first - stamp_ns) > kTogetherNs) continue;
    if (Nearest(left, partner->first)->first != stamp_ns) continue;
    pairs.push_back({stamp_ns, entry, partner->second});
  }
  return pairs;
}

/// Half of the images alone is no accident.
void CheckPairs(const Images& left, const Images& right, const std::vector<EntryPair>& pairs,
                const std::string& file) {
  if (2 * pairs.size() >= std::min(left.size(), right.size()) && !pairs.empty()) return;
  if (left.size() == 1 && left.begin()->first == 0) {
    throw InputError(file, 0, "its images have no stamps in their headers: they cannot be paired");
  }
  std::vector<std::int64_t> off_ns;
  for (const auto& [stamp_ns, entry] : left) {
    off_ns.push_back(std::abs(Nearest(right, stamp_ns)->first - stamp_ns));
  }
  std::ranges::nth_element(off_ns, off_ns.begin() + std::ssize(off_ns) / 2);
  throw InputError(
      file, 0,
      fmt::format("only {} of {} left images have a right one within 1 ms by their header stamps "
                  "(median distance {:.3f} ms): the cameras are not triggered together, or one is "
                  "stamped late; correct the stamps of the drive's recording",
                  pairs.size(), left.size(),
                  static_cast<double>(off_ns[off_ns.size() / 2]) * 1e-6));
}

/// Serves the images of a bag; shared by the copies of a recording.
class ImageReader {
 public:
  ImageReader(std::shared_ptr<const Bag> bag, std::vector<EntryPair> pairs, std::string file)
      : bag_(std::move(bag)), pairs_(std::move(pairs)), file_(std::move(file)) {}

  cv::Mat1b operator()(std::size_t pair, int side) const {
    const BagEntry& entry = side == 0 ? pairs_.at(pair).left : pairs_.at(pair).right;
    const BagChannel& channel = bag_->channels()[entry.channel];
    try {
      const std::string bytes = bag_->Read(entry);
      return channel.type == "sensor_msgs/msg/Image"
                 ? GreyImage(ros::Deserialize<ros::Image>(bytes))
                 : GreyImage(ros::Deserialize<ros::CompressedImage>(bytes));
    } catch (const ros::CdrError& error) {
      throw InputError(file_, 0, fmt::format("an image of {} {}", channel.topic, error.what()));
    }
  }

 private:
  std::shared_ptr<const Bag> bag_;
  std::vector<EntryPair> pairs_;
  std::string file_;
};

/// Ours says where it was, of the left camera.
Trajectory OwnTruth(const Bag& bag, const std::string& file) {
  const auto is_truth = [](const BagChannel& channel) {
    return channel.topic == "/truth/pose" && channel.messages > 0;
  };
  if (std::ranges::none_of(bag.channels(), is_truth)) return {};
  return ReadBagTrajectory(bag, {.file = file, .topic = "/truth/pose", .child = {}});
}

}  // namespace

StereoRecording ReadBagRecording(const std::filesystem::path& path,
                                 const BagRecordingOptions& options) {
  const std::string file = path.string();
  const std::shared_ptr<const Bag> bag = OpenBag(path);
  const StereoTopics topics = FindStereoTopics(*bag, options.topics, file);
  StereoRecording recording;
  recording.cameras =
      options.cameras ? *options.cameras : CamerasOfBag(*bag, topics, options.baseline_m, file);
  const Images left = ImagesOf(*bag, topics.left), right = ImagesOf(*bag, topics.right);
  std::vector<EntryPair> pairs = Pair(left, right);
  CheckPairs(left, right, pairs, file);
  for (const EntryPair& pair : pairs) {
    recording.pairs.push_back({pair.stamp_ns, file + ":" + topics.left, file + ":" + topics.right});
  }
  recording.truth = OwnTruth(*bag, file);
  recording.notes = bag->notes();
  recording.read_image = ImageReader(bag, std::move(pairs), file);
  return recording;
}

}  // namespace aisle
