#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/io/dataset.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/imu.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNames[] = {"euroc", "kitti", "tum"};
/// OpenCV's FileStorage, yaml-cpp and PyYAML all read a file that opens like this; each of the
/// other spellings is refused by one of them.
constexpr const char* kYamlOpening = "%YAML 1.0\n---\n";
constexpr double kTumDepthSteps = 5000;  // per metre: 13.1 m
constexpr double kDepthSteps = 1000;     // per metre: 65.5 m

std::string Matrix(const Eigen::Isometry3d& pose) {
  std::vector<double> values;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) values.push_back(pose.matrix()(row, column));
  }
  return fmt::format("{}", fmt::join(values, ", "));
}

Eigen::Isometry3d EyePose(const StereoCalibration& calibration, int eye) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = eye * calibration.baseline_m;
  return pose;
}

// --- EuRoC
// ----------------------------------------------------------------------------------------

std::string EurocCamera(const StereoCalibration& c, const LensCalibration& lens, double rate_hz,
                        int eye) {
  const bool bent = lens.model != "none";
  return fmt::format(
      "{}sensor_type: camera\ncomment: cam{}, {}\n"
      "T_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\n"
      "rate_hz: {:g}\nresolution: [{}, {}]\ncamera_model: pinhole\n"
      "intrinsics: [{}, {}, {}, {}]\ndistortion_model: {}\n"
      "distortion_coefficients: [{}]\n",
      kYamlOpening, eye, bent ? "distorted" : "rectified, ideal", Matrix(EyePose(c, eye)), rate_hz,
      c.width, c.height, c.fx, c.fy, c.cx, c.cy, bent ? lens.model : "radial-tangential",
      fmt::join(lens.coefficients, ", "));
}

std::string EurocImuSensor(double rate_hz) {
  return fmt::format(
      "{}sensor_type: imu\ncomment: ideal, from the analytic path\n"
      "T_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\nrate_hz: {:g}\n"
      "gyroscope_noise_density: 1.6968e-04\ngyroscope_random_walk: 1.9393e-05\n"
      "accelerometer_noise_density: 2.0000e-3\naccelerometer_random_walk: 3.0000e-3\n",
      kYamlOpening, Matrix(Eigen::Isometry3d::Identity()), rate_hz);
}

std::string EurocTruthSensor() {
  return fmt::format(
      "{}sensor_type: visual-inertial\ncomment: exact\n"
      "T_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\n",
      kYamlOpening, Matrix(Eigen::Isometry3d::Identity()));
}

void FinishEuroc(const fs::path& mav, const StereoCalibration& calibration, double rate_hz,
                 const std::vector<FrameRequest>& frames, const PathOfRig& path,
                 const ExportOptions& options) {
  std::string index = "#timestamp [ns],filename\n", times;
  Trajectory truth;
  for (const FrameRequest& frame : frames) {
    const std::int64_t stamp_ns = frame.stamp_ns + options.epoch_ns;
    index += fmt::format("{0},{0}.png\n", stamp_ns);
    times += fmt::format("{}\n", stamp_ns);
    truth.push_back({stamp_ns, frame.T_world_rig});
  }
  const std::vector<ImuSample> imu =
      IdealImu(path, frames.front().stamp_ns, frames.back().stamp_ns, options.imu_rate_hz);
  WriteFileAtomically(mav / "body.yaml", std::string(kYamlOpening) + "comment: the left camera\n");
  WriteFileAtomically(mav / "imu0/sensor.yaml", EurocImuSensor(options.imu_rate_hz));
  WriteFileAtomically(mav / "imu0/data.csv", FormatEurocImu(imu, options.epoch_ns));
  WriteFileAtomically(mav / "state_groundtruth_estimate0/sensor.yaml", EurocTruthSensor());
  WriteFileAtomically(mav / "state_groundtruth_estimate0/data.csv",
                      FormatTrajectory(truth, TrajectoryFormat::kEuroc));
  WriteFileAtomically(mav / "times.txt", times);
  for (int eye = 0; eye < 2; ++eye) {
    const fs::path camera = mav / fmt::format("cam{}", eye);
    WriteFileAtomically(camera / "sensor.yaml",
                        EurocCamera(calibration, options.lens, rate_hz, eye));
    WriteFileAtomically(camera / "data.csv", index);
  }
}

// --- KITTI
// ----------------------------------------------------------------------------------------

std::string KittiCalibration(const StereoCalibration& c) {
  const auto row = [&](const char* name, double bx) {
    return fmt::format("{}: {} 0 {} {} 0 {} {} 0 0 0 1 0\n", name, c.fx, c.cx, bx, c.fy, c.cy);
  };
  const double bx = -c.fx * c.baseline_m;
  return row("P0", 0) + row("P1", bx) + row("P2", 0) + row("P3", bx) +
         "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n";
}

void FinishKitti(const fs::path& folder, const StereoCalibration& calibration,
                 const std::vector<FrameRequest>& frames) {
  Trajectory relative;
  std::string times;
  const Eigen::Isometry3d T_first_world = frames.front().T_world_rig.inverse();
  for (const FrameRequest& frame : frames) {
    relative.push_back({frame.stamp_ns, T_first_world * frame.T_world_rig});
    times += FormatSeconds(frame.stamp_ns - frames.front().stamp_ns) + "\n";
  }
  WriteFileAtomically(folder / "poses/00.txt",
                      FormatTrajectory(relative, TrajectoryFormat::kKitti));
  WriteFileAtomically(folder / "sequences/00/calib.txt", KittiCalibration(calibration));
  WriteFileAtomically(folder / "sequences/00/times.txt", times);
}

// --- TUM
// ------------------------------------------------------------------------------------------

void FinishTum(const fs::path& folder, const StereoCalibration& c,
               const std::vector<FrameRequest>& frames, const ExportOptions& options) {
  std::map<std::string, std::string> lists;
  Trajectory truth;
  for (const FrameRequest& frame : frames) {
    const std::string stamp = FormatSeconds(frame.stamp_ns + options.epoch_ns);
    for (const char* name : {"rgb", "right", "depth"}) {
      lists[name] += fmt::format("{0} {1}/{0}.png\n", stamp, name);
    }
    truth.push_back({frame.stamp_ns + options.epoch_ns, frame.T_world_rig});
  }
  for (const auto& [name, list] : lists) {
    WriteFileAtomically(folder / (name + ".txt"), "# timestamp filename\n" + list);
  }
  WriteFileAtomically(folder / "calibration.txt",
                      fmt::format("# fx fy cx cy baseline_m width height\n{} {} {} {} {} {} {}\n",
                                  c.fx, c.fy, c.cx, c.cy, c.baseline_m, c.width, c.height));
  WriteFileAtomically(folder / "groundtruth.txt", FormatTrajectory(truth, TrajectoryFormat::kTum));
}

/// Metres times `per_metre` in 16 bits, 0 where there is nothing or it lies beyond the range.
cv::Mat1w DepthInSteps(const cv::Mat1f& depth, double per_metre) {
  cv::Mat1w steps(depth.size());
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double value = std::round(depth(y, x) * per_metre);
      steps(y, x) = value <= 65535 ? static_cast<unsigned short>(value) : 0;
    }
  }
  return steps;
}

nlohmann::ordered_json BoxToJson(const cv::Rect2d& box) {
  return {box.x, box.y, box.width, box.height};
}

nlohmann::ordered_json VectorToJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// 16 numbers, row by row.
nlohmann::ordered_json PoseToJson(const Eigen::Isometry3d& pose) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (int k = 0; k < 16; ++k) json.push_back(pose.matrix()(k / 4, k % 4));
  return json;
}

std::string BoxesJson(const SequenceFrame& frame) {
  nlohmann::ordered_json json = {{"frame", frame.images.id}, {"stamp_ns", frame.images.stamp_ns}};
  json["objects"] = nlohmann::ordered_json::array();
  for (const ObjectTruth& object : frame.truth->objects) {
    const Eigen::Vector3d &c = object.center_m, &v = object.velocity_mps;
    json["objects"].push_back({{"instance", object.instance},
                               {"class", object.object_class},
                               {"box_visible_px", BoxToJson(object.box_visible)},
                               {"box_full_px", BoxToJson(object.box_full)},
                               {"center_world_m", {c.x(), c.y(), c.z()}},
                               {"extent_m", VectorToJson(object.extent_m)},
                               {"T_world_object", PoseToJson(object.T_world_object)},
                               {"velocity_world_mps", {v.x(), v.y(), v.z()}},
                               {"visible_fraction", object.visible_fraction},
                               {"visible_pixels", object.visible_pixels},
                               {"dynamic_pixels", object.dynamic_pixels}});
  }
  return json.dump(1) + "\n";
}

/// Class of every pixel from its instance.
cv::Mat1b Classes(const cv::Mat1w& instance, const std::vector<LabelInfo>& labels) {
  cv::Mat1b classes(instance.size());
  std::transform(instance.begin(), instance.end(), classes.begin(), [&](std::uint16_t id) {
    return id < labels.size() ? labels[id].class_id : std::uint8_t{0};
  });
  return classes;
}

std::string LabelsJson(const std::vector<LabelInfo>& labels) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (std::size_t id = 0; id < labels.size(); ++id) {
    json.push_back({{"id", id},
                    {"name", labels[id].name},
                    {"class", labels[id].object_class},
                    {"class_id", labels[id].class_id},
                    {"moving", labels[id].moving}});
  }
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Middlebury's .flo; what is unknown is 1e10, by its convention.
std::string FloFile(const cv::Mat2f& flow) {
  constexpr float kUnknown = 1e10f;
  std::string bytes = "PIEH";
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  put(std::int32_t{flow.cols});
  put(std::int32_t{flow.rows});
  for (const cv::Vec2f& f : flow) {
    const bool known = std::isfinite(f[0]) && std::isfinite(f[1]);
    put(known ? f[0] : kUnknown);
    put(known ? f[1] : kUnknown);
  }
  return bytes;
}

/// A kind of truth file: its folder and ending, and how it is written.
struct TruthFile {
  const char* kind;
  const char* ending;
  std::function<void(const fs::path&, const SequenceFrame&, const FrameMotion*)> write;
};

/// A file that is an image as it stands.
template <typename Image>
TruthFile Plain(const char* kind, const char* ending, Image FrameTruth::*image) {
  return {kind, ending, [=](const fs::path& path, const SequenceFrame& frame, const FrameMotion*) {
            WriteImage(path, (*frame.truth).*image);
          }};
}
template <typename Image>
TruthFile Plain(const char* kind, const char* ending, Image FrameMotion::*image) {
  return {kind, ending, [=](const fs::path& path, const SequenceFrame&, const FrameMotion* motion) {
            WriteImage(path, motion->*image);
          }};
}

/// All files of a frame's truth that the selection asks for.
std::vector<TruthFile> TruthFiles(const ExportOptions& options) {
  const TruthSelection& truth = options.truth;
  std::vector<TruthFile> files;
  if (truth.depth) {
    files.push_back(Plain("depth", ".pfm", &FrameTruth::depth));
    files.push_back(Plain("depth_right", ".pfm", &FrameTruth::depth_right));
    files.push_back({"depth_mm", ".png", [](const auto& path, const auto& frame, const auto*) {
                       WriteImage(path, DepthInSteps(frame.truth->depth, kDepthSteps));
                     }});
  }
  if (truth.labels) {
    files.push_back(Plain("instance", ".png", &FrameTruth::instance));
    files.push_back(Plain("instance_right", ".png", &FrameTruth::instance_right));
    files.push_back({"class", ".png", [&](const auto& path, const auto& frame, const auto*) {
                       WriteImage(path, Classes(frame.truth->instance, options.labels));
                     }});
    files.push_back({"class_right", ".png", [&](const auto& path, const auto& frame, const auto*) {
                       WriteImage(path, Classes(frame.truth->instance_right, options.labels));
                     }});
  }
  if (truth.dynamic) {
    files.push_back(Plain("dynamic", ".png", &FrameTruth::dynamic));
    files.push_back(Plain("dynamic_right", ".png", &FrameTruth::dynamic_right));
    files.push_back(Plain("actor", ".png", &FrameTruth::actor));
  }
  if (truth.boxes) {
    files.push_back({"boxes", ".json", [](const auto& path, const auto& frame, const auto*) {
                       WriteFileAtomically(path, BoxesJson(frame));
                     }});
  }
  if (truth.flow) {
    files.push_back({"flow", ".flo", [](const auto& path, const auto&, const auto* motion) {
                       WriteFileAtomically(path, FloFile(motion->flow));
                     }});
    files.push_back(Plain("scene_flow", ".pfm", &FrameMotion::scene_flow));
  }
  if (truth.stereo) {
    files.push_back(Plain("disparity", ".pfm", &FrameMotion::disparity));
    files.push_back(Plain("occluded", ".png", &FrameMotion::occluded));
  }
  if (truth.shadows) {
    files.push_back(Plain("moving_shadow", ".png", &FrameMotion::moving_shadow));
  }
  return files;
}

}  // namespace

DatasetFormat DatasetFormatFromName(const std::string& name) {
  for (int k = 0; k < 3; ++k) {
    if (name == kNames[k]) return static_cast<DatasetFormat>(k);
  }
  throw InputError("dataset format '" + Printable(name) + "': expected euroc, kitti or tum");
}

TruthSelection TruthSelectionFromNames(const std::vector<std::string>& names) {
  constexpr std::pair<const char*, bool TruthSelection::*> kKinds[] = {
      {"depth", &TruthSelection::depth},     {"labels", &TruthSelection::labels},
      {"dynamic", &TruthSelection::dynamic}, {"boxes", &TruthSelection::boxes},
      {"flow", &TruthSelection::flow},       {"stereo", &TruthSelection::stereo},
      {"shadows", &TruthSelection::shadows}};
  TruthSelection selection;
  for (const std::string& name : names) {
    bool known = name == "all";
    for (const auto& [kind, field] : kKinds) {
      if (name != "all" && name != kind) continue;
      selection.*field = true;
      known = true;
    }
    if (!known) {
      throw InputError("truth '" + Printable(name) +
                       "': expected depth, labels, dynamic, boxes, flow, stereo, shadows or all");
    }
  }
  return selection;
}

DatasetWriter::DatasetWriter(fs::path folder, const StereoCalibration& calibration, double rate_hz,
                             const ExportOptions& options)
    : folder_(std::move(folder)), calibration_(calibration), rate_hz_(rate_hz), options_(options) {
  if (options_.format != DatasetFormat::kEuroc && options_.lens.model != "none") {
    throw InputError(fmt::format(
        "the scene's lens is {}, and {} holds rectified images only: export it as euroc, or set "
        "camera.distortion to none",
        options_.lens.model, kNames[static_cast<std::size_t>(options_.format)]));
  }
}

void DatasetWriter::Begin() const {
  nlohmann::ordered_json json = options_.provenance;
  json["format"] = kNames[static_cast<std::size_t>(options_.format)];
  const std::string mine =
      json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  const fs::path file = folder_ / "aisle.json";
  if (fs::exists(file) && ReadFile(file) != mine) {
    throw InputError(file.string(), 0,
                     "the folder was begun with another scene, seed, twin, instruction set or "
                     "format: choose another --out, or delete the folder");
  }
  WriteFileAtomically(file, mine);
  if (options_.truth.labels) {
    WriteFileAtomically(folder_ / "truth/labels.json", LabelsJson(options_.labels));
  }
}

fs::path DatasetWriter::TruthPath(const char* kind, std::int64_t id, const char* ending) const {
  return folder_ / "truth" / kind / fmt::format("{:06}{}", id, ending);
}

std::vector<fs::path> DatasetWriter::TruthPaths(std::int64_t id) const {
  std::vector<fs::path> paths;
  for (const TruthFile& file : TruthFiles(options_)) {
    paths.push_back(TruthPath(file.kind, id, file.ending));
  }
  return paths;
}

std::vector<fs::path> DatasetWriter::ImagePaths(const FrameRequest& request) const {
  if (options_.format == DatasetFormat::kKitti) {
    const std::string name = fmt::format("{:06}.png", request.id);
    return {folder_ / "sequences/00/image_0" / name, folder_ / "sequences/00/image_1" / name};
  }
  const std::int64_t stamp_ns = request.stamp_ns + options_.epoch_ns;
  if (options_.format == DatasetFormat::kEuroc) {
    const std::string name = fmt::format("{}.png", stamp_ns);
    return {folder_ / "mav0/cam0/data" / name, folder_ / "mav0/cam1/data" / name};
  }
  const std::string name = FormatSeconds(stamp_ns) + ".png";
  return {folder_ / "rgb" / name, folder_ / "right" / name, folder_ / "depth" / name};
}

bool DatasetWriter::Has(const FrameRequest& request) const {
  const std::vector<fs::path> images = ImagePaths(request), truth = TruthPaths(request.id);
  const auto exists = [](const fs::path& path) { return fs::exists(path); };
  return std::ranges::all_of(images, exists) && std::ranges::all_of(truth, exists);
}

void DatasetWriter::Add(const SequenceFrame& frame, const FrameMotion* motion) {
  const bool wants_depth = options_.truth.depth || options_.format == DatasetFormat::kTum;
  if (!frame.truth || (wants_depth && frame.truth->depth.empty()) ||
      (options_.truth.NeedsMotion() && !motion)) {
    throw std::invalid_argument("the frame comes without the truth that was asked for");
  }
  const std::vector<fs::path> paths =
      ImagePaths({frame.images.id, frame.images.stamp_ns, frame.truth->T_world_rig});
  for (const TruthFile& file : TruthFiles(options_)) {
    file.write(TruthPath(file.kind, frame.images.id, file.ending), frame, motion);
  }
  if (paths.size() > 2) WriteImage(paths[2], DepthInSteps(frame.truth->depth, kTumDepthSteps));
  WriteImage(paths[1], frame.images.right);
  WriteImage(paths[0], frame.images.left);
}

void DatasetWriter::Finish(const std::vector<FrameRequest>& frames, const PathOfRig& path) const {
  if (frames.empty()) throw std::invalid_argument("a dataset needs a frame at least");
  ClearLeftovers(folder_);
  switch (options_.format) {
    case DatasetFormat::kEuroc:
      return FinishEuroc(folder_ / "mav0", calibration_, rate_hz_, frames, path, options_);
    case DatasetFormat::kKitti:
      return FinishKitti(folder_, calibration_, frames);
    case DatasetFormat::kTum:
      return FinishTum(folder_, calibration_, frames, options_);
  }
}

fs::path CalibrationPath(const fs::path& folder, DatasetFormat format) {
  switch (format) {
    case DatasetFormat::kEuroc:
      return folder / "mav0/cam0/sensor.yaml";
    case DatasetFormat::kKitti:
      return folder / "sequences/00/calib.txt";
    case DatasetFormat::kTum:
      break;
  }
  return folder / "calibration.txt";
}

}  // namespace aisle
