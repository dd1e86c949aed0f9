#include <yaml-cpp/yaml.h>

#include <charconv>
#include <sstream>

#include "harness/io/dataset.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::vector<double> Numbers(const std::string& text, const fs::path& file, std::size_t line) {
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (std::string word; stream >> word;) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      throw InputError(file.string(), line, fmt::format("'{}' is no number", Printable(word)));
    }
    numbers.push_back(value);
  }
  return numbers;
}

// --- EuRoC
// ----------------------------------------------------------------------------------------

/// A list of so many finite numbers under a key.
std::vector<double> NumbersAt(const YAML::Node& node, const std::string& key, std::size_t count,
                              const fs::path& file) {
  const YAML::Node list = node.IsMap() ? node[key] : YAML::Node();
  if (!list.IsDefined() || !list.IsSequence() || list.size() != count) {
    throw InputError(file.string(), 0, fmt::format("key '{}' must hold {} numbers", key, count));
  }
  std::vector<double> numbers;
  for (const YAML::Node& entry : list) {
    const std::vector<double> one =
        Numbers(entry.Scalar(), file, static_cast<std::size_t>(entry.Mark().line + 1));
    if (one.size() != 1)
      throw InputError(file.string(), 0, "key '" + key + "' holds an empty entry");
    numbers.push_back(one[0]);
  }
  return numbers;
}

CameraCalibration ReadEurocSensor(const fs::path& file) {
  YAML::Node root;
  std::string text = ReadFile(file, 1 << 20);
  if (text.starts_with("%YAML:")) text.erase(0, text.find('\n') + 1);  // OpenCV's own dialect
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(file.string(), static_cast<std::size_t>(error.mark.line + 1),
                     "is no YAML: " + error.msg);
  }
  if (!root.IsMap() || !root["T_BS"]) throw InputError(file.string(), 0, "key 'T_BS' is missing");
  CameraCalibration camera;
  const std::vector<double> size = NumbersAt(root, "resolution", 2, file);
  constexpr double kLargestSide = 16384;
  if (!std::ranges::all_of(size, [](double side) { return side >= 1 && side <= kLargestSide; })) {
    throw InputError(file.string(), 0,
                     fmt::format("resolution {:g} x {:g} is none of a camera", size[0], size[1]));
  }
  const std::vector<double> pinhole = NumbersAt(root, "intrinsics", 4, file);
  const std::vector<double> pose = NumbersAt(root["T_BS"], "data", 16, file);
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  camera.fx = pinhole[0];
  camera.fy = pinhole[1];
  camera.cx = pinhole[2];
  camera.cy = pinhole[3];
  const std::string model = root["distortion_model"] ? root["distortion_model"].Scalar() : "none";
  camera.equidistant = model == "equidistant" || model == "fisheye";
  const bool polynomial =  // as EuRoC, Kalibr and ROS call it
      model == "radial-tangential" || model == "radtan" || model == "plumb_bob";
  if (!polynomial && !camera.equidistant && model != "none") {
    throw InputError(file.string(), 0,
                     "distortion model '" + Printable(model) +
                         "': radial-tangential (radtan, plumb_bob), equidistant (fisheye) and "
                         "none are read");
  }
  if (model != "none") camera.distortion = NumbersAt(root, "distortion_coefficients", 4, file);
  for (int k = 0; k < 12; ++k) {
    camera.T_body_camera.matrix()(k / 4, k % 4) = pose[static_cast<std::size_t>(k)];
  }
  return camera;
}

std::map<std::int64_t, fs::path> ReadEurocIndex(const fs::path& camera) {
  const fs::path file = camera / "data.csv";
  std::istringstream stream(ReadFile(file));
  std::map<std::int64_t, fs::path> images;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const std::size_t comma = line.find(',');
    std::int64_t stamp_ns = 0;
    const auto [end, error] =
        std::from_chars(line.data(), line.data() + std::min(comma, line.size()), stamp_ns);
    if (comma == std::string::npos || error != std::errc() || end != line.data() + comma) {
      throw InputError(file.string(), number, "expected 'stamp in ns,file name'");
    }
    const std::size_t begin = line.find_first_not_of(" \t", comma + 1);
    const std::string name = begin == std::string::npos
                                 ? ""
                                 : line.substr(begin, line.find_last_not_of(" \t") - begin + 1);
    if (name.empty() || name.find('/') != std::string::npos || name.starts_with("..")) {
      throw InputError(file.string(), number, "'" + Printable(name) + "' is no plain file name");
    }
    images[stamp_ns] = camera / "data" / name;
  }
  return images;
}

bool IsLaidOutAsKitti(const fs::path& folder) {
  return fs::exists(folder / "calib.txt") || fs::is_directory(folder / "sequences");
}

StereoRecording ReadEuroc(const fs::path& folder) {
  if (IsLaidOutAsKitti(folder)) {
    throw InputError(folder.string(), 0,
                     "is laid out as KITTI's: its format is kitti (--format kitti), not euroc");
  }
  const fs::path mav = fs::is_directory(folder / "mav0") ? folder / "mav0" : folder;
  StereoRecording recording;
  recording.cameras.left = ReadEurocSensor(mav / "cam0/sensor.yaml");
  recording.cameras.right = ReadEurocSensor(mav / "cam1/sensor.yaml");
  const auto right = ReadEurocIndex(mav / "cam1");
  for (const auto& [stamp_ns, image] : ReadEurocIndex(mav / "cam0")) {
    const auto partner = right.find(stamp_ns);
    if (partner != right.end()) recording.pairs.push_back({stamp_ns, image, partner->second});
  }
  const fs::path truth = mav / "state_groundtruth_estimate0/data.csv";
  if (fs::exists(truth)) recording.truth = ReadTrajectory(truth, TrajectoryFormat::kEuroc);
  return recording;
}

// --- KITTI
// ----------------------------------------------------------------------------------------

struct KittiFolders {
  fs::path sequence, poses;
};

KittiFolders FindKitti(const fs::path& folder) {
  if (fs::is_directory(folder / "mav0") || fs::is_directory(folder / "cam0")) {
    throw InputError(folder.string(), 0, "is laid out as EuRoC's: its format is euroc, not kitti");
  }
  if (fs::exists(folder / "calib.txt")) {
    const fs::path clean = fs::absolute(folder).lexically_normal();
    const fs::path name = clean.has_filename() ? clean.filename() : clean.parent_path().filename();
    return {folder, folder / ".." / ".." / "poses" / (name.string() + ".txt")};
  }
  std::set<fs::path> sequences;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / "sequences", error)) {
    if (entry.is_directory()) sequences.insert(entry.path());
  }
  if (sequences.size() != 1) {
    throw InputError(folder.string(), 0,
                     fmt::format("holds {} sequences: name one, such as {}/sequences/00",
                                 sequences.size(), folder.string()));
  }
  const fs::path only = *sequences.begin();
  return {only, folder / "poses" / (only.filename().string() + ".txt")};
}

std::map<std::string, std::vector<double>> ReadKittiCalibration(const fs::path& file) {
  std::istringstream stream(ReadFile(file));
  std::map<std::string, std::vector<double>> rows;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    rows[line.substr(0, colon)] = Numbers(line.substr(colon + 1), file, number);
  }
  return rows;
}

/// A camera of KITTI's row: rectified, and beside the first one, whose poses are known.
CameraCalibration KittiCamera(const std::map<std::string, std::vector<double>>& rows,
                              const std::string& name, const fs::path& file) {
  const auto row = rows.find(name);
  if (row == rows.end() || row->second.size() != 12 || row->second[0] <= 0) {
    throw InputError(file.string(), 0, fmt::format("line '{}:' must hold a 3x4 projection", name));
  }
  const std::vector<double>& p = row->second;
  CameraCalibration camera;
  camera.fx = p[0];
  camera.fy = p[5];
  camera.cx = p[2];
  camera.cy = p[6];
  camera.T_body_camera.translation().x() = -p[3] / p[0];
  return camera;
}

StereoRecording ReadKitti(const fs::path& folder) {
  const KittiFolders at = FindKitti(folder);
  const auto calibration = ReadKittiCalibration(at.sequence / "calib.txt");
  // The grey pair, or where there is none the colour one.
  const bool grey = fs::exists(at.sequence / "image_0") || !fs::exists(at.sequence / "image_2");
  const fs::path left = at.sequence / (grey ? "image_0" : "image_2");
  const fs::path right = at.sequence / (grey ? "image_1" : "image_3");
  StereoRecording recording;
  recording.cameras.left = KittiCamera(calibration, grey ? "P0" : "P2", at.sequence / "calib.txt");
  recording.cameras.right = KittiCamera(calibration, grey ? "P1" : "P3", at.sequence / "calib.txt");
  std::istringstream times(ReadFile(at.sequence / "times.txt"));
  std::string line;
  for (std::size_t number = 1; times >> line; ++number) {
    const std::string name = fmt::format("{:06}.png", number - 1);
    StereoRecording::Pair pair{0, left / name, right / name};
    if (!ParseSecondsToNs(line, &pair.stamp_ns)) {
      throw InputError((at.sequence / "times.txt").string(), number,
                       "'" + Printable(line) + "' is not a time in seconds");
    }
    if (fs::exists(pair.left) && fs::exists(pair.right)) recording.pairs.push_back(pair);
  }
  if (fs::exists(at.poses)) {
    recording.truth = ReadTrajectory(at.poses, TrajectoryFormat::kKitti, at.sequence / "times.txt");
  }
  return recording;
}

}  // namespace

StereoRecording ReadRecording(const fs::path& folder, DatasetFormat format) {
  if (!fs::is_directory(folder)) throw InputError(folder.string(), 0, "no such folder");
  if (format == DatasetFormat::kTum) {
    throw InputError("a TUM folder is monocular or RGB-D: stereo recordings are euroc or kitti");
  }
  StereoRecording recording =
      format == DatasetFormat::kEuroc ? ReadEuroc(folder) : ReadKitti(folder);
  if (recording.pairs.empty()) throw InputError(folder.string(), 0, "holds no stereo pairs");
  recording.read_image = [pairs = recording.pairs](std::size_t pair, int side) {
    return ReadGreyPng(side == 0 ? pairs.at(pair).left : pairs.at(pair).right);
  };
  return recording;
}

}  // namespace aisle
