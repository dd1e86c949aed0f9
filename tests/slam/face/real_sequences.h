#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "slam/map/map.h"
#include "slam/stereo_slam.h"
#include "tests/support/test_data.h"

namespace aisle::slam {

/// A short recorded sequence held in memory, for tests only.
struct RealSequence {
  StereoCamera camera;
  std::vector<StereoImages> frames;
  std::vector<Eigen::Isometry3d> truth;  ///< T_world_rig where known
};

inline bool HasRealData(const std::string& folder) {
  return std::filesystem::exists(TestData(folder));
}

inline RealSequence LoadKitti06() {
  const std::filesystem::path root = TestData("kitti");
  RealSequence sequence;
  std::ifstream calib(root / "sequences/06/calib.txt");
  std::string name;
  std::vector<std::array<double, 12>> projections;
  while (calib >> name) {
    std::array<double, 12> p{};
    for (double& value : p) calib >> value;
    projections.push_back(p);
  }
  std::ifstream times(root / "sequences/06/times.txt");
  double seconds = 0;
  for (int i = 0; times >> seconds; ++i) {
    const std::string file = fmt::format("{:06d}.png", i);
    StereoImages images{i, static_cast<std::int64_t>(seconds * 1e9), {}, {}};
    images.left = cv::imread(root / "sequences/06/image_0" / file, cv::IMREAD_GRAYSCALE);
    images.right = cv::imread(root / "sequences/06/image_1" / file, cv::IMREAD_GRAYSCALE);
    if (images.left.empty()) break;
    sequence.frames.push_back(images);
  }
  const cv::Size size = sequence.frames.front().left.size();
  const auto& left = projections[0];
  sequence.camera = {
      size.width, size.height, left[0], left[5], left[2], left[6], -projections[1][3] / left[0]};
  std::ifstream poses(root / "poses/06.txt");
  for (;;) {
    Eigen::Matrix<double, 3, 4, Eigen::RowMajor> row;
    for (int i = 0; i < 12; ++i) poses >> row.data()[i];
    if (!poses) break;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.affine() = row;
    sequence.truth.push_back(pose);
  }
  return sequence;
}

/// One camera of an EuRoC rig as its sensor.yaml has it.
struct EurocCamera {
  cv::Matx33d K;
  cv::Mat distortion;
  cv::Matx44d T_body_camera;
};

/// `intrinsics: [...]` and the like, from the few lines of an EuRoC sensor.yaml that matter here.
inline EurocCamera ReadEurocCamera(const std::filesystem::path& file) {
  std::ifstream in(file);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto numbers = [&](const std::string& key, std::size_t count) {
    std::size_t at = text.find('[', text.find("\n" + key)) + 1;
    if (key == "T_BS:") at = text.find('[', text.find("data:", text.find("T_BS:"))) + 1;
    std::vector<double> values;
    while (values.size() < count) {
      std::size_t used = 0;
      while (text[at] == ',' || std::isspace(static_cast<unsigned char>(text[at]))) ++at;
      values.push_back(std::stod(text.substr(at, 40), &used));
      at += used;
    }
    return values;
  };
  const std::vector<double> k = numbers("intrinsics:", 4);
  const std::vector<double> d = numbers("distortion_coefficients:", 4);
  const std::vector<double> t = numbers("T_BS:", 16);
  return {cv::Matx33d(k[0], 0, k[2], 0, k[1], k[3], 0, 0, 1), cv::Mat(d, true).reshape(1, 1),
          cv::Matx44d(t.data())};
}

/// Turns the two cameras of an EuRoC rig parallel and equal.
class EurocRectifier {
 public:
  EurocRectifier(const EurocCamera& left, const EurocCamera& right, cv::Size size) {
    const cv::Matx44d T_right_left = right.T_body_camera.inv() * left.T_body_camera;
    const cv::Mat R(cv::Mat(T_right_left)(cv::Rect(0, 0, 3, 3)).clone());
    const cv::Mat t(cv::Mat(T_right_left)(cv::Rect(3, 0, 1, 3)).clone());
    cv::Mat R1, R2, P1, P2, Q;
    cv::stereoRectify(left.K, left.distortion, right.K, right.distortion, size, R, t, R1, R2, P1,
                      P2, Q, cv::CALIB_ZERO_DISPARITY, 0, size);
    cv::initUndistortRectifyMap(left.K, left.distortion, R1, P1, size, CV_32F, left_[0], left_[1]);
    cv::initUndistortRectifyMap(right.K, right.distortion, R2, P2, size, CV_32F, right_[0],
                                right_[1]);
    camera_ = {size.width,
               size.height,
               P1.at<double>(0, 0),
               P1.at<double>(1, 1),
               P1.at<double>(0, 2),
               P1.at<double>(1, 2),
               -P2.at<double>(0, 3) / P2.at<double>(0, 0)};
    using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
    using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    T_body_rig_ = Eigen::Map<const Matrix4>(left.T_body_camera.val);
    T_body_rig_.linear() *= Eigen::Map<const Matrix3>(R1.ptr<double>()).transpose();
  }

  const StereoCamera& camera() const { return camera_; }
  /// Where the rectified left camera sits in the body whose pose the recordings' truth gives.
  const Eigen::Isometry3d& T_body_rig() const { return T_body_rig_; }
  StereoImages Rectify(std::int64_t id, std::int64_t stamp_ns, const cv::Mat& left,
                       const cv::Mat& right) const {
    StereoImages images{id, stamp_ns, {}, {}};
    cv::remap(left, images.left, left_[0], left_[1], cv::INTER_LINEAR);
    cv::remap(right, images.right, right_[0], right_[1], cv::INTER_LINEAR);
    return images;
  }

 private:
  StereoCamera camera_;
  Eigen::Isometry3d T_body_rig_ = Eigen::Isometry3d::Identity();
  cv::Mat left_[2], right_[2];
};

inline RealSequence LoadEurocStill() {
  const std::filesystem::path root = TestData("euroc-v101-still/mav0");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(root / "cam0/data")) {
    files.push_back(entry.path().filename());
  }
  std::sort(files.begin(), files.end());
  const EurocRectifier rectifier(ReadEurocCamera(root / "cam0/sensor.yaml"),
                                 ReadEurocCamera(root / "cam1/sensor.yaml"), {752, 480});
  RealSequence sequence;
  sequence.camera = rectifier.camera();
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto stamp = static_cast<std::int64_t>(std::stoll(files[i].stem()));
    sequence.frames.push_back(
        rectifier.Rectify(static_cast<std::int64_t>(i), stamp,
                          cv::imread(root / "cam0/data" / files[i], cv::IMREAD_GRAYSCALE),
                          cv::imread(root / "cam1/data" / files[i], cv::IMREAD_GRAYSCALE)));
  }
  return sequence;
}

}  // namespace aisle::slam
