#include "harness/cli/score_input.h"

#include "harness/bag/bag_trajectory.h"
#include "harness/cli/bag_notes.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory.h"

namespace aisle {
namespace {

/// Of a bag's topic it is none of a file.
std::optional<TrajectoryFormat> FormatOf(const std::string& file, const std::string& format) {
  if (BagTopicFromText(file)) return std::nullopt;
  return format.empty() ? GuessTrajectoryFormat(file) : TrajectoryFormatFromName(format);
}

Trajectory Read(const std::string& file, const std::string& format, const std::string& times) {
  if (const std::optional<BagTopic> topic = BagTopicFromText(file)) {
    const std::unique_ptr<Bag> bag = OpenBag(topic->file);
    TellNotes(file, bag->notes());
    return ReadBagTrajectory(*bag, *topic);
  }
  return ReadTrajectory(file, *FormatOf(file, format), times);
}

/// What stamps the KITTI files; empty where nothing has to.
std::string TimesFor(const PoseFiles& files) {
  std::vector<std::string> all = {files.truth};
  all.insert(all.end(), files.estimates.begin(), files.estimates.end());
  std::vector<std::string> kitti;
  std::string stamped;
  for (const std::string& file : all) {
    if (FormatOf(file, files.format) == TrajectoryFormat::kKitti) {
      kitti.push_back(file);
    } else {
      stamped = file;
    }
  }
  if (!files.times.empty() && kitti.empty()) {
    throw InputError("--times: these files have stamps of their own; it is for KITTI's");
  }
  const bool needed = !kitti.empty() && files.by_stamp && !stamped.empty();
  if (!files.times.empty() || !needed) return files.times;
  for (const std::string& file : kitti) {
    const std::filesystem::path beside = KittiTimesBeside(file);
    if (beside.empty()) continue;
    fmt::print(stderr, "aisle: {} is stamped by {}\n", file, beside.string());
    return beside.string();
  }
  throw InputError(kitti.front(), 0,
                   fmt::format("KITTI's files have no stamps, and {} has: give the time of every "
                               "frame with --times (its sequence's times.txt)",
                               stamped));
}

}  // namespace

PosesRead ReadPoseFiles(const PoseFiles& files) {
  const std::string times = TimesFor(files);
  PosesRead read{.truth = Read(files.truth, files.format, times), .estimates = {}};
  for (const std::string& file : files.estimates) {
    read.estimates.push_back(Read(file, files.format, times));
  }
  return read;
}

}  // namespace aisle
