#include "harness/bag/bag_recording.h"

#include "harness/bag/bag_calibration.h"
#include "harness/bag/bag_trajectory.h"
#include "harness/bag/bag_wheels.h"
#include "harness/bag/grey_image.h"
#include "harness/io/input_error.h"
#include "harness/io/stereo_pairs.h"
#include "harness/ros/cdr.h"

namespace aisle {
namespace {

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

std::vector<EntryPair> Pair(const Images& left, const Images& right, const std::string& file) {
  std::vector<EntryPair> pairs;
  for (const StampPair& pair : PairStamps({StampsOf(left), StampsOf(right)}, file)) {
    pairs.push_back({pair.left_ns, left.at(pair.left_ns), right.at(pair.right_ns)});
  }
  return pairs;
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
  std::vector<EntryPair> pairs = Pair(left, right, file);
  for (const EntryPair& pair : pairs) {
    recording.pairs.push_back({pair.stamp_ns, file + ":" + topics.left, file + ":" + topics.right});
  }
  recording.truth = OwnTruth(*bag, file);
  if (!options.odometry.empty()) {
    recording.read_wheels = [=, topic = options.odometry, left_topic = topics.left] {
      return ReadBagWheels(*bag, topic, left_topic, file);
    };
  }
  recording.notes = bag->notes();
  for (const std::string& note : NotesOnPairs(pairs.size(), left.size())) {
    recording.notes.push_back(note);
  }
  recording.read_image = ImageReader(bag, std::move(pairs), file);
  return recording;
}

}  // namespace aisle
