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
constexpr double kTumDepthSteps = 5000;  // per metre

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

std::string EurocCamera(const StereoCalibration& c, double rate_hz, int eye) {
  return fmt::format(
      "{}sensor_type: camera\ncomment: cam{}, rectified, ideal\n"
      "T_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\n"
      "rate_hz: {:g}\nresolution: [{}, {}]\ncamera_model: pinhole\n"
      "intrinsics: [{}, {}, {}, {}]\ndistortion_model: radial-tangential\n"
      "distortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n",
      kYamlOpening, eye, Matrix(EyePose(c, eye)), rate_hz, c.width, c.height, c.fx, c.fy, c.cx,
      c.cy);
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
    WriteFileAtomically(camera / "sensor.yaml", EurocCamera(calibration, rate_hz, eye));
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

/// Metres times 5000 in 16 bits, 0 where there is nothing or it lies beyond the range (13.1 m).
cv::Mat1w TumDepth(const cv::Mat1f& depth) {
  cv::Mat1w steps(depth.size());
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double value = std::round(depth(y, x) * kTumDepthSteps);
      steps(y, x) = value <= 65535 ? static_cast<unsigned short>(value) : 0;
    }
  }
  return steps;
}

nlohmann::ordered_json BoxToJson(const cv::Rect2d& box) {
  return {box.x, box.y, box.width, box.height};
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
                               {"velocity_world_mps", {v.x(), v.y(), v.z()}},
                               {"visible_fraction", object.visible_fraction},
                               {"visible_pixels", object.visible_pixels},
                               {"dynamic_pixels", object.dynamic_pixels}});
  }
  return json.dump(1) + "\n";
}

fs::path TruthPath(const fs::path& folder, const char* kind, std::int64_t id, const char* ending) {
  return folder / "truth" / kind / fmt::format("{:06}{}", id, ending);
}

}  // namespace

DatasetFormat DatasetFormatFromName(const std::string& name) {
  for (int k = 0; k < 3; ++k) {
    if (name == kNames[k]) return static_cast<DatasetFormat>(k);
  }
  throw InputError("dataset format '" + Printable(name) + "': expected euroc, kitti or tum");
}

TruthSelection TruthSelectionFromNames(const std::vector<std::string>& names) {
  TruthSelection selection;
  for (const std::string& name : names) {
    const bool all = name == "all";
    if (!all && name != "depth" && name != "labels" && name != "dynamic" && name != "boxes") {
      throw InputError("truth '" + Printable(name) +
                       "': expected depth, labels, dynamic, boxes or all");
    }
    selection.depth |= all || name == "depth";
    selection.labels |= all || name == "labels";
    selection.dynamic |= all || name == "dynamic";
    selection.boxes |= all || name == "boxes";
  }
  return selection;
}

DatasetWriter::DatasetWriter(fs::path folder, const StereoCalibration& calibration, double rate_hz,
                             const ExportOptions& options)
    : folder_(std::move(folder)), calibration_(calibration), rate_hz_(rate_hz), options_(options) {}

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
  std::vector<fs::path> paths = ImagePaths(request);
  if (options_.truth.depth) paths.push_back(TruthPath(folder_, "depth", request.id, ".pfm"));
  if (options_.truth.labels) paths.push_back(TruthPath(folder_, "instance", request.id, ".png"));
  if (options_.truth.dynamic) {
    paths.push_back(TruthPath(folder_, "dynamic", request.id, ".png"));
    paths.push_back(TruthPath(folder_, "actor", request.id, ".png"));
  }
  if (options_.truth.boxes) paths.push_back(TruthPath(folder_, "boxes", request.id, ".json"));
  return std::all_of(paths.begin(), paths.end(), [](const fs::path& p) { return fs::exists(p); });
}

void DatasetWriter::AddTruth(const SequenceFrame& frame) {
  const FrameTruth& truth = *frame.truth;
  const std::int64_t id = frame.images.id;
  if (options_.truth.depth) WriteImage(TruthPath(folder_, "depth", id, ".pfm"), truth.depth);
  if (options_.truth.labels) {
    WriteImage(TruthPath(folder_, "instance", id, ".png"), truth.instance);
  }
  if (options_.truth.dynamic) {
    WriteImage(TruthPath(folder_, "dynamic", id, ".png"), truth.dynamic);
    WriteImage(TruthPath(folder_, "actor", id, ".png"), truth.actor);
  }
  if (options_.truth.boxes) {
    WriteFileAtomically(TruthPath(folder_, "boxes", id, ".json"), BoxesJson(frame));
  }
}

void DatasetWriter::Add(const SequenceFrame& frame) {
  const bool wants_depth = options_.truth.depth || options_.format == DatasetFormat::kTum;
  if (!frame.truth || (wants_depth && frame.truth->depth.empty())) {
    throw std::invalid_argument("the frame comes without the truth that was asked for");
  }
  const std::vector<fs::path> paths =
      ImagePaths({frame.images.id, frame.images.stamp_ns, frame.truth->T_world_rig});
  AddTruth(frame);
  if (paths.size() > 2) WriteImage(paths[2], TumDepth(frame.truth->depth));
  WriteImage(paths[1], frame.images.right);
  WriteImage(paths[0], frame.images.left);
}

void DatasetWriter::Finish(const std::vector<FrameRequest>& frames, const PathOfRig& path) const {
  if (frames.empty()) throw std::invalid_argument("a dataset needs a frame at least");
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
