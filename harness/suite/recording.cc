#include "harness/suite/recording.h"

#include <filesystem>

#include "harness/io/input_error.h"
#include "harness/suite/suite_reader.h"
#include "harness/suite/yaml_guard.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

bool IsBag(const std::string& file) {
  const std::string ending = fs::path(file).extension().string();
  return ending == ".mcap" || ending == ".db3";
}

/// A path of the file is meant from the file's folder.
std::string From(const fs::path& folder, const std::string& path) {
  return path.empty() ? path : (folder / path).lexically_normal().string();
}

void Describe(Fields& fields, RecordingSource* source) {
  double baseline_m = 0;
  const Fields::Check any = [](const std::string&) { return std::string(); };
  fields.Text({"about", "question that the drive tests", "\"Aisle 3 with the night shift.\""},
              &source->file);
  fields.Text({"recording", "the bag, or the dataset's folder", "aisle3.mcap", true},
              &source->path);
  fields.Name({"format", "layout of a folder: euroc or kitti", "kitti"}, &source->format,
              {{"euroc", "kitti"}});
  fields.Texts({"topics", "topics of the left and the right image, for a bag with several pairs",
                "[/left/image_rect, /right/image_rect]"},
               &source->topics, any);
  fields.Number(
      {"baseline_m", "distance between the cameras, for a bag whose camera_info lacks it", "0.12"},
      &baseline_m, {1e-4, 100});
  fields.Text({"odometry", "topic of the wheel odometry, for a bag", "/odom"}, &source->odometry);
  fields.Text({"truth", "true poses of the left camera: a trajectory file, or a topic of a bag",
               "aisle3.mcap:/odom"},
              &source->truth);
  if (baseline_m > 0) source->baseline_m = baseline_m;
}

}  // namespace

bool IsRecording(const std::string& file) {
  if (IsBag(file)) return true;
  try {
    const YAML::Node root = LoadYaml(file);
    return root.IsMap() && root["recording"];
  } catch (const InputError&) {
    return false;
  }
}

RecordingSource ReadRecordingSource(const std::string& file) {
  RecordingSource source{.file = file, .path = file, .format = "euroc"};
  if (IsBag(file)) return source;
  const YAML::Node root = LoadYaml(file);
  Issues issues(file);
  YamlReader reader(root, "", &issues);
  Describe(reader, &source);
  reader.ReportKeys();
  if (!issues.empty()) throw InputError(issues.Text());
  const fs::path folder = fs::path(file).parent_path();
  source.file = file;
  source.path = From(folder, source.path);
  source.truth = From(folder, source.truth);
  return source;
}

}  // namespace aisle
