#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/io/dataset.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/imu.h"
#include "harness/io/input_error.h"
#include "harness/io/truth_files.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNames[] = {"euroc", "kitti", "tum"};
/// OpenCV's FileStorage, yaml-cpp and PyYAML all read a file that opens like this; each of the
/// other spellings is refused by one of them.
constexpr const char* kYamlOpening = "%YAML 1.0\n---\n";
constexpr double kTumDepthSteps = 5000;  // per metre: 13.1 m

std::string Matrix(const Eigen::Isometry3d& pose) {
  std::vector<double> values;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) values.push_back(pose.matrix()(row, column));
  }
  return fmt::format("{}", fmt::join(values, ", "));
}

Eigen::Isometry3d CameraPose(const StereoCalibration& calibration, int side) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = side * calibration.baseline_m;
  return pose;
}

// --- EuRoC
// ----------------------------------------------------------------------------------------

std::string EurocCamera(const StereoCalibration& c, const LensCalibration& lens, double rate_hz,
                        int side) {
  const bool bent = lens.model != "none";
  return fmt::format(
      "{}sensor_type: camera\ncomment: cam{}, {}\n"
      "T_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\n"
      "rate_hz: {:g}\nresolution: [{}, {}]\ncamera_model: pinhole\n"
      "intrinsics: [{}, {}, {}, {}]\ndistortion_model: {}\n"
      "distortion_coefficients: [{}]\n",
      kYamlOpening, side, bent ? "distorted" : "rectified, ideal", Matrix(CameraPose(c, side)),
      rate_hz, c.width, c.height, c.fx, c.fy, c.cx, c.cy, bent ? lens.model : "radial-tangential",
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
  std::vector<Eigen::Vector3d> velocities_mps;
  for (const FrameRequest& frame : frames) {
    const std::int64_t stamp_ns = frame.stamp_ns + options.epoch_ns;
    velocities_mps.push_back(VelocityAt(path, frame.stamp_ns, options.imu_rate_hz));
    index += fmt::format("{0},{0}.png\n", stamp_ns);
    times += fmt::format("{}\n", stamp_ns);
    truth.push_back({stamp_ns, frame.T_world_rig});
  }
  const std::vector<ImuSample> imu =
      IdealImu(path, frames.front().stamp_ns, frames.back().stamp_ns, options.imu_rate_hz);
  WriteFileAtomically(mav / "body.yaml", std::string(kYamlOpening) + "comment: the left camera\n");
  WriteFileAtomically(mav / "imu0/sensor.yaml", EurocImuSensor(options.imu_rate_hz));
  WriteFileAtomically(mav / "imu0/data.csv", FormatEurocImu(imu, options.epoch_ns));
  if (options.true_trajectory) {
    WriteFileAtomically(mav / "state_groundtruth_estimate0/sensor.yaml", EurocTruthSensor());
    WriteFileAtomically(mav / "state_groundtruth_estimate0/data.csv",
                        FormatEurocTruth(truth, velocities_mps));
  }
  WriteFileAtomically(mav / "times.txt", times);
  for (int side = 0; side < 2; ++side) {
    const fs::path camera = mav / fmt::format("cam{}", side);
    WriteFileAtomically(camera / "sensor.yaml",
                        EurocCamera(calibration, options.lens, rate_hz, side));
    WriteFileAtomically(camera / "data.csv", index);
    if (!options.colour) continue;
    const fs::path colour = mav / fmt::format("cam{}_rgb", side);
    WriteFileAtomically(colour / "sensor.yaml",
                        EurocCamera(calibration, options.lens, rate_hz, side));
    WriteFileAtomically(colour / "data.csv", index);
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
                 const std::vector<FrameRequest>& frames, const ExportOptions& options) {
  Trajectory relative;
  std::string times;
  const Eigen::Isometry3d T_first_world = frames.front().T_world_rig.inverse();
  for (const FrameRequest& frame : frames) {
    relative.push_back({frame.stamp_ns, T_first_world * frame.T_world_rig});
    times += FormatSeconds(frame.stamp_ns - frames.front().stamp_ns) + "\n";
  }
  if (options.true_trajectory) {
    WriteFileAtomically(folder / "poses/00.txt",
                        FormatTrajectory(relative, TrajectoryFormat::kKitti));
  }
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
    std::vector<std::string> names = {"rgb", "right", "depth"};
    if (options.colour) names.insert(names.end(), {"rgb_colour", "right_colour"});
    for (const std::string& name : names) {
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
  if (options.true_trajectory) {
    WriteFileAtomically(folder / "groundtruth.txt",
                        FormatTrajectory(truth, TrajectoryFormat::kTum));
  }
}

// --- All
// ------------------------------------------------------------------------------------------

fs::path TruthPath(const fs::path& folder, const TruthFile& file, const std::string& name) {
  return folder / "truth" / file.kind / (name + file.ending);
}

/// Throws InputError unless the dataset that `mine` describes has all frames of the one in the file
/// and perhaps more at its end.
void CheckContinues(const fs::path& file, const nlohmann::ordered_json& mine) {
  nlohmann::json theirs = nlohmann::json::parse(ReadFile(file), nullptr, false);
  nlohmann::json asked = mine;
  const auto number = [](const nlohmann::json& json, const char* key) {
    return json.is_object() && json.contains(key) && json[key].is_number_integer()
               ? json[key].get<std::int64_t>()
               : -1;
  };
  const std::int64_t first = number(theirs, "first_frame"), count = number(theirs, "frames");
  const std::int64_t my_first = number(asked, "first_frame"), my_count = number(asked, "frames");
  const std::string remedy = "choose another --out, or delete the folder";
  if (first >= 0 && count > 0 && (first != my_first || count > my_count)) {
    throw InputError(file.string(), 0,
                     fmt::format("the folder was started with frames {}:{} and can only grow at "
                                 "its end, but {}:{} were requested: {}",
                                 first, first + count, my_first, my_first + my_count, remedy));
  }
  asked["frames"] = count;
  if (theirs != asked) {
    throw InputError(
        file.string(), 0,
        "the folder was started with another scene, seed, twin, instruction set or format: " +
            remedy);
  }
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
                             std::vector<FrameRequest> frames, const ExportOptions& options)
    : folder_(std::move(folder)),
      calibration_(calibration),
      rate_hz_(rate_hz),
      frames_(std::move(frames)),
      options_(options) {
  if (frames_.empty()) throw std::invalid_argument("a dataset needs at least one frame");
  if (options_.format != DatasetFormat::kEuroc && options_.lens.model != "none") {
    throw InputError(
        fmt::format("the scene's lens is {}, but {} holds rectified images: use --format euroc, or "
                    "set camera.distortion to none",
                    options_.lens.model, kNames[static_cast<std::size_t>(options_.format)]));
  }
}

void DatasetWriter::Begin() const {
  nlohmann::ordered_json json = options_.provenance;
  json["format"] = kNames[static_cast<std::size_t>(options_.format)];
  json["first_frame"] = frames_.front().id;
  json["frames"] = frames_.size();
  json["stamp_offset_ns"] = StampOffset();
  json["T_world_poses"] =
      PoseToJson(options_.format == DatasetFormat::kKitti ? frames_.front().T_world_rig
                                                          : Eigen::Isometry3d::Identity());
  const fs::path file = folder_ / "aisle.json";
  if (fs::exists(file)) CheckContinues(file, json);
  WriteFileAtomically(file,
                      json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  if (options_.truth.labels) {
    WriteFileAtomically(folder_ / "truth/labels.json", LabelsJson(options_.labels));
  }
  if (!TruthFiles(options_).empty()) {
    WriteFileAtomically(folder_ / "truth/README.md", TruthReadme(options_.format));
  }
}

std::int64_t DatasetWriter::NumberOf(std::int64_t id) const {
  const auto frame = std::ranges::lower_bound(frames_, id, {}, &FrameRequest::id);
  if (frame == frames_.end() || frame->id != id) {
    throw std::invalid_argument(fmt::format("frame {} does not belong to the dataset", id));
  }
  return frame - frames_.begin();
}

std::int64_t DatasetWriter::StampOffset() const {
  return options_.format == DatasetFormat::kKitti ? -frames_.front().stamp_ns : options_.epoch_ns;
}

std::string DatasetWriter::NameOf(const FrameRequest& request) const {
  const std::int64_t number = NumberOf(request.id), stamp_ns = request.stamp_ns + StampOffset();
  switch (options_.format) {
    case DatasetFormat::kEuroc:
      return std::to_string(stamp_ns);
    case DatasetFormat::kKitti:
      break;
    case DatasetFormat::kTum:
      return FormatSeconds(stamp_ns);
  }
  return fmt::format("{:06}", number);
}

std::vector<fs::path> DatasetWriter::ImagePaths(const std::string& name) const {
  const std::string file = name + ".png";
  switch (options_.format) {
    case DatasetFormat::kEuroc:
      return {folder_ / "mav0/cam0/data" / file, folder_ / "mav0/cam1/data" / file};
    case DatasetFormat::kKitti:
      return {folder_ / "sequences/00/image_0" / file, folder_ / "sequences/00/image_1" / file};
    case DatasetFormat::kTum:
      break;
  }
  return {folder_ / "rgb" / file, folder_ / "right" / file, folder_ / "depth" / file};
}

std::vector<fs::path> DatasetWriter::ColourPaths(const std::string& name) const {
  if (!options_.colour) return {};
  const std::string file = name + ".png";
  switch (options_.format) {
    case DatasetFormat::kEuroc:
      return {folder_ / "mav0/cam0_rgb/data" / file, folder_ / "mav0/cam1_rgb/data" / file};
    case DatasetFormat::kKitti:
      return {folder_ / "sequences/00/image_2" / file, folder_ / "sequences/00/image_3" / file};
    case DatasetFormat::kTum:
      break;
  }
  return {folder_ / "rgb_colour" / file, folder_ / "right_colour" / file};
}

bool DatasetWriter::Has(const FrameRequest& request) const {
  const std::string name = NameOf(request);
  const auto is_there = [](const fs::path& path) { return fs::exists(path); };
  return std::ranges::all_of(ImagePaths(name), is_there) &&
         std::ranges::all_of(ColourPaths(name), is_there) &&
         std::ranges::all_of(TruthFiles(options_), [&](const TruthFile& file) {
           return fs::exists(TruthPath(folder_, file, name));
         });
}

void DatasetWriter::Add(const SequenceFrame& frame, const FrameMotion* motion,
                        const ColourPair* colour) {
  const bool wants_depth = options_.truth.depth || options_.format == DatasetFormat::kTum;
  if (!frame.truth || (wants_depth && frame.truth->depth.empty()) ||
      (options_.truth.NeedsMotion() && !motion)) {
    throw std::invalid_argument("the frame lacks the truth that was requested");
  }
  const FrameRequest request{frame.images.id, frame.images.stamp_ns, frame.truth->T_world_rig};
  const FrameForExport of{frame, motion, NumberOf(request.id), request.stamp_ns + StampOffset()};
  const std::string name = NameOf(request);
  for (const TruthFile& file : TruthFiles(options_)) {
    file.write(TruthPath(folder_, file, name), of);
  }
  const std::vector<fs::path> paths = ImagePaths(name);
  if (paths.size() > 2) WriteImage(paths[2], DepthInSteps(frame.truth->depth, kTumDepthSteps));
  const std::vector<fs::path> colours = ColourPaths(name);
  for (std::size_t side = 0; side < colours.size(); ++side) {
    if (colour == nullptr) throw std::invalid_argument("the frame lacks colour");
    WriteImage(colours[side], (*colour)[side]);
  }
  WriteImage(paths[1], frame.images.right);
  WriteImage(paths[0], frame.images.left);
}

void DatasetWriter::Finish(const PathOfRig& path) const {
  ClearLeftovers(folder_);
  switch (options_.format) {
    case DatasetFormat::kEuroc:
      return FinishEuroc(folder_ / "mav0", calibration_, rate_hz_, frames_, path, options_);
    case DatasetFormat::kKitti:
      return FinishKitti(folder_, calibration_, frames_, options_);
    case DatasetFormat::kTum:
      return FinishTum(folder_, calibration_, frames_, options_);
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
