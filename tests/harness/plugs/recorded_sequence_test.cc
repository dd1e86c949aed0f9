#include "harness/plugs/recorded_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kWidth = 320, kHeight = 240;
constexpr std::int64_t kStart_ns = 1'600'000'000'000'000'000;

struct Camera {
  double fx = 200, fy = 200, cx = 160, cy = 120;
  std::string model = "radial-tangential";
  std::array<double, 4> bend = {0, 0, 0, 0};
  Eigen::Isometry3d T_body_camera = Eigen::Isometry3d::Identity();
};

/// An EuRoC folder, written as its publication says and by nothing of ours.
class Recording : public testing::Test {
 protected:
  Recording() { fs::remove_all(folder_); }
  ~Recording() override { fs::remove_all(folder_); }

  void Write(const std::array<Camera, 2>& cameras,
             const std::vector<std::array<cv::Mat1b, 2>>& pairs,
             const std::vector<Eigen::Isometry3d>& truth = {}) {
    for (std::size_t c = 0; c < 2; ++c) {
      const fs::path cam = folder_ / "mav0" / fmt::format("cam{}", c);
      fs::create_directories(cam / "data");
      std::ofstream list(cam / "data.csv");
      list << "#timestamp [ns],filename\n";
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::int64_t stamp = kStart_ns + 50'000'000 * static_cast<std::int64_t>(i);
        list << stamp << "," << stamp << ".png\n";
        WriteImage(cam / "data" / fmt::format("{}.png", stamp), pairs[i][c]);
      }
      const Camera& camera = cameras[c];
      std::ofstream yaml(cam / "sensor.yaml");
      yaml << "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [";
      const Eigen::Matrix4d T = camera.T_body_camera.matrix();
      for (int k = 0; k < 16; ++k) yaml << (k ? ", " : "") << fmt::format("{}", T(k / 4, k % 4));
      yaml << fmt::format(
          "]\nrate_hz: 20\nresolution: [{}, {}]\ncamera_model: pinhole\n"
          "intrinsics: [{}, {}, {}, {}]\ndistortion_model: {}\n"
          "distortion_coefficients: [{}, {}, {}, {}]\n",
          kWidth, kHeight, camera.fx, camera.fy, camera.cx, camera.cy, camera.model, camera.bend[0],
          camera.bend[1], camera.bend[2], camera.bend[3]);
    }
    if (truth.empty()) return;
    const fs::path ground = folder_ / "mav0" / "state_groundtruth_estimate0";
    fs::create_directories(ground);
    std::ofstream csv(ground / "data.csv");
    csv << "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z,v_x,v_y,v_z,b,b,b,b,b,b\n";
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Eigen::Vector3d p = truth[i].translation();
      const Eigen::Quaterniond q(truth[i].linear());
      csv << fmt::format("{},{},{},{},{},{},{},{},0,0,0,0,0,0,0,0,0\n",
                         kStart_ns + 50'000'000 * static_cast<std::int64_t>(i) + 3'000'000, p.x(),
                         p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
    }
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_recorded_{}", ::getpid());
};

cv::Mat1b Noise(int seed) {
  cv::Mat1b image(kHeight, kWidth);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

std::array<Camera, 2> Parallel() {
  std::array<Camera, 2> cameras;
  cameras[1].T_body_camera.translation().x() = 0.11;
  return cameras;
}

TEST_F(Recording, OfARectifiedPairIsShownAsItIs) {
  std::vector<std::array<cv::Mat1b, 2>> pairs;
  for (int i = 0; i < 4; ++i) pairs.push_back({Noise(2 * i), Noise(2 * i + 1)});
  Write(Parallel(), pairs);
  const auto sequence = OpenRecording(folder_, DatasetFormat::kEuroc);
  EXPECT_EQ(sequence->name(), folder_.filename().string());
  EXPECT_NEAR(sequence->rate_hz(), 20, 1e-9);
  EXPECT_NEAR(sequence->calibration().baseline_m, 0.11, 1e-12);
  const auto schedule = sequence->Schedule();
  ASSERT_EQ(schedule.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(schedule[i].id, static_cast<std::int64_t>(i));
    const SequenceFrame frame = sequence->At(schedule[i]);
    EXPECT_EQ(cv::norm(frame.images.left, pairs[i][0], cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(frame.images.right, pairs[i][1], cv::NORM_INF), 0);
    EXPECT_FALSE(frame.truth.has_value()) << "nobody knows it";
    FrameRequest elsewhere = schedule[i];
    elsewhere.T_world_rig.translation().x() = 5;
    EXPECT_EQ(cv::norm(sequence->At(elsewhere).images.left, pairs[i][0], cv::NORM_INF), 0)
        << "a recording ignores the pose";
    elsewhere.stamp_ns += 1;
    EXPECT_THROW(sequence->At(elsewhere), std::invalid_argument);
  }
}

TEST_F(Recording, TruthOfTheBodyBecomesThatOfTheRig) {
  std::array<Camera, 2> cameras = Parallel();
  Eigen::Isometry3d T_body_left = Eigen::Isometry3d::Identity();
  T_body_left.linear() =
      Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, -1, 1).normalized()).toRotationMatrix();
  T_body_left.translation() = Eigen::Vector3d(0.05, 0.2, -0.1);
  for (Camera& camera : cameras) camera.T_body_camera = T_body_left * camera.T_body_camera;
  std::vector<std::array<cv::Mat1b, 2>> pairs;
  std::vector<Eigen::Isometry3d> truth;
  for (int i = 0; i < 3; ++i) {
    pairs.push_back({Noise(i), Noise(i)});
    Eigen::Isometry3d pose(Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d::UnitZ()));
    pose.translation() = Eigen::Vector3d(i, 0.5 * i, 0.1);
    truth.push_back(pose);
  }
  Write(cameras, pairs, truth);
  const auto sequence = OpenRecording(folder_, DatasetFormat::kEuroc);
  for (const FrameRequest& request : sequence->Schedule()) {
    const Eigen::Isometry3d expected = truth[static_cast<std::size_t>(request.id)] * T_body_left;
    EXPECT_TRUE(request.T_world_rig.isApprox(expected, 1e-6)) << "3 ms off is within half a frame";
    ASSERT_TRUE(sequence->At(request).truth.has_value());
    EXPECT_TRUE(sequence->At(request).truth->T_world_rig.isApprox(expected, 1e-6));
  }
}

/// A bright spot where a camera's own model has a point of the world; OpenCV's projection.
void Dot(const Camera& camera, const Eigen::Vector3d& in_body, cv::Mat1b* image) {
  const Eigen::Vector3d p = camera.T_body_camera.inverse() * in_body;
  const std::vector<cv::Point3d> points = {{p.x(), p.y(), p.z()}};
  const cv::Matx33d matrix(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<double> bend(camera.bend.begin(), camera.bend.end());
  std::vector<cv::Point2d> pixels;
  if (camera.model == "equidistant") {
    cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), matrix, bend);
  } else {
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix, bend, pixels);
  }
  cv::circle(*image, cv::Point(cvRound(256 * pixels[0].x), cvRound(256 * pixels[0].y)), 256 * 3,
             cv::Scalar(255), cv::FILLED, cv::LINE_AA, 8);
}

cv::Point2d CentreOf(const cv::Mat1b& image) {
  const cv::Moments moments = cv::moments(image);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

/// Whatever lenses and however the cameras are turned: after rectification a point of the world
/// lies where the stated pinhole has it, in the same row of both, a disparity of f·b/z apart.
TEST_F(Recording, OfBentAndTurnedCamerasIsRectified) {
  for (const std::string model : {"radial-tangential", "equidistant"}) {
    fs::remove_all(folder_);
    std::array<Camera, 2> cameras = Parallel();
    cameras[0].bend = model == "equidistant" ? std::array{0.02, -0.01, 0.003, -0.001}
                                             : std::array{-0.28, 0.07, 2e-4, 1e-4};
    cameras[1].bend = cameras[0].bend;
    cameras[1].bend[0] *= 0.9;
    cameras[1].fx = 205;
    cameras[1].cy = 124;
    for (Camera& camera : cameras) camera.model = model;
    cameras[1].T_body_camera.linear() =
        Eigen::AngleAxisd(0.03, Eigen::Vector3d(0.5, -1, 0.7).normalized()).toRotationMatrix();
    cameras[1].T_body_camera.translation() = Eigen::Vector3d(0.11, 0.002, -0.003);
    const std::vector<Eigen::Vector3d> points = {{0, 0, 2},       {-0.6, 0.4, 2},  {0.9, -0.5, 3},
                                                 {0.3, 0.6, 2.2}, {-1.0, -0.7, 4}, {0.1, 0.1, 9}};
    std::vector<std::array<cv::Mat1b, 2>> pairs;
    for (const Eigen::Vector3d& point : points) {
      std::array<cv::Mat1b, 2> pair = {cv::Mat1b(kHeight, kWidth, std::uint8_t{0}),
                                       cv::Mat1b(kHeight, kWidth, std::uint8_t{0})};
      for (std::size_t c = 0; c < 2; ++c) Dot(cameras[c], point, &pair[c]);
      pairs.push_back(pair);
    }
    Write(cameras, pairs, std::vector(points.size(), Eigen::Isometry3d::Identity()));
    const auto sequence = OpenRecording(folder_, DatasetFormat::kEuroc);
    const StereoCalibration rig = sequence->calibration();
    EXPECT_NEAR(rig.baseline_m, cameras[1].T_body_camera.translation().norm(), 1e-9);
    for (const FrameRequest& request : sequence->Schedule()) {
      const SequenceFrame frame = sequence->At(request);
      if (cv::countNonZero(frame.images.left) < 9 || cv::countNonZero(frame.images.right) < 9) {
        continue;  // beside the common picture
      }
      // The body stands at the origin: T_world_rig says where the rectified camera is.
      const Eigen::Vector3d seen =
          request.T_world_rig.inverse() * points[static_cast<std::size_t>(request.id)];
      const cv::Point2d left = CentreOf(frame.images.left), right = CentreOf(frame.images.right);
      EXPECT_NEAR(left.x, rig.fx * seen.x() / seen.z() + rig.cx, 0.25) << model;
      EXPECT_NEAR(left.y, rig.fy * seen.y() / seen.z() + rig.cy, 0.25) << model;
      EXPECT_NEAR(left.y, right.y, 0.25) << model;
      EXPECT_NEAR(left.x - right.x, rig.fx * rig.baseline_m / seen.z(), 0.25) << model;
    }
  }
}

TEST_F(Recording, OfAnImageThatDoesNotFitItsCalibrationIsRefused) {
  Write(Parallel(), {{Noise(1), Noise(2)}, {cv::Mat1b(100, 100, std::uint8_t{9}), Noise(3)}});
  const auto sequence = OpenRecording(folder_, DatasetFormat::kEuroc);
  const auto schedule = sequence->Schedule();
  EXPECT_NO_THROW(sequence->At(schedule[0]));
  try {
    sequence->At(schedule[1]);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is 100x100, the calibration says 320x240"),
              std::string::npos)
        << error.what();
  }
  std::array<Camera, 2> mixed = Parallel();
  mixed[1].model = "equidistant";
  Write(mixed, {{Noise(1), Noise(2)}});
  EXPECT_THROW(OpenRecording(folder_, DatasetFormat::kEuroc), InputError);
}

TEST_F(Recording, OfACalibrationThatIsNoneIsRefusedByName) {
  const auto complaint = [&](const std::array<Camera, 2>& cameras) -> std::string {
    Write(cameras, {{Noise(1), Noise(2)}});
    try {
      OpenRecording(folder_, DatasetFormat::kEuroc);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  std::array<Camera, 2> swapped = Parallel();
  std::swap(swapped[0], swapped[1]);
  EXPECT_THAT(complaint(swapped),
              testing::AllOf(HasSubstr(folder_.string()), HasSubstr("left and right are swapped")));
  std::array<Camera, 2> bent = swapped;  // by way of the rectification
  bent[0].bend = bent[1].bend = {-0.2, 0.05, 0, 0};
  EXPECT_THAT(complaint(bent), HasSubstr("left and right are swapped"));
  EXPECT_THAT(complaint({}), HasSubstr("stands 0 m to the right"));
  std::array<Camera, 2> blind = Parallel();
  blind[1].fx = 0;
  EXPECT_THAT(complaint(blind), HasSubstr("focal lengths 0 and 200"));
}

TEST_F(Recording, WhoseStampsDoNotRiseIsRefused) {
  Write(Parallel(), {{Noise(1), Noise(2)}, {Noise(3), Noise(4)}});
  StereoRecording recording = ReadRecording(folder_, DatasetFormat::kEuroc);
  std::swap(recording.pairs[0].stamp_ns, recording.pairs[1].stamp_ns);
  EXPECT_THROW(MakeRecordedSequence(recording, "a recording", "name"), InputError);
  recording.pairs[1].stamp_ns = recording.pairs[0].stamp_ns;
  EXPECT_THROW(MakeRecordedSequence(recording, "a recording", "name"), InputError);
}

}  // namespace
}  // namespace aisle
