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
#include "harness/plugs/wheel_odometry.h"

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
    EXPECT_NE(
        std::string(error.what()).find("has 100x100 pixels, but the calibration is for 320x240"),
        std::string::npos)
        << error.what();
  }
  std::array<Camera, 2> mixed = Parallel();
  mixed[1].model = "equidistant";
  Write(mixed, {{Noise(1), Noise(2)}});
  EXPECT_THROW(OpenRecording(folder_, DatasetFormat::kEuroc), InputError);
}

/// What rectifies them would be as large as the calibration claims.
TEST_F(Recording, IsNotRectifiedBeforeItsImagesFit) {
  std::array<Camera, 2> bent = Parallel();
  bent[0].bend = bent[1].bend = {-0.2, 0.05, 0, 0};
  Write(bent, {{cv::Mat1b(100, 100, std::uint8_t{9}), Noise(2)}});
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
  EXPECT_THAT(complaint({}), HasSubstr("is 0 m to the right"));
  std::array<Camera, 2> blind = Parallel();
  blind[1].fx = 0;
  EXPECT_THAT(complaint(blind), HasSubstr("intrinsics 0, 200"));
}

TEST_F(Recording, WhoseStampsDoNotRiseIsRefused) {
  Write(Parallel(), {{Noise(1), Noise(2)}, {Noise(3), Noise(4)}});
  StereoRecording recording = ReadRecording(folder_, DatasetFormat::kEuroc);
  std::swap(recording.pairs[0].stamp_ns, recording.pairs[1].stamp_ns);
  EXPECT_THROW(MakeRecordedSequence(recording, "a recording", "name"), InputError);
  recording.pairs[1].stamp_ns = recording.pairs[0].stamp_ns;
  EXPECT_THROW(MakeRecordedSequence(recording, "a recording", "name"), InputError);
}

/// OpenCV leaves the eyes' principal points apart unless it is told CALIB_ZERO_DISPARITY: what the
/// rectified pictures say of depth may not depend on it.
TEST(StatedRectificationTest, DepthIsRightWhereThePrincipalPointsDiffer) {
  const cv::Matx33d camera(200, 0, 160, 0, 200, 120, 0, 0, 1);
  const Eigen::Matrix3d R_right_left =
      Eigen::AngleAxisd(0.06, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Vector3d t_right_left(-0.12, 0, 0), point_m(0.3, -0.2, 4);
  cv::Matx33d rotation;
  cv::Vec3d shift;
  cv::eigen2cv(R_right_left, rotation);
  cv::eigen2cv(t_right_left, shift);
  std::array<Camera, 2> eyes;
  eyes[1].T_body_camera.linear() = R_right_left.transpose();
  eyes[1].T_body_camera.translation() = -(R_right_left.transpose() * t_right_left);
  std::array<cv::Mat1b, 2> pair;
  for (std::size_t side = 0; side < 2; ++side) {
    pair[side] = cv::Mat1b::zeros(kHeight, kWidth);
    Dot(eyes[side], point_m, &pair[side]);
  }
  for (const int flags : {0, static_cast<int>(cv::CALIB_ZERO_DISPARITY)}) {
    cv::Matx33d turn[2];
    cv::Matx34d projection[2];
    cv::Matx44d to_depth;
    const cv::Mat straight = cv::Mat::zeros(1, 4, CV_64F);
    cv::stereoRectify(camera, straight, camera, straight, {kWidth, kHeight}, rotation, shift,
                      turn[0], turn[1], projection[0], projection[1], to_depth, flags, 1);
    StereoRecording recording;
    std::array<StatedRectification, 2> stated;
    for (int side = 0; side < 2; ++side) {
      auto& one = side == 0 ? recording.cameras.left : recording.cameras.right;
      one.width = kWidth;
      one.height = kHeight;
      one.fx = one.fy = 200;
      one.cx = 160;
      one.cy = 120;
      cv::cv2eigen(cv::Mat(turn[side]), stated[static_cast<std::size_t>(side)].R_rectified_camera);
      cv::cv2eigen(cv::Mat(projection[side]), stated[static_cast<std::size_t>(side)].projection);
    }
    EXPECT_EQ(projection[0](0, 2) == projection[1](0, 2), flags != 0) << "the case in question";
    recording.cameras.stated = stated;
    recording.pairs.push_back({kStart_ns, "left", "right"});
    recording.read_image = [&](std::size_t, int side) { return pair[side == 0 ? 0 : 1]; };
    const auto sequence = MakeRecordedSequence(recording, "spot", "spot");
    const StereoFrame frame = sequence->At(sequence->Schedule().front()).images;
    const StereoCalibration rig = sequence->calibration();
    const double disparity = CentreOf(frame.left).x - CentreOf(frame.right).x;
    const Eigen::Vector3d rectified = stated[0].R_rectified_camera * point_m;
    EXPECT_NEAR(rig.fx * rig.baseline_m / disparity, rectified.z(), 0.05) << flags;
  }
}

/// Why a recording that states its rectification is none; empty where it is one.
std::string WhyNot(double focal_px, double centre_px, double baseline_m) {
  StereoRecording recording;
  std::array<StatedRectification, 2> stated;
  for (std::size_t side = 0; side < 2; ++side) {
    CameraCalibration& camera = side == 0 ? recording.cameras.left : recording.cameras.right;
    camera.width = kWidth;
    camera.height = kHeight;
    camera.fx = camera.fy = 200;
    stated[side].projection.diagonal() << focal_px, focal_px, 1;
    stated[side].projection(0, 2) = stated[side].projection(1, 2) = centre_px;
  }
  stated[1].projection(0, 3) = -focal_px * baseline_m;
  recording.cameras.stated = stated;
  recording.pairs.push_back({kStart_ns, "left", "right"});
  recording.read_image = [](std::size_t, int) { return Noise(1); };
  try {
    MakeRecordedSequence(recording, "a recording", "name");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StatedRectificationTest, IsThatOfACameraWithinItsBounds) {
  constexpr double kMore = 1 + 1e-9, kNone = std::numeric_limits<double>::quiet_NaN();
  for (const double focal_px : {0.1, 200.0, 1e6}) EXPECT_EQ(WhyNot(focal_px, 160, 0.1), "");
  for (const double centre_px : {-1e6, 0.0, 1e6}) EXPECT_EQ(WhyNot(200, centre_px, 0.1), "");
  for (const double baseline_m : {1e-6, 0.1, 1e8 / kMore}) {
    EXPECT_EQ(WhyNot(200, 160, baseline_m), "") << baseline_m;
  }
  for (const double focal_px : {0.1 / kMore, 0.0, -200.0, 1e6 * kMore, kNone}) {
    EXPECT_THAT(WhyNot(focal_px, 160, 0.1),
                testing::AllOf(HasSubstr("a recording: according to its calibration"),
                               HasSubstr("expected pixels, 0.1 to 1e+06")))
        << focal_px;
  }
  for (const double centre_px : {-1e6 * kMore, 1e6 * kMore, kNone}) {
    EXPECT_THAT(WhyNot(200, centre_px, 0.1), HasSubstr("and the principal point")) << centre_px;
  }
  for (const double baseline_m : {-0.1, 0.0, 1e8 * kMore, kNone}) {
    EXPECT_THAT(WhyNot(200, 160, baseline_m),
                HasSubstr("which must be greater than 0 and at most 1e+08"))
        << baseline_m;
  }
  EXPECT_THAT(WhyNot(200, 160, -0.1), testing::EndsWith(": left and right are swapped"));
}

/// Wheels that were recorded beside the images come before those that truth would imply.
TEST_F(Recording, BringsItsOwnWheels) {
  const std::vector<std::array<cv::Mat1b, 2>> pairs(3, {Noise(1), Noise(2)});
  Write(Parallel(), pairs);
  EXPECT_FALSE(OpenRecording(folder_, DatasetFormat::kEuroc)->ReadWheels());
  fs::create_directories(folder_ / "mav0/odom0");
  const auto wheels = [&](std::int64_t late_ns) {
    std::ofstream rows(folder_ / "mav0/odom0/data.csv");
    for (int i = 0; i < 3; ++i) {  // of the left camera, z ahead
      rows << kStart_ns + late_ns + 50'000'000LL * i << ",0,0," << 0.04 * i << ",1,0,0,0\n";
    }
  };
  wheels(0);
  const auto motions = OpenRecording(folder_, DatasetFormat::kEuroc)->ReadWheels();
  ASSERT_TRUE(motions && motions->size() == 2);
  for (const auto& motion : *motions) {
    ASSERT_TRUE(motion);
    EXPECT_LT((motion->T_now_before.translation() - Eigen::Vector3d(0, 0, -0.04)).norm(), 1e-9);
    // Surest of what the wheels measure: the way ahead, and less so of what they cannot see.
    EXPECT_LT(motion->covariance(2, 2), motion->covariance(1, 1));
  }
  wheels(3600'000'000'000);
  EXPECT_THROW(OpenRecording(folder_, DatasetFormat::kEuroc)->ReadWheels(), InputError);
}

/// The same drive laid out both ways: its wheels say the same of it.
TEST_F(Recording, OfKittiRollsOnTheSameFloorAsOfEuroc) {
  std::vector<Eigen::Isometry3d> truth;
  for (int i = 0; i < 5; ++i) {
    Eigen::Isometry3d body = Eigen::Isometry3d::Identity();
    body.rotate(Eigen::AngleAxisd(0.03 * i, Eigen::Vector3d::UnitZ()));
    body.translation() << 0.06 * i, 0.002 * i * i, 0;
    truth.push_back(body * CameraAhead());
  }
  Write(Parallel(), {truth.size(), {Noise(1), Noise(2)}}, truth);
  const fs::path sequence = folder_ / "kitti/sequences/00";
  std::ofstream calibration, times, poses;
  for (const char* camera : {"image_0", "image_1"}) fs::create_directories(sequence / camera);
  fs::create_directories(folder_ / "kitti/poses");
  calibration.open(sequence / "calib.txt");
  for (int c = 0; c < 4; ++c) {
    calibration << fmt::format("P{}: 200 0 160 {} 0 200 120 0 0 0 1 0\n", c, -22 * (c % 2));
  }
  times.open(sequence / "times.txt");
  poses.open(folder_ / "kitti/poses/00.txt");
  for (std::size_t i = 0; i < truth.size(); ++i) {
    times << fmt::format("{:.3f}\n", 0.05 * static_cast<double>(i));
    const Eigen::Matrix4d T_first_now = (truth[0].inverse() * truth[i]).matrix();
    for (int k = 0; k < 12; ++k) poses << fmt::format("{} ", T_first_now(k / 4, k % 4));
    poses << "\n";
    for (const char* camera : {"image_0", "image_1"}) {
      WriteImage(sequence / camera / fmt::format("{:06}.png", i), Noise(1));
    }
  }
  for (std::ofstream* file : {&calibration, &times, &poses}) file->close();
  const auto euroc = MeasureByWheels(*OpenRecording(folder_, DatasetFormat::kEuroc), 3);
  const auto kitti = MeasureByWheels(*OpenRecording(folder_ / "kitti", DatasetFormat::kKitti), 3);
  ASSERT_EQ(euroc.size(), kitti.size());
  for (std::size_t i = 0; i < euroc.size(); ++i) {
    ASSERT_TRUE(euroc[i] && kitti[i]);
    EXPECT_TRUE(euroc[i]->T_now_before.isApprox(kitti[i]->T_now_before, 1e-6)) << i;
  }
}

}  // namespace
}  // namespace aisle
