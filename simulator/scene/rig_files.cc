#include "simulator/scene/rig_files.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "simulator/calibration/stereo_model.h"
#include "simulator/scene/check_poses.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPoses = 1'000'000;

std::string Resolved(const Scene& scene, Mark mark, const std::string& name) {
  const auto index = static_cast<std::size_t>(mark.file);
  const std::string& from = index < scene.files.size() ? scene.files[index] : scene.file;
  return (fs::path(from).parent_path() / name).lexically_normal().string();
}

// --- Calibration
// ---------------------------------------------------------------------------------

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
    StereoModel model = ReadStereoModel(files);
    if (model.left.width == 0) {  // OpenCV's and KITTI's files do not say it
      model.left.width = camera->size_px[0];
      model.left.height = camera->size_px[1];
    }
    const RectifiedPair pair = Rectified(model);
    camera->size_px = {pair.width, pair.height};
    camera->focal_px = {pair.fx, pair.fy};
    camera->center_px = {pair.cx, pair.cy};
    camera->baseline_m = pair.baseline_m;
    camera->distortion = Distortion::kNone;
    scene->files.insert(scene->files.end(), files.begin(), files.end());
  } catch (const std::runtime_error& error) {
    issues->Add(named.left_mark, key, error.what());
  }
}

// --- Trajectory
// ----------------------------------------------------------------------------------

/// Seconds as whole nanoseconds, digit by digit: a double near 1.6e9 holds no
/// nanoseconds.
std::optional<std::int64_t> NanosecondsOf(const std::string& text) {
  const std::size_t dot = text.find('.');
  const std::string whole = text.substr(0, dot);
  std::string part = dot == std::string::npos ? "" : text.substr(dot + 1, 9);
  if (part.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  part.resize(9, '0');
  std::int64_t seconds = 0, nanoseconds = 0;
  const auto [end, error] = std::from_chars(whole.data(), whole.data() + whole.size(), seconds);
  std::from_chars(part.data(), part.data() + part.size(), nanoseconds);
  constexpr std::int64_t kMostSeconds = 9'000'000'000;
  if (error != std::errc() || end != whole.data() + whole.size() || seconds < 0 ||
      seconds > kMostSeconds) {
    return std::nullopt;
  }
  return seconds * 1'000'000'000 + nanoseconds;
}

/// What is wrong with a line of a TUM file, or nothing.
std::string TakePose(const std::string& line, std::vector<TimedPose>* poses) {
  std::istringstream words(line);
  std::string stamp, rest;
  words >> stamp;
  std::array<double, 7> n{};
  for (double& number : n) words >> number;
  const auto time_ns = NanosecondsOf(stamp);
  if (!time_ns || !words || words >> rest) return "expected 'seconds tx ty tz qx qy qz qw'";
  const Eigen::Quaterniond turn(n[6], n[3], n[4], n[5]);
  const Eigen::Vector3d place(n[0], n[1], n[2]);
  constexpr double kTolerance = 0.05;
  if (!place.allFinite() || !(std::abs(turn.norm() - 1) < kTolerance)) {
    return "the quaternion is not a rotation, or a number is not finite";
  }
  if (!poses->empty() && poses->back().time_ns >= *time_ns) return "times must increase";
  if (poses->size() >= kMostPoses) return "too many poses";
  TimedPose pose{*time_ns, Eigen::Isometry3d::Identity()};
  pose.T_world_body.linear() = turn.normalized().toRotationMatrix();
  pose.T_world_body.translation() = place;
  poses->push_back(pose);
  return "";
}

std::string ReadPoses(const std::string& file, std::vector<TimedPose>* poses) {
  std::ifstream stream(file);
  if (!stream) return file + ": no such file";
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
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
