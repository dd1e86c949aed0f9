#include "harness/plugs/recorded_sequence.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/contract/pinhole.h"
#include "harness/contract/rigid.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/plugs/wheel_motion.h"

namespace aisle {
namespace {

cv::Matx33d CameraMatrix(const CameraCalibration& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

bool IsIdeal(const CameraCalibration& camera) {
  // An equidistant lens without coefficients is not a pinhole.
  return !camera.equidistant && std::all_of(camera.distortion.begin(), camera.distortion.end(),
                                            [](double coefficient) { return coefficient == 0; });
}

/// Parallel cameras of one pinhole, the right one straight to the right.
bool IsRectified(const CameraCalibration& left, const CameraCalibration& right) {
  constexpr double kTolerance = 1e-9;
  const Eigen::Isometry3d T_left_right = left.T_body_camera.inverse() * right.T_body_camera;
  const bool parallel = T_left_right.linear().isIdentity(kTolerance) &&
                        T_left_right.translation().tail<2>().norm() < kTolerance;
  return parallel && IsIdeal(left) && IsIdeal(right) && left.fx == right.fx &&
         left.fy == right.fy && left.cx == right.cx && left.cy == right.cy;
}

/// Brings one camera's images onto the common plane.
struct Rectifier {
  cv::Mat map_x, map_y;  ///< empty: the image is good as it is
  cv::Mat1b operator()(const cv::Mat1b& image) const {
    if (map_x.empty()) return image;
    cv::Mat1b rectified;
    cv::remap(image, rectified, map_x, map_y, cv::INTER_LINEAR);
    return rectified;
  }
};

struct Rectification {
  StereoCalibration calibration;
  Rectifier left, right;
  /// Rotation from the rectified left camera to the left camera as built.
  Eigen::Matrix3d R_left_rectified = Eigen::Matrix3d::Identity();
};

Rectification Identity(const CameraCalibration& left, const CameraCalibration& right) {
  Rectification result;
  result.calibration = {
      .width = left.width,
      .height = left.height,
      .fx = left.fx,
      .fy = left.fy,
      .cx = left.cx,
      .cy = left.cy,
      .baseline_m = (left.T_body_camera.inverse() * right.T_body_camera).translation().x()};
  return result;
}

Rectifier MapsOf(const CameraCalibration& camera, const cv::Matx33d& turn,
                 const cv::Matx34d& projection) {
  const cv::Size size(camera.width, camera.height);
  Rectifier maps;
  if (camera.equidistant) {
    cv::fisheye::initUndistortRectifyMap(CameraMatrix(camera), camera.distortion, turn, projection,
                                         size, CV_32FC1, maps.map_x, maps.map_y);
  } else {
    cv::initUndistortRectifyMap(CameraMatrix(camera), camera.distortion, turn, projection, size,
                                CV_32FC1, maps.map_x, maps.map_y);
  }
  return maps;
}

/// As the recording itself says, both onto the left one's pinhole: where the stated principal
/// points differ (as without OpenCV's CALIB_ZERO_DISPARITY), disparities would be off by that.
Rectification RectifyAsStated(const StereoCameras& cameras) {
  const auto& [left, right] = *cameras.stated;
  Rectification result;
  result.calibration = {.width = cameras.left.width,
                        .height = cameras.left.height,
                        .fx = left.projection(0, 0),
                        .fy = left.projection(1, 1),
                        .cx = left.projection(0, 2),
                        .cy = left.projection(1, 2),
                        .baseline_m = -right.projection(0, 3) / right.projection(0, 0)};
  cv::Matx34d projection;
  cv::eigen2cv(left.projection, projection);
  const auto maps = [&](const CameraCalibration& camera, const StatedRectification& stated) {
    cv::Matx33d turn;
    cv::eigen2cv(stated.R_rectified_camera, turn);
    return MapsOf(camera, turn, projection);
  };
  result.left = maps(cameras.left, left);
  result.right = maps(cameras.right, right);
  result.R_left_rectified = left.R_rectified_camera.transpose();
  return result;
}

Rectification Rectify(const StereoCameras& cameras) {
  if (cameras.stated) return RectifyAsStated(cameras);
  const CameraCalibration &left = cameras.left, &right = cameras.right;
  if (IsRectified(left, right)) return Identity(left, right);
  const Eigen::Isometry3d T_right_left = right.T_body_camera.inverse() * left.T_body_camera;
  cv::Matx33d rotation, left_turn, right_turn;
  cv::Vec3d translation;
  cv::eigen2cv(Eigen::Matrix3d(T_right_left.linear()), rotation);
  cv::eigen2cv(Eigen::Vector3d(T_right_left.translation()), translation);
  cv::Matx34d left_projection, right_projection;
  cv::Matx44d to_depth;
  const cv::Size size(left.width, left.height);
  if (left.equidistant) {
    cv::fisheye::stereoRectify(CameraMatrix(left), left.distortion, CameraMatrix(right),
                               right.distortion, size, rotation, translation, left_turn, right_turn,
                               left_projection, right_projection, to_depth,
                               cv::CALIB_ZERO_DISPARITY, size);
  } else {
    cv::stereoRectify(CameraMatrix(left), left.distortion, CameraMatrix(right), right.distortion,
                      size, rotation, translation, left_turn, right_turn, left_projection,
                      right_projection, to_depth, cv::CALIB_ZERO_DISPARITY, 0);
  }
  Rectification result;
  result.calibration = {.width = size.width,
                        .height = size.height,
                        .fx = left_projection(0, 0),
                        .fy = left_projection(1, 1),
                        .cx = left_projection(0, 2),
                        .cy = left_projection(1, 2),
                        .baseline_m = -right_projection(0, 3) / right_projection(0, 0)};
  result.left = MapsOf(left, left_turn, left_projection);
  result.right = MapsOf(right, right_turn, right_projection);
  Eigen::Matrix3d R_rectified_left;
  cv::cv2eigen(cv::Mat(left_turn), R_rectified_left);
  result.R_left_rectified = R_rectified_left.transpose();
  return result;
}

void CheckSize(const cv::Mat1b& image, const std::filesystem::path& file, int width, int height) {
  if (image.cols == width && image.rows == height) return;
  throw InputError(file.string(), 0,
                   fmt::format("has {}x{} pixels, but the calibration is for {}x{}", image.cols,
                               image.rows, width, height));
}

class RecordedSequence : public Sequence {
 public:
  RecordedSequence(StereoRecording recording, std::string name)
      : recording_(std::move(recording)), name_(std::move(name)) {
    const cv::Mat1b first = recording_.read_image(0, 0);
    for (CameraCalibration* camera : {&recording_.cameras.left, &recording_.cameras.right}) {
      if (camera->width == 0) {  // KITTI's calibration does not say
        camera->width = first.cols;
        camera->height = first.rows;
      }
    }
    // Before the maps: they are as large as the calibration says.
    CheckSize(first, recording_.pairs.front().left, recording_.cameras.left.width,
              recording_.cameras.left.height);
    rectification_ = Rectify(recording_.cameras);
    T_body_rig_ = recording_.cameras.left.T_body_camera;
    T_body_rig_.linear() = T_body_rig_.linear() * rectification_.R_left_rectified;
    for (const StampedPose& pose : recording_.truth) truth_by_stamp_[pose.stamp_ns] = pose;
  }

  std::string name() const override { return name_; }
  StereoCalibration calibration() const override { return rectification_.calibration; }

  double rate_hz() const override {
    if (recording_.pairs.size() < 2) return 0;
    const auto span_ns =
        static_cast<double>(recording_.pairs.back().stamp_ns - recording_.pairs.front().stamp_ns);
    return span_ns > 0 ? static_cast<double>(recording_.pairs.size() - 1) * 1e9 / span_ns : 0;
  }

  std::vector<FrameRequest> Schedule() const override {
    std::vector<FrameRequest> schedule;
    for (std::size_t i = 0; i < recording_.pairs.size(); ++i) {
      const std::int64_t stamp_ns = recording_.pairs[i].stamp_ns;
      const auto pose = TruthAt(stamp_ns);
      schedule.push_back({static_cast<std::int64_t>(i), stamp_ns,
                          pose.value_or(Eigen::Isometry3d::Identity()), pose.has_value()});
    }
    return schedule;
  }

  SequenceFrame At(const FrameRequest& request) const override {
    const auto index = static_cast<std::size_t>(request.id);
    if (index >= recording_.pairs.size() || recording_.pairs[index].stamp_ns != request.stamp_ns) {
      throw std::invalid_argument("a recording has no frame at this time");
    }
    SequenceFrame frame;
    frame.images = {request.id, request.stamp_ns, rectification_.left(Read(index, 0)),
                    rectification_.right(Read(index, 1))};
    if (const auto pose = TruthAt(request.stamp_ns)) {
      frame.truth.emplace();
      frame.truth->T_world_rig = *pose;
    }
    return frame;
  }

  std::optional<WheelMotions> ReadWheels() const override {
    if (!recording_.read_wheels) return std::nullopt;
    std::vector<std::int64_t> stamps_ns;
    for (const StereoRecording::Pair& pair : recording_.pairs) stamps_ns.push_back(pair.stamp_ns);
    Eigen::Isometry3d T_left_rig = Eigen::Isometry3d::Identity();
    T_left_rig.linear() = rectification_.R_left_rectified;
    WheelMotions motions = MotionsBetween(recording_.read_wheels(), stamps_ns, T_left_rig);
    if (std::ranges::any_of(motions, [](const auto& motion) { return motion.has_value(); })) {
      return motions;
    }
    throw InputError(name_ +
                     ": the wheel odometry does not cover the images: its timestamps are of "
                     "another clock, or more than 0.25 s apart");
  }

 private:
  cv::Mat1b Read(std::size_t index, int side) const {
    const cv::Mat1b image = recording_.read_image(index, side);
    const StereoRecording::Pair& pair = recording_.pairs[index];
    CheckSize(image, side == 0 ? pair.left : pair.right, rectification_.calibration.width,
              rectification_.calibration.height);
    return image;
  }

  /// Truth names the body; the rig is the rectified left camera.
  std::optional<Eigen::Isometry3d> TruthAt(std::int64_t stamp_ns) const {
    const auto half_frame_ns = static_cast<std::int64_t>(0.5e9 / std::max(rate_hz(), 1.0));
    const auto after = truth_by_stamp_.lower_bound(stamp_ns);
    const StampedPose* nearest = nullptr;
    std::int64_t best_ns = half_frame_ns + 1;
    const auto consider = [&](const StampedPose& pose) {
      const std::int64_t off_ns = std::abs(pose.stamp_ns - stamp_ns);
      if (off_ns < best_ns) {
        best_ns = off_ns;
        nearest = &pose;
      }
    };
    if (after != truth_by_stamp_.begin()) consider(std::prev(after)->second);
    if (after != truth_by_stamp_.end()) consider(after->second);
    if (nearest == nullptr) return std::nullopt;
    return nearest->T_world_rig * T_body_rig_;
  }

  StereoRecording recording_;
  const std::string name_;
  Rectification rectification_;
  Eigen::Isometry3d T_body_rig_ = Eigen::Isometry3d::Identity();
  std::map<std::int64_t, StampedPose> truth_by_stamp_;
};

/// Of the common plane: a pinhole in pixels, and depth comes from the baseline, to the right.
void CheckRectified(const StereoCalibration& rig, const std::string& source) {
  if (!IsPinhole(rig.fx, rig.fy, rig.cx, rig.cy)) {
    throw InputError(
        source, 0,
        fmt::format("according to its calibration the rectified camera has the focal lengths {:g} "
                    "and {:g} and the principal point {:g} {:g}: expected pixels, {:g} to {:g} and "
                    "within {:g} of the image's corner",
                    rig.fx, rig.fy, rig.cx, rig.cy, kLeastFocal_px, kFarthest_px, kFarthest_px));
  }
  if (rig.baseline_m > 0 && rig.baseline_m <= kFarthest_m) return;
  throw InputError(
      source, 0,
      fmt::format("according to its calibration the right camera is {:g} m to the right of the "
                  "left one, which must be greater than 0 and at most {:g}{}",
                  rig.baseline_m, kFarthest_m,
                  rig.baseline_m < 0 ? ": left and right are swapped" : ""));
}

/// Systems are promised that stamps rise.
void CheckStamps(const std::vector<StereoRecording::Pair>& pairs, const std::string& source) {
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    if (pairs[i].stamp_ns > pairs[i - 1].stamp_ns) continue;
    throw InputError(
        source, 0,
        fmt::format("pair {} has the timestamp {} ns after one of {} ns: timestamps must increase",
                    i, pairs[i].stamp_ns, pairs[i - 1].stamp_ns));
  }
}

}  // namespace

std::unique_ptr<Sequence> MakeRecordedSequence(StereoRecording recording, const std::string& source,
                                               const std::string& name) {
  const StereoCameras& cameras = recording.cameras;
  if (cameras.left.width != cameras.right.width || cameras.left.height != cameras.right.height) {
    throw InputError(source, 0, "the two cameras differ in size");
  }
  if (cameras.left.equidistant != cameras.right.equidistant) {
    throw InputError(source, 0, "the two cameras differ in their distortion model");
  }
  for (const CameraCalibration* camera : {&cameras.left, &cameras.right}) {
    if (camera->fx > 0 && camera->fy > 0) continue;
    throw InputError(
        source, 0,
        fmt::format(
            "its calibration has focal lengths {:g} and {:g}: they must be positive, in pixels",
            camera->fx, camera->fy));
  }
  CheckStamps(recording.pairs, source);
  auto sequence = std::make_unique<RecordedSequence>(std::move(recording), name);
  CheckRectified(sequence->calibration(), source);
  return sequence;
}

std::unique_ptr<Sequence> OpenRecording(const std::filesystem::path& folder, DatasetFormat format) {
  const auto clean = std::filesystem::absolute(folder).lexically_normal();
  const auto name = clean.has_filename() ? clean.filename() : clean.parent_path().filename();
  return MakeRecordedSequence(ReadRecording(folder, format), folder.string(), name.string());
}

std::unique_ptr<Sequence> OpenBagRecording(const std::filesystem::path& file,
                                           const BagRecordingOptions& options) {
  return MakeRecordedSequence(ReadBagRecording(file, options), file.string(), file.stem().string());
}

}  // namespace aisle
