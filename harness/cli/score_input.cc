#include "harness/cli/score_input.h"

#include "harness/bag/bag_trajectory.h"
#include "harness/cli/bag_notes.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory_text.h"
#include "harness/score/step_difference.h"

namespace aisle {
namespace {

/// A file as named, and what is known of its format. Its text is read once: it may be a pipe.
struct PoseFile {
  std::string name;
  TextFile text;                           ///< of a file that is not a bag
  std::optional<BagTopic> topic;           ///< of a bag
  std::optional<TrajectoryFormat> format;  ///< of the text; absent: it does not tell
};

PoseFile Recognise(const std::string& name, const std::string& format) {
  PoseFile file{.name = name, .text = {}, .topic = BagTopicFromText(name), .format = std::nullopt};
  if (file.topic) return file;
  file.text = ReadTextFile(name);
  file.format = format.empty() ? TellTrajectoryFormat(file.text) : TrajectoryFormatFromName(format);
  return file;
}

[[noreturn]] void AskForOrder(const PoseFile& file, const char* option, const std::string& why) {
  throw InputError(
      file.name, 0,
      fmt::format("8 columns, the first in nanoseconds: qw may be the first or the last number of "
                  "the quaternion{}; choose with {} euroc (first) or {} tum (last)",
                  why, option, option));
}

/// Of a file whose format is known.
PosesRead Read(const PoseFile& file, const std::optional<TextFile>& times) {
  if (!file.topic) {
    return {.poses = ReadTrajectory(file.text, *file.format, times),
            .format = Describe(*file.format),
            .note = {}};
  }
  const std::unique_ptr<Bag> bag = OpenBag(file.topic->file);
  TellNotes(file.name, bag->notes());
  return {.poses = ReadBagTrajectory(*bag, *file.topic), .format = "a bag's topic", .note = {}};
}

/// In the order of columns in which it moves as the truth does.
PosesRead ReadLikeTruth(const PoseFile& file, const Trajectory& truth) {
  const auto read_as = [&](TrajectoryFormat format) -> PosesRead {
    return {.poses = ReadTrajectory(file.text, format), .format = Describe(format), .note = {}};
  };
  const PosesRead first = read_as(TrajectoryFormat::kEuroc);
  const PosesRead last = read_as(TrajectoryFormat::kTum);
  const Reading reading = ReadingLikeTruth(truth, first.poses, last.poses);
  if (reading == Reading::kEither) {
    AskForOrder(file, "--format-estimate", ", and both fit the truth");
  }
  PosesRead read = reading == Reading::kFirst ? first : last;
  read.note = fmt::format(
      "the estimate was read as {}, the order of columns in which its motion fits the truth; "
      "--format-estimate overrides this",
      read.format);
  return read;
}

/// What stamps the KITTI files; empty where nothing has to.
std::string TimesFor(const PoseFiles& files, const std::vector<PoseFile>& all) {
  std::vector<std::string> kitti;
  std::string stamped;
  for (const PoseFile& file : all) {
    if (file.format == TrajectoryFormat::kKitti) {
      kitti.push_back(file.name);
    } else {
      stamped = file.name;
    }
  }
  if (!files.times.empty() && kitti.empty()) {
    throw InputError("--times is for KITTI's files; these have their own timestamps");
  }
  const bool needed = !kitti.empty() && files.by_stamp && !stamped.empty();
  if (!files.times.empty() || !needed) return files.times;
  for (const std::string& file : kitti) {
    const std::filesystem::path beside = KittiTimesBeside(file);
    if (beside.empty()) continue;
    fmt::print(stderr, "aisle: timestamps of {} are taken from {}\n", file, beside.string());
    return beside.string();
  }
  throw InputError(kitti.front(), 0,
                   fmt::format("KITTI's files have no timestamps, but {} has: pass the sequence's "
                               "times.txt with --times",
                               stamped));
}

}  // namespace

AllPosesRead ReadPoseFiles(const PoseFiles& files) {
  std::vector<PoseFile> all = {Recognise(files.truth, files.format_truth)};
  if (!all.front().topic && !all.front().format) AskForOrder(all.front(), "--format-truth", "");
  for (const std::string& file : files.estimates) {
    all.push_back(Recognise(file, files.format_estimate));
  }
  const std::string times_file = TimesFor(files, all);
  std::optional<TextFile> times;
  if (!times_file.empty()) times = ReadTextFile(times_file);
  AllPosesRead read{.truth = Read(all.front(), times), .estimates = {}};
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool is_told = all[i].topic || all[i].format;
    read.estimates.push_back(is_told ? Read(all[i], times)
                                     : ReadLikeTruth(all[i], read.truth.poses));
  }
  return read;
}

}  // namespace aisle
