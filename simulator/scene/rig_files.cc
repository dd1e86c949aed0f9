#include "simulator/scene/rig_files.h"

#include <filesystem>
#include <fstream>

#include "simulator/calibration/stereo_model.h"
#include "simulator/common/byte_order_mark.h"
#include "simulator/common/decimal.h"
#include "simulator/common/input_file.h"
#include "simulator/common/printable.h"
#include "simulator/scene/check_poses.h"
#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPoses = 1'000'000;
constexpr std::uintmax_t kMostPoseBytes = 256 << 20;

std::string Resolved(const Scene& scene, Mark mark, const std::string& name) {
  const auto index = static_cast<std::size_t>(mark.file);
  const std::string& from = index < scene.files.size() ? scene.files[index] : scene.file;
  return (fs::path(from).parent_path() / name).lexically_normal().string();
}

// --- Calibration ---------------------------------------------------------------------------------

/// Which of a pair's numbers no scene could say itself, or "".
std::string BeyondRanges(const RectifiedPair& pair) {
  struct Held {
    const char* name;
    double value;
    Range range;
  };
  for (const auto& [name, value, range] : std::initializer_list<Held>{
           {"width in pixels", static_cast<double>(pair.width), kCameraRanges.size_px},
           {"height in pixels", static_cast<double>(pair.height), kCameraRanges.size_px},
           {"focal length fx in pixels", pair.fx, kCameraRanges.focal_px},
           {"focal length fy in pixels", pair.fy, kCameraRanges.focal_px},
           {"principal point cx in pixels", pair.cx, kCameraRanges.center_px},
           {"principal point cy in pixels", pair.cy, kCameraRanges.center_px},
           {"baseline in metres", pair.baseline_m, kCameraRanges.baseline_m}}) {
    if (range.Holds(value)) continue;
    return fmt::format("the rectified pair's {} is {:g}; expected {:g} to {:g}", name, value,
                       range.low, range.high);
  }
  return "";
}

/// The rectified pair of a rig; `size_px` where the files do not say it. Throws std::exception,
/// whose text names the file.
RectifiedPair PairOf(const std::vector<std::string>& files, const std::array<int, 2>& size_px) {
  StereoModel model = ReadStereoModel(files);
  if (model.left.width == 0) {  // OpenCV's and KITTI's files do not say it
    model.left.width = size_px[0];
    model.left.height = size_px[1];
  }
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("{}: {}", files[0], why));
  };
  RectifiedPair pair;
  try {
    pair = Rectified(model);
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
  if (const std::string wrong = BeyondRanges(pair); !wrong.empty()) fail(wrong);
  return pair;
}

/// What a calibration makes of a pair's cameras; `key` is for the messages.
void ReadCalibration(const CalibrationSpec& named, const std::string& key, CameraSpec* camera,
                     Scene* scene, Issues* issues) {
  if (named.left.empty()) {
    if (named.right.empty()) return;
    issues->Add(named.right_mark, key + "_right", "the left camera's calibration is missing");
    return;
  }
  std::vector<std::string> files = {Resolved(*scene, named.left_mark, named.left)};
  if (!named.right.empty()) files.push_back(Resolved(*scene, named.right_mark, named.right));
  try {
    const RectifiedPair pair = PairOf(files, camera->size_px);
    camera->size_px = {pair.width, pair.height};
    camera->focal_px = {pair.fx, pair.fy};
    camera->center_px = {pair.cx, pair.cy};
    camera->baseline_m = pair.baseline_m;
    camera->distortion = Distortion::kNone;
    scene->files.insert(scene->files.end(), files.begin(), files.end());
  } catch (const std::exception& error) {  // a library may throw anything of odd numbers
    issues->Add(named.left_mark, key, error.what());
  }
}

// --- Trajectory ----------------------------------------------------------------------------------

/// What is wrong with a line of a TUM file, or nothing.
std::string TakePose(const std::string& line, std::vector<TimedPose>* poses) {
  constexpr std::size_t kMostBytes = 4096;
  if (line.size() > kMostBytes) return fmt::format("a line of {} bytes is not a pose", line.size());
  const std::vector<std::string_view> words = WordsOf(line);
  const auto expected = [](const std::string& but) {
    return "expected 'seconds tx ty tz qx qy qz qw', got " + but;
  };
  if (words.size() != 8) return expected(fmt::format("{} fields", words.size()));
  const std::optional<std::int64_t> time_ns = NanosecondsOf(words[0]);
  if (!time_ns) return expected(fmt::format("the time '{}'", Printable(words[0])));
  std::array<double, 7> n{};
  for (std::size_t i = 0; i < n.size(); ++i) {
    const std::optional<double> number = DecimalOf(words[i + 1]);
    if (!number) return expected(fmt::format("'{}'", Printable(words[i + 1])));
    n[i] = *number;
  }
  const Eigen::Quaterniond turn(n[6], n[3], n[4], n[5]);
  constexpr double kTolerance = 0.05;
  if (!(std::abs(turn.norm() - 1) < kTolerance)) return "the quaternion is not a rotation";
  if (!poses->empty() && poses->back().time_ns >= *time_ns) return "times must increase";
  if (poses->size() >= kMostPoses) return "too many poses";
  TimedPose pose{*time_ns, Eigen::Isometry3d::Identity()};
  pose.T_world_body.linear() = turn.normalized().toRotationMatrix();
  pose.T_world_body.translation() << n[0], n[1], n[2];
  poses->push_back(pose);
  return "";
}

std::string ReadPoses(const std::string& file, std::vector<TimedPose>* poses) {
  if (std::string wrong = InputFileError(file, kMostPoseBytes); !wrong.empty()) return wrong;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return file + ": cannot be read";
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (number == 1) line = std::string(WithoutByteOrderMark(line));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::string wrong = TakePose(line, poses);
    if (!wrong.empty()) return fmt::format("{}:{}: {}", file, number, wrong);
  }
  return poses->empty() ? file + ": no poses" : "";
}

void ReadTrajectory(Scene* scene, const BagPoseReader& bags, Issues* issues) {
  RigSpec& rig = scene->rig;
  const auto [name, topic] = SplitBagTopic(rig.trajectory);
  const std::string file = Resolved(*scene, rig.trajectory_mark, name);
  const auto add = [&](const std::string& what) {
    issues->Add(rig.trajectory_mark, "rig.trajectory", what);
  };
  const std::string wrong = topic.empty() ? ReadPoses(file, &rig.poses)
                                          : ReadBagPoses(bags, file + ":" + topic, &rig.poses);
  if (!wrong.empty()) return add(wrong);
  scene->files.push_back(file);
  const std::int64_t first_ns = rig.poses.front().time_ns;
  for (TimedPose& pose : rig.poses) pose.time_ns -= first_ns;
  const double lasts_s = static_cast<double>(rig.poses.back().time_ns) * 1e-9;
  const double needs_s = (scene->frames - 1) / scene->rate_hz;
  constexpr double kTolerance_s = 1e-6;
  if (needs_s > lasts_s + kTolerance_s) {
    add(fmt::format(
        "{} lasts {:.3f} s, but {} frames at {:g} Hz take {:.3f} s: use at most {} frames", file,
        lasts_s, scene->frames, scene->rate_hz, needs_s,
        static_cast<int>(lasts_s * scene->rate_hz + kTolerance_s) + 1));
  }
  const HallSpec& hall = scene->hall;
  for (const TimedPose& pose : rig.poses) {
    const Eigen::Vector3d& at = pose.T_world_body.translation();
    const bool inside = at.x() > hall.from.x() && at.x() < hall.to.x() && at.y() > hall.from.y() &&
                        at.y() < hall.to.y() && at.z() > -0.5 && at.z() < hall.height_m;
    if (inside) continue;
    return add(
        fmt::format("{} is at ({:.2f}, {:.2f}, {:.2f}) after {:.3f} s, outside the hall: its "
                    "coordinates must be the scene's, in metres with z up",
                    file, at.x(), at.y(), at.z(), static_cast<double>(pose.time_ns) * 1e-9));
  }
  if (const std::string error = PosesError(*scene); !error.empty()) {
    return add(fmt::format("{}: {}", file, error));
  }
  rig.route.plan.start = rig.poses.front().T_world_body.translation().head<2>();
}

}  // namespace

void ReadRigFiles(Scene* scene, const BagPoseReader& bags, Issues* issues) {
  RigSpec& rig = scene->rig;
  ReadCalibration(rig.calibration, "rig.calibration", &scene->camera, scene, issues);
  for (std::size_t i = 0; i < rig.pairs.size(); ++i) {
    PairSpec& pair = rig.pairs[i];
    if (!pair.has_camera) pair.camera = scene->camera;
    ReadCalibration(pair.calibration, fmt::format("rig.pairs[{}].calibration", i), &pair.camera,
                    scene, issues);
  }
  if (!rig.trajectory.empty()) ReadTrajectory(scene, bags, issues);
}

}  // namespace aisle::sim
