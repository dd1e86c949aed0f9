#include "harness/bag/bag_calibration.h"

#include "harness/contract/pinhole.h"
#include "harness/contract/rigid.h"
#include "harness/io/input_error.h"
#include "harness/ros/definition.h"
#include "harness/ros/sensor.h"

namespace aisle {
namespace {

const char* const kCalibrationCure =
    "pass the rig's own file with --calibration (Kalibr, camera_info, OpenCV or EuRoC)";

/// The first message of a topic, if there is one.
template <class T>
std::optional<T> FirstMessage(const Bag& bag, const std::string& topic, const std::string& file) {
  const std::string type = ros::FullTypeName(T::kType);
  for (const BagEntry& entry : bag.entries()) {
    const BagChannel& channel = bag.channels()[entry.channel];
    if (channel.topic != topic || channel.type != type) continue;
    try {
      return ros::Deserialize<T>(bag.Read(entry));
    } catch (const ros::CdrError& error) {
      throw InputError(file, 0, fmt::format("a message of {} {}", topic, error.what()));
    }
  }
  return std::nullopt;
}

/// Whether images are less than the whole picture. RegionOfInterest says the whole by zeros, or by
/// the camera's own size.
bool IsCutOut(const ros::CameraInfo& info) {
  const auto is_whole = [](std::uint32_t length, std::uint32_t of_camera) {
    return length == 0 || length == of_camera;
  };
  const ros::RegionOfInterest& roi = info.roi;
  return roi.x_offset > 0 || roi.y_offset > 0 || !is_whole(roi.width, info.width) ||
         !is_whole(roi.height, info.height);
}

/// Refuses what CameraInfo's field of this name states.
[[noreturn]] void Refuse(const std::string& topic, const std::string& stated,
                         const std::string& file) {
  throw InputError(file, 0, fmt::format("{} states {}: {}", topic, stated, kCalibrationCure));
}

/// Lens coefficients and rotations are held to the bound of pixels, too: theirs are far smaller.
void CheckNumbers(std::span<const double> numbers, const char* field, const std::string& topic,
                  const std::string& file) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::abs(numbers[i]) <= kFarthest_px) continue;
    Refuse(topic,
           fmt::format("{}[{}] as {:g}, which must be finite and at most {:g}", field, i,
                       numbers[i], kFarthest_px),
           file);
  }
}

void CheckFocal(double fx, double fy, const char* field, const std::string& topic,
                const std::string& file) {
  if (std::min(fx, fy) >= kLeastFocal_px) return;
  Refuse(topic,
         fmt::format("focal lengths of {:g} and {:g} pixels in {}, which must be at least {:g}", fx,
                     fy, field, kLeastFocal_px),
         file);
}

ros::CameraInfo InfoOf(const Bag& bag, const std::string& image_topic, const std::string& file) {
  const std::string topic = CameraInfoTopicOf(image_topic);
  const auto info = FirstMessage<ros::CameraInfo>(bag, topic, file);
  if (!info) {
    throw InputError(file, 0,
                     fmt::format("has no {} beside {}: {}", topic, image_topic, kCalibrationCure));
  }
  CheckNumbers(info->p, "p", topic, file);
  if (!(info->p[0] > 0) || !(info->p[5] > 0)) {
    throw InputError(
        file, 0,
        fmt::format("{} states that the camera is not calibrated (p begins with {:g}): {}", topic,
                    info->p[0], kCalibrationCure));
  }
  CheckFocal(info->p[0], info->p[5], "p", topic, file);
  if (info->binning_x > 1 || info->binning_y > 1 || IsCutOut(*info)) {
    throw InputError(
        file, 0,
        fmt::format("{} states that images are binned or cropped: {}", topic, kCalibrationCure));
  }
  return *info;
}

/// Whether a word of the topic's name says so: image_rect, image_rect_color, rectified; not
/// /direct/image, and not /unrectified/image.
bool NameSaysRectified(const std::string& topic) {
  for (std::size_t begin = 0; begin < topic.size();) {
    const std::size_t end = std::min(topic.find_first_of("/_", begin), topic.size());
    const std::string word = topic.substr(begin, end - begin);
    if (word == "rect" || word == "rectified") return true;
    begin = end + 1;
  }
  return false;
}

bool IsRectified(const ros::CameraInfo& info, const std::string& topic) {
  if (NameSaysRectified(topic)) return true;
  constexpr std::array<double, 9> kNoTurn = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return info.r == kNoTurn && std::ranges::all_of(info.d, [](double k) { return k == 0; });
}

/// T_left_right as /tf_static has it, where it joins the two frames.
std::optional<Eigen::Isometry3d> RightInLeft(const Bag& bag, const std::string& left,
                                             const std::string& right) {
  std::map<std::string, std::pair<std::string, Eigen::Isometry3d>> parents;
  for (const BagEntry& entry : bag.entries()) {
    if (bag.channels()[entry.channel].topic != "/tf_static") continue;
    try {
      for (const auto& one : ros::Deserialize<ros::TFMessage>(bag.Read(entry)).transforms) {
        parents[one.child_frame_id] = {one.header.frame_id, ros::IsometryOf(one.transform)};
      }
    } catch (const ros::CdrError&) {  // a hint only
    }
  }
  const auto in_root = [&](std::string frame) {
    Eigen::Isometry3d T_root_frame = Eigen::Isometry3d::Identity();
    for (std::size_t step = 0; step <= parents.size(); ++step) {  // a circle ends too
      const auto parent = parents.find(frame);
      if (parent == parents.end()) break;
      T_root_frame = parent->second.second * T_root_frame;
      frame = parent->second.first;
    }
    return std::pair(frame, T_root_frame);
  };
  const auto [left_root, T_root_left] = in_root(left);
  const auto [right_root, T_root_right] = in_root(right);
  if (left_root != right_root || left == right) return std::nullopt;
  return T_root_left.inverse() * T_root_right;
}

/// What is wrong with a baseline that is not positive, and its cure.
std::string BaselineFault(const Bag& bag, const ros::CameraInfo& left, const ros::CameraInfo& right,
                          const StereoTopics& topics, double baseline_m) {
  std::string fault =
      baseline_m == 0
          ? fmt::format("{} states no baseline: p[3] is 0, but should be -fx times the baseline",
                        CameraInfoTopicOf(topics.right))
          : fmt::format(
                "{} states a baseline of {:g} m: p[3] should be -fx times the baseline, but is "
                "positive",
                CameraInfoTopicOf(topics.right), baseline_m);
  if (left.p[3] < 0 && right.p[3] == 0) {
    return fault +
           fmt::format(
               "; the other one has it: left and right are swapped, use --topic {} --topic {}",
               topics.right, topics.left);
  }
  if (const auto T_left_right = RightInLeft(bag, left.header.frame_id, right.header.frame_id)) {
    fault += fmt::format("; its /tf_static places the right camera {:g} m to the right",
                         T_left_right->translation().x());
  }
  return fault + fmt::format(": use --baseline METRES, or {}", kCalibrationCure);
}

CameraCalibration PinholeOf(const ros::CameraInfo& info, const std::array<double, 4>& pinhole) {
  CameraCalibration camera;
  camera.width = static_cast<int>(std::min<std::uint32_t>(info.width, 16384));
  camera.height = static_cast<int>(std::min<std::uint32_t>(info.height, 16384));
  camera.fx = pinhole[0];
  camera.fy = pinhole[1];
  camera.cx = pinhole[2];
  camera.cy = pinhole[3];
  return camera;
}

CameraCalibration Rectified(const ros::CameraInfo& info) {
  return PinholeOf(info, {info.p[0], info.p[5], info.p[2], info.p[6]});
}

/// As built: k and d.
CameraCalibration Raw(const ros::CameraInfo& info, const std::string& topic,
                      const std::string& file) {
  CheckNumbers(info.k, "k", CameraInfoTopicOf(topic), file);
  CheckNumbers(info.d, "d", CameraInfoTopicOf(topic), file);
  CheckFocal(info.k[0], info.k[4], "k", CameraInfoTopicOf(topic), file);
  CameraCalibration camera = PinholeOf(info, {info.k[0], info.k[4], info.k[2], info.k[5]});
  camera.equidistant = info.distortion_model == "equidistant" || info.distortion_model == "fisheye";
  const std::size_t n = info.d.size();
  const bool fits = camera.equidistant ? n == 4 : n == 0 || n == 4 || n == 5 || n == 8;
  const bool known = camera.equidistant || info.distortion_model.empty() ||
                     info.distortion_model == "plumb_bob" ||
                     info.distortion_model == "rational_polynomial";
  if (!known || !fits) {
    throw InputError(file, 0,
                     fmt::format("{}: unsupported distortion '{}' with {} coefficients; supported: "
                                 "plumb_bob (5), rational_polynomial (8) and equidistant (4)",
                                 CameraInfoTopicOf(topic), Printable(info.distortion_model), n));
  }
  camera.distortion = info.d;
  return camera;
}

void CheckStated(const StatedRectification& stated, const std::string& topic,
                 const std::string& file) {
  constexpr double kRounded = 1e-3;  // as numbers of a few digits are
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = stated.R_rectified_camera;
  if (!IsRigid(turn, kRounded)) Refuse(topic, "an r that is not a rotation", file);
  // Of another one there may be no inverse, and calibrations have no place for a skew.
  const Eigen::Matrix3d P = stated.projection.leftCols<3>();
  if (P(0, 1) != 0 || P(1, 0) != 0 || P.row(2) != Eigen::RowVector3d(0, 0, 1)) {
    Refuse(topic,
           "a p that is not a pinhole's: its first columns must be fx 0 cx, 0 fy cy and 0 0 1",
           file);
  }
}

StatedRectification StatedOf(const ros::CameraInfo& info, const std::string& topic,
                             const std::string& file) {
  StatedRectification stated;
  for (int i = 0; i < 9; ++i)
    stated.R_rectified_camera(i / 3, i % 3) = info.r[static_cast<std::size_t>(i)];
  for (int i = 0; i < 12; ++i)
    stated.projection(i / 4, i % 4) = info.p[static_cast<std::size_t>(i)];
  CheckStated(stated, CameraInfoTopicOf(topic), file);
  return stated;
}

}  // namespace

StereoCameras CamerasOfBag(const Bag& bag, const StereoTopics& topics,
                           std::optional<double> asked_baseline_m, const std::string& file) {
  const ros::CameraInfo left = InfoOf(bag, topics.left, file);
  ros::CameraInfo right = InfoOf(bag, topics.right, file);
  const double baseline_m = asked_baseline_m.value_or(-right.p[3] / right.p[0]);
  if (!(baseline_m > 0) || !std::isfinite(baseline_m)) {
    throw InputError(file, 0, BaselineFault(bag, left, right, topics, baseline_m));
  }
  StereoCameras cameras;
  if (IsRectified(left, topics.left) && IsRectified(right, topics.right)) {
    cameras.left = Rectified(left);
    cameras.right = Rectified(right);
    cameras.right.T_body_camera.translation().x() = baseline_m;
    return cameras;
  }
  if (asked_baseline_m) right.p[3] = -right.p[0] * baseline_m;
  cameras.left = Raw(left, topics.left, file);
  cameras.right = Raw(right, topics.right, file);
  cameras.stated = {StatedOf(left, topics.left, file), StatedOf(right, topics.right, file)};
  return cameras;
}

}  // namespace aisle
