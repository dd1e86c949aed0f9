#include "harness/campaign/source.h"

#include <filesystem>

#include "harness/bag/bag_trajectory.h"
#include "harness/io/dataset.h"
#include "harness/io/file.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/plugs/recorded_sequence.h"
#include "harness/plugs/simulated_drive.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/suite/recording.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

Trajectory ReadTruth(const std::string& text) {
  if (const std::optional<BagTopic> topic = BagTopicFromText(text)) {
    return ReadBagTrajectory(*topic);
  }
  return ReadTrajectory(text, GuessTrajectoryFormat(text));
}

StereoRecording ReadSource(const RecordingSource& source) {
  const bool is_bag = IsBagFile(source.path) || fs::exists(fs::path(source.path) / "metadata.yaml");
  if (!is_bag && (!source.topics.empty() || source.baseline_m || !source.odometry.empty())) {
    throw InputError(
        source.file, 0,
        "topics, baseline_m and odometry are for bags, but " + source.path + " is not a bag");
  }
  StereoRecording recording =
      is_bag ? ReadBagRecording(source.path, {.topics = source.topics,
                                              .baseline_m = source.baseline_m,
                                              .odometry = source.odometry})
             : ReadRecording(source.path, DatasetFormatFromName(source.format));
  if (!source.truth.empty()) {
    recording.truth = ReadTruth(source.truth);
    // It is the left camera's, as it stands: no pose of a body comes between.
    const Eigen::Isometry3d T_left_body = recording.cameras.left.T_body_camera.inverse();
    recording.cameras.left.T_body_camera = Eigen::Isometry3d::Identity();
    recording.cameras.right.T_body_camera = T_left_body * recording.cameras.right.T_body_camera;
  }
  return recording;
}

std::uint64_t HashOutside(const fs::path& path, std::uint64_t seed) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  const auto changed = fs::last_write_time(path, error).time_since_epoch().count();
  return Hash(fmt::format("{} {} {}", path.string(), error ? 0 : size, error ? 0 : changed), seed);
}

}  // namespace

std::unique_ptr<Sequence> OpenRecordingSource(const std::string& file) {
  const RecordingSource source = ReadRecordingSource(file);
  return MakeRecordedSequence(ReadSource(source), source.path, SceneName(file));
}

std::vector<std::string> CheckSource(const std::string& file) {
  try {
    if (!IsRecording(file)) return CheckScene(file);
    const std::unique_ptr<Sequence> sequence = OpenRecordingSource(file);
    // Else a night would find out, in the middle.
    if (!ReadRecordingSource(file).odometry.empty()) sequence->ReadWheels();
  } catch (const InputError& error) {
    return {error.what()};
  }
  return {};
}

std::vector<std::string> NotesOfSource(const std::string& file) {
  if (!IsRecording(file)) return {};
  return ReadSource(ReadRecordingSource(file)).notes;
}

bool IsDriveSource(const std::string& file) { return !IsRecording(file) && IsDriveScene(file); }

std::string HallOfSource(const std::string& file, std::uint64_t seed) {
  return IsRecording(file) ? "" : HallOfScene(file, seed);
}

std::int64_t CountSourceFrames(const std::string& file) {
  if (!IsRecording(file)) return CountSceneFrames(file);
  return std::ssize(OpenRecordingSource(file)->Schedule());
}

std::vector<std::string> FilesOfSource(const std::string& file) {
  if (!IsRecording(file)) return FilesOfScene(file);
  const RecordingSource source = ReadRecordingSource(file);
  std::vector<std::string> files = {file};
  for (const std::string& other : {source.path, source.truth}) {
    const auto topic = BagTopicFromText(other);
    const std::string path = topic ? topic->file.string() : other;
    if (!path.empty() && path != file) files.push_back(path);
  }
  for (const fs::path& truth : TruthAround(source.path)) files.push_back(truth.string());
  return files;
}

std::uint64_t HashSource(const std::string& file, const std::string& twin, std::uint64_t seed) {
  if (!IsRecording(file)) return Hash(EssenceOfScene(file, twin), seed);
  for (const std::string& one : FilesOfSource(file)) {
    if (fs::is_directory(one)) {
      for (const fs::path& below : FilesBelow(one)) seed = HashOutside(below, seed);
    } else {
      seed = HashOutside(one, seed);
      // What a recorder has not yet folded into its .db3.
      if (const fs::path log = one + "-wal"; fs::exists(log)) seed = HashOutside(log, seed);
    }
  }
  return seed;
}

}  // namespace aisle
