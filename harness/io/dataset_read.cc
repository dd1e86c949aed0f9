#include <yaml-cpp/yaml.h>

#include <charconv>
#include <sstream>

#include "harness/contract/pinhole.h"
#include "harness/contract/rigid.h"
#include "harness/io/dataset.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/io/odometry_files.h"
#include "harness/io/stereo_pairs.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Without the byte order mark that some editors set before UTF-8.
std::string ReadText(const fs::path& path, std::size_t max_bytes = std::size_t{1} << 30) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string text = ReadFile(path, max_bytes);
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

std::vector<double> Numbers(const std::string& text, const fs::path& file, std::size_t line) {
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (std::string word; stream >> word;) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      throw InputError(file.string(), line,
                       fmt::format("expected a number, got '{}'", Printable(word)));
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
    throw InputError(file.string(), 0, fmt::format("key '{}' must have {} numbers", key, count));
  }
  std::vector<double> numbers;
  for (const YAML::Node& entry : list) {
    const std::vector<double> one =
        Numbers(entry.Scalar(), file, static_cast<std::size_t>(entry.Mark().line + 1));
    if (one.size() != 1) throw InputError(file.string(), 0, "key '" + key + "' has an empty entry");
    numbers.push_back(one[0]);
  }
  return numbers;
}

/// T_BS: the sensor's pose in the body.
Eigen::Isometry3d BodyOfSensor(const YAML::Node& node, const fs::path& file) {
  const std::vector<double> numbers = NumbersAt(node, "data", 16, file);
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  constexpr double kTolerance = 0.01;  // files with three decimals are still rotations
  const Eigen::Isometry3d pose(matrix);
  const Eigen::RowVector4d off = matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1);
  if (!IsRigid(pose, kTolerance) || off.cwiseAbs().maxCoeff() > kTolerance) {
    throw InputError(file.string(), static_cast<std::size_t>(node.Mark().line + 1),
                     "T_BS is not a pose: expected four rows, each a row of a rotation and a "
                     "coordinate in metres, the last 0 0 0 1");
  }
  return pose;
}

CameraCalibration ReadEurocSensor(const fs::path& file) {
  YAML::Node root;
  std::string text = ReadText(file, 1 << 20);
  if (text.starts_with("%YAML:")) text.erase(0, text.find('\n') + 1);  // OpenCV's own dialect
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(file.string(), static_cast<std::size_t>(error.mark.line + 1),
                     "not YAML: " + error.msg);
  }
  if (!root.IsMap() || !root["T_BS"]) throw InputError(file.string(), 0, "key 'T_BS' is missing");
  CameraCalibration camera;
  const std::vector<double> size = NumbersAt(root, "resolution", 2, file);
  constexpr double kLargestSide = 16384;
  if (!std::ranges::all_of(size, [](double side) { return side >= 1 && side <= kLargestSide; })) {
    throw InputError(file.string(), 0,
                     fmt::format("invalid camera resolution {:g} x {:g}", size[0], size[1]));
  }
  const std::vector<double> pinhole = NumbersAt(root, "intrinsics", 4, file);
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  camera.fx = pinhole[0];
  camera.fy = pinhole[1];
  camera.cx = pinhole[2];
  camera.cy = pinhole[3];
  if (!IsPinhole(camera.fx, camera.fy, camera.cx, camera.cy)) {
    throw InputError(file.string(), 0,
                     fmt::format("intrinsics {:g}, {:g}, {:g}, {:g} are no camera's: expected fx, "
                                 "fy, cx, cy in pixels",
                                 pinhole[0], pinhole[1], pinhole[2], pinhole[3]));
  }
  const std::string model = root["distortion_model"] ? root["distortion_model"].Scalar() : "none";
  camera.equidistant = model == "equidistant" || model == "fisheye";
  const bool polynomial =  // as EuRoC, Kalibr and ROS call it
      model == "radial-tangential" || model == "radtan" || model == "plumb_bob";
  if (!polynomial && !camera.equidistant && model != "none") {
    throw InputError(
        file.string(), 0,
        "distortion model '" + Printable(model) +
            "': expected radial-tangential (radtan, plumb_bob), equidistant (fisheye) or none");
  }
  if (model != "none") {
    const YAML::Node list = root["distortion_coefficients"];
    const bool has_k3 = polynomial && list && list.IsSequence() && list.size() == 5;  // as ROS's
    camera.distortion = NumbersAt(root, "distortion_coefficients", has_k3 ? 5 : 4, file);
  }
  camera.T_body_camera = BodyOfSensor(root["T_BS"], file);
  return camera;
}

/// Asked before the drive, which would end where the first one is missing.
void CheckAreThere(const std::map<std::int64_t, fs::path>& images, const fs::path& index) {
  std::vector<std::string> missing;
  for (const auto& [stamp_ns, image] : images) {
    if (!fs::exists(image)) missing.push_back(image.filename().string());
  }
  if (missing.empty()) return;
  throw InputError(index.string(), 0,
                   fmt::format("{} of the {} images that it lists are missing from its folder "
                               "data, {} first: add them, or remove their rows",
                               missing.size(), images.size(), Printable(missing.front())));
}

std::map<std::int64_t, fs::path> ReadEurocIndex(const fs::path& camera) {
  const fs::path file = camera / "data.csv";
  std::istringstream stream(ReadText(file));
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
      throw InputError(file.string(), number, "expected 'timestamp in ns,file name'");
    }
    const std::size_t begin = line.find_first_not_of(" \t", comma + 1);
    const std::string name = begin == std::string::npos
                                 ? ""
                                 : line.substr(begin, line.find_last_not_of(" \t") - begin + 1);
    if (name.empty() || name.find('/') != std::string::npos || name.starts_with("..")) {
      throw InputError(file.string(), number, "'" + Printable(name) + "' is not a plain file name");
    }
    if (!images.emplace(stamp_ns, camera / "data" / name).second) {
      throw InputError(file.string(), number,
                       fmt::format("a second image at {} ns: remove one of them", stamp_ns));
    }
  }
  CheckAreThere(images, file);
  return images;
}

bool IsLaidOutAsKitti(const fs::path& folder) {
  return fs::exists(folder / "calib.txt") || fs::is_directory(folder / "sequences");
}

/// Of a folder of which not even a camera is there.
void RefuseNoDataset(const fs::path& folder, const fs::path& mav) {
  if (fs::exists(mav / "cam0")) return;
  constexpr std::size_t kMostNamed = 8;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(Printable(entry.path().filename().string()));
  }
  const std::size_t count = names.size();
  const std::vector<std::string> named(names.begin(),
                                       std::next(names.begin(), std::min(kMostNamed, count)));
  throw InputError(folder.string(), 0,
                   fmt::format("not a dataset: EuRoC's has cam0 and cam1 (sensor.yaml, data.csv, "
                               "data), here or in mav0, KITTI's has calib.txt, times.txt, image_0 "
                               "and image_1, a ROS 2 bag has metadata.yaml; this folder has {}{}",
                               count == 0 ? "nothing" : fmt::format("{}", fmt::join(named, ", ")),
                               named.size() < count ? ", …" : ""));
}

StereoRecording ReadEuroc(const fs::path& folder) {
  if (IsLaidOutAsKitti(folder)) {
    throw InputError(folder.string(), 0,
                     "is in KITTI's layout: use format kitti (--format kitti), not euroc");
  }
  const fs::path mav = fs::is_directory(folder / "mav0") ? folder / "mav0" : folder;
  RefuseNoDataset(folder, mav);
  StereoRecording recording;
  recording.cameras.left = ReadEurocSensor(mav / "cam0/sensor.yaml");
  recording.cameras.right = ReadEurocSensor(mav / "cam1/sensor.yaml");
  const auto left = ReadEurocIndex(mav / "cam0"), right = ReadEurocIndex(mav / "cam1");
  for (const StampPair& pair : PairStamps({StampsOf(left), StampsOf(right)}, mav.string())) {
    recording.pairs.push_back({pair.left_ns, left.at(pair.left_ns), right.at(pair.right_ns)});
  }
  recording.notes = NotesOnPairs(recording.pairs.size(), left.size());
  const fs::path truth = mav / "state_groundtruth_estimate0/data.csv";
  if (fs::exists(truth)) recording.truth = ReadTrajectory(truth, TrajectoryFormat::kEuroc);
  recording.read_wheels = WheelsOfEuroc(mav, recording.cameras.left.T_body_camera);
  return recording;
}

// --- KITTI
// ----------------------------------------------------------------------------------------

struct KittiFolders {
  fs::path sequence, poses;
};

KittiFolders FindKitti(const fs::path& folder) {
  if (fs::is_directory(folder / "mav0") || fs::is_directory(folder / "cam0")) {
    throw InputError(folder.string(), 0, "is in EuRoC's layout: use format euroc, not kitti");
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
                     fmt::format("has {} sequences: name one of them, for example {}/sequences/00",
                                 sequences.size(), folder.string()));
  }
  const fs::path only = *sequences.begin();
  return {only, folder / "poses" / (only.filename().string() + ".txt")};
}

std::map<std::string, std::vector<double>> ReadKittiCalibration(const fs::path& file) {
  std::istringstream stream(ReadText(file));
  std::map<std::string, std::vector<double>> rows;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string name = line.substr(0, colon);
    if (!rows.emplace(name, Numbers(line.substr(colon + 1), file, number)).second) {
      throw InputError(file.string(), number,
                       "a second line '" + Printable(name) + ":': remove one of them");
    }
  }
  return rows;
}

/// A camera of KITTI's row: rectified, and beside the first one, whose poses are known.
CameraCalibration KittiCamera(const std::map<std::string, std::vector<double>>& rows,
                              const std::string& name, const fs::path& file) {
  const auto row = rows.find(name);
  if (row == rows.end() || row->second.size() != 12 || row->second[0] <= 0) {
    throw InputError(file.string(), 0, fmt::format("line '{}:' must have a 3x4 projection", name));
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

struct KittiPairs {
  std::vector<StereoRecording::Pair> pairs;
  std::vector<std::string> notes;
};

/// The frames of which both folders have the image.
KittiPairs FindKittiPairs(const fs::path& times, const fs::path& left, const fs::path& right) {
  std::istringstream stream(ReadText(times));
  KittiPairs found;
  std::size_t rows = 0, left_images = 0;
  for (std::string text; stream >> text; ++rows) {
    const std::string name = fmt::format("{:06}.png", rows);
    StereoRecording::Pair pair{0, left / name, right / name};
    if (!ParseSecondsToNs(text, &pair.stamp_ns)) {
      throw InputError(times.string(), rows + 1,
                       "'" + Printable(text) + "' is not a time in seconds");
    }
    if (!fs::exists(pair.left)) continue;
    ++left_images;
    if (fs::exists(pair.right)) found.pairs.push_back(pair);
  }
  if (2 * left_images < rows) {
    throw InputError(left.string(), 0,
                     fmt::format("has {} images of the {} that {} has times for: add the missing "
                                 "ones, or cut the times and the poses",
                                 left_images, rows, times.string()));
  }
  CheckEnoughPairs(found.pairs.size(), left_images, right.string());
  found.notes = NotesOnPairs(found.pairs.size(), left_images);
  if (left_images < rows) {
    found.notes.push_back(
        fmt::format("{} of {} frames have a time but no left image", rows - left_images, rows));
  }
  return found;
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
  const KittiPairs found = FindKittiPairs(at.sequence / "times.txt", left, right);
  recording.pairs = found.pairs;
  recording.notes = found.notes;
  if (fs::exists(at.poses)) {
    recording.truth = ReadTrajectory(at.poses, TrajectoryFormat::kKitti, at.sequence / "times.txt");
    // The benchmark's world is its first camera, y down; everybody else's has z up.
    for (StampedPose& pose : recording.truth) pose.T_world_rig = CameraAhead() * pose.T_world_rig;
  }
  recording.read_wheels = WheelsOfKitti(at.sequence);
  return recording;
}

/// Where poses of a sequence may be, ROOT/sequences/NN with ROOT/poses/NN.txt: a link has a root
/// and a name where it stands, and others where it leads.
std::vector<fs::path> KittiPosesOf(const fs::path& sequence) {
  fs::path named = fs::absolute(sequence).lexically_normal();
  if (!named.has_filename()) named = named.parent_path();
  std::error_code error;
  const fs::path real = fs::weakly_canonical(named, error);
  std::vector<fs::path> poses;
  for (const fs::path& root : {named, real}) {
    for (const fs::path& name : {named, real}) {
      poses.push_back(root.parent_path().parent_path() / "poses" /
                      (name.filename().string() + ".txt"));
    }
  }
  return poses;
}

/// Where truth of a folder of either layout may be.
std::vector<fs::path> PlacesOfTruth(const fs::path& folder) {
  std::vector<fs::path> places = KittiPosesOf(folder);
  std::error_code error;
  for (fs::directory_iterator at(folder / "sequences", error), end; !error && at != end;
       at.increment(error)) {
    for (const fs::path& poses : KittiPosesOf(at->path())) places.push_back(poses);
  }
  places.push_back(folder / "mav0");  // as a whole: trackers' raw data are beside the truth
  for (const fs::path& mav : {folder, folder / "mav0"}) {
    places.push_back(mav / "state_groundtruth_estimate0");
    places.push_back(mav / "state_groundtruth_estimate0/data.csv");
  }
  return places;
}

}  // namespace

std::vector<fs::path> TruthAround(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return {};
  const fs::path around = fs::weakly_canonical(folder, error);
  std::map<fs::path, fs::path> found;  // by where they really are
  for (const fs::path& place : PlacesOfTruth(folder)) {
    if (!fs::exists(place, error)) continue;
    const fs::path real = fs::weakly_canonical(place, error);
    const auto [end, rest] = std::mismatch(around.begin(), around.end(), real.begin(), real.end());
    if (end != around.end()) found.try_emplace(real, place);
  }
  std::vector<fs::path> truth;
  for (const auto& [real, place] : found) truth.push_back(place);
  return truth;
}

StereoRecording ReadRecording(const fs::path& folder, DatasetFormat format) {
  if (!fs::is_directory(folder)) throw InputError(folder.string(), 0, "no such folder");
  if (format == DatasetFormat::kTum) {
    throw InputError("a TUM folder is monocular or RGB-D; stereo recordings are euroc or kitti");
  }
  StereoRecording recording =
      format == DatasetFormat::kEuroc ? ReadEuroc(folder) : ReadKitti(folder);
  if (recording.pairs.empty())
    throw InputError(folder.string(), 0, "no stereo pairs in this folder");
  recording.read_image = [pairs = recording.pairs](std::size_t pair, int side) {
    return ReadGreyPng(side == 0 ? pairs.at(pair).left : pairs.at(pair).right);
  };
  return recording;
}

}  // namespace aisle
