#include "simulator/calibration/stereo_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "tests/support/arbitrary.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A rig as built, written down in every dialect by this file alone.
struct Rig {
  cv::Matx33d k1{458.654, 0, 367.215, 0, 457.296, 248.375, 0, 0, 1};
  cv::Matx33d k2{457.587, 0, 379.999, 0, 456.134, 255.238, 0, 0, 1};
  std::vector<double> d1 = {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05};
  std::vector<double> d2 = {-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05};
  Eigen::Isometry3d T_right_left = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_body_left = Eigen::Isometry3d::Identity();
  cv::Matx33d r1, r2;
  cv::Matx34d p1, p2;
  cv::Size size{752, 480};
  bool equidistant = false;

  Rig() {
    T_right_left.linear() = (Eigen::AngleAxisd(0.007, Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(-0.014, Eigen::Vector3d::UnitY()))
                                .toRotationMatrix();
    T_right_left.translation() << -0.110074, 0.000399, -0.000853;
    T_body_left.linear() = Eigen::AngleAxisd(1.55, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T_body_left.translation() << -0.0216, -0.0647, 0.0098;
    Rectify();
  }

  void Rectify() {
    cv::Matx33d rotation;
    cv::Vec3d shift;
    cv::eigen2cv(Eigen::Matrix3d(T_right_left.linear()), rotation);
    cv::eigen2cv(Eigen::Vector3d(T_right_left.translation()), shift);
    cv::Matx44d q;
    if (equidistant) {
      cv::fisheye::stereoRectify(k1, d1, k2, d2, size, rotation, shift, r1, r2, p1, p2, q,
                                 cv::CALIB_ZERO_DISPARITY, size);
    } else {
      cv::stereoRectify(k1, d1, k2, d2, size, rotation, shift, r1, r2, p1, p2, q,
                        cv::CALIB_ZERO_DISPARITY, 0);
    }
  }
};

/// Through fisheyes, whose third and fourth coefficients would be a radtan lens's tilt.
Rig Fisheyes() {
  Rig rig;
  rig.equidistant = true;
  rig.d1 = {-0.0134, 0.0207, -0.0127, 0.0025};
  rig.d2 = {-0.0145, 0.0221, -0.0139, 0.0027};
  rig.Rectify();
  return rig;
}

template <class Numbers>
std::string List(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}
template <int m, int n>
std::string List(const cv::Matx<double, m, n>& matrix) {
  return List(std::vector<double>(matrix.val, matrix.val + m * n));
}
std::string List(const Eigen::Isometry3d& motion, bool nested) {
  std::vector<std::string> rows;
  for (int row = 0; row < 4; ++row) {
    std::vector<double> numbers;
    for (int column = 0; column < 4; ++column) numbers.push_back(motion.matrix()(row, column));
    rows.push_back(nested ? List(numbers) : fmt::format("{}", fmt::join(numbers, ", ")));
  }
  return fmt::format("[{}]", fmt::join(rows, ", "));
}

class StereoModelTest : public testing::Test {
 protected:
  StereoModelTest()
      : folder_(fs::temp_directory_path() / fmt::format("aisle_calibration_{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~StereoModelTest() override { fs::remove_all(folder_); }

  std::string Put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

  std::string KalibrCamera(const char* name, const cv::Matx33d& k,
                           const std::vector<double>& d) const {
    return fmt::format(
        "{}:\n  camera_model: pinhole\n  intrinsics: {}\n  distortion_model: {}\n"
        "  distortion_coeffs: {}\n  resolution: [752, 480]\n  rostopic: /{}/image_raw\n",
        name, List(std::vector{k(0, 0), k(1, 1), k(0, 2), k(1, 2)}),
        rig_.equidistant ? "equidistant" : "radtan", List(d), name);
  }
  std::vector<std::string> Kalibr() const {
    return {Put("camchain.yaml", KalibrCamera("cam0", rig_.k1, rig_.d1) +
                                     KalibrCamera("cam1", rig_.k2, rig_.d2) +
                                     "  T_cn_cnm1: " + List(rig_.T_right_left, true) + "\n")};
  }
  /// Each camera's place by the IMU's, which here is the body.
  std::vector<std::string> KalibrWithImu() const {
    const Eigen::Isometry3d T_left_imu = rig_.T_body_left.inverse();
    const Eigen::Isometry3d T_right_imu = rig_.T_right_left * T_left_imu;
    return {Put("camchain-imucam.yaml", KalibrCamera("cam0", rig_.k1, rig_.d1) +
                                            "  T_cam_imu: " + List(T_left_imu, true) + "\n" +
                                            KalibrCamera("cam1", rig_.k2, rig_.d2) +
                                            "  T_cam_imu: " + List(T_right_imu, true) + "\n")};
  }
  std::vector<std::string> Euroc() const {
    const auto sensor = [&](const char* name, const cv::Matx33d& k, const std::vector<double>& d,
                            const Eigen::Isometry3d& T_body_camera) {
      return Put(name,
                 fmt::format("%YAML:1.0\n---\nsensor_type: camera\nT_BS:\n  cols: 4\n"
                             "  rows: 4\n  data: {}\nresolution: [752, 480]\n"
                             "camera_model: pinhole\nintrinsics: {}\n"
                             "distortion_model: {}\ndistortion_coefficients: {}\n",
                             List(T_body_camera, false),
                             List(std::vector{k(0, 0), k(1, 1), k(0, 2), k(1, 2)}),
                             rig_.equidistant ? "equidistant" : "radial-tangential", List(d)));
    };
    return {sensor("cam0.yaml", rig_.k1, rig_.d1, rig_.T_body_left),
            sensor("cam1.yaml", rig_.k2, rig_.d2, rig_.T_body_left * rig_.T_right_left.inverse())};
  }
  std::vector<std::string> CameraInfo() const {
    const auto info = [&](const char* name, const cv::Matx33d& k, std::vector<double> d,
                          const cv::Matx33d& r, const cv::Matx34d& p) {
      if (!rig_.equidistant) d.push_back(0);
      return Put(
          name, fmt::format("image_width: 752\nimage_height: 480\ncamera_name: {}\n"
                            "camera_matrix:\n  rows: 3\n  cols: 3\n  data: {}\n"
                            "distortion_model: {}\ndistortion_coefficients:\n  rows: 1\n"
                            "  cols: {}\n  data: {}\nrectification_matrix:\n  rows: 3\n  cols: 3\n"
                            "  data: {}\nprojection_matrix:\n  rows: 3\n  cols: 4\n  data: {}\n",
                            name, List(k), rig_.equidistant ? "equidistant" : "plumb_bob", d.size(),
                            List(d), List(r), List(p)));
    };
    return {info("left.yaml", rig_.k1, rig_.d1, rig_.r1, rig_.p1),
            info("right.yaml", rig_.k2, rig_.d2, rig_.r2, rig_.p2)};
  }
  std::vector<std::string> OpenCv() const {
    const auto write = [&](const char* name,
                           const std::vector<std::pair<std::string, cv::Mat>>& all) {
      const std::string file = (folder_ / name).string();
      cv::FileStorage storage(file, cv::FileStorage::WRITE);
      for (const auto& [key, matrix] : all) storage << key << matrix;
      return file;
    };
    cv::Matx33d rotation;
    cv::Vec3d shift;
    cv::eigen2cv(Eigen::Matrix3d(rig_.T_right_left.linear()), rotation);
    cv::eigen2cv(Eigen::Vector3d(rig_.T_right_left.translation()), shift);
    return {write("intrinsics.yml", {{"M1", cv::Mat(rig_.k1)},
                                     {"D1", cv::Mat(rig_.d1)},
                                     {"M2", cv::Mat(rig_.k2)},
                                     {"D2", cv::Mat(rig_.d2)}}),
            write("extrinsics.yml", {{"R", cv::Mat(rotation)},
                                     {"T", cv::Mat(shift)},
                                     {"R1", cv::Mat(rig_.r1)},
                                     {"R2", cv::Mat(rig_.r2)},
                                     {"P1", cv::Mat(rig_.p1)},
                                     {"P2", cv::Mat(rig_.p2)}})};
  }
  std::vector<std::string> Kitti() const {
    const auto row = [](const char* name, const cv::Matx34d& p) {
      return fmt::format("{}: {}\n", name, fmt::join(p.val, p.val + 12, " "));
    };
    return {Put("calib.txt", row("P0", rig_.p1) + row("P1", rig_.p2))};
  }
  std::string WhyNot(const std::vector<std::string>& files) const {
    try {
      ReadStereoModel(files);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  Rig rig_;
  const fs::path folder_;
};

TEST_F(StereoModelTest, FiveDialectsProjectAPointToTheSamePixel) {
  for (const auto& files : {Kalibr(), Euroc(), CameraInfo(), OpenCv(), Kitti()}) {
    const RectifiedPair pair = Rectified(ReadStereoModel(files));
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(0.3, -0.2, 1.5), Eigen::Vector3d(-4, 2, 9), Eigen::Vector3d(10, 1, 40)}) {
      for (int side = 0; side < 2; ++side) {
        const cv::Matx34d& p = side == 0 ? rig_.p1 : rig_.p2;
        const cv::Vec3d expected = p * cv::Vec4d(point.x(), point.y(), point.z(), 1);
        const double x = point.x() - side * pair.baseline_m;
        EXPECT_NEAR(pair.fx * x / point.z() + pair.cx, expected[0] / expected[2], 1e-9) << files[0];
        EXPECT_NEAR(pair.fy * point.y() / point.z() + pair.cy, expected[1] / expected[2], 1e-9)
            << files[0];
      }
    }
  }
}

TEST_F(StereoModelTest, CamerasAsBuiltAreReadAsWritten) {
  for (const auto& files : {Kalibr(), Euroc(), CameraInfo(), OpenCv()}) {
    const StereoModel model = ReadStereoModel(files);
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(0.3, -0.2, 1.5), Eigen::Vector3d(-1, 1, 4)}) {
      const auto pixel = [&](const cv::Matx33d& k, const std::vector<double>& d) {
        std::vector<cv::Point2d> pixels;
        cv::projectPoints(std::vector<cv::Point3d>{{point.x(), point.y(), point.z()}}, cv::Vec3d(),
                          cv::Vec3d(), k, d, pixels);
        return pixels[0];
      };
      const auto own = [](const CameraModel& c) {
        return cv::Matx33d(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
      };
      EXPECT_LT(cv::norm(pixel(own(model.left), model.left.distortion) - pixel(rig_.k1, rig_.d1)),
                1e-9);
      EXPECT_LT(cv::norm(pixel(own(model.right), model.right.distortion) - pixel(rig_.k2, rig_.d2)),
                1e-9);
    }
  }
}

/// The same by cv::fisheye, whose model is Kalibr's equidistant one.
TEST_F(StereoModelTest, FisheyesAreReadAndRectifiedAsTheyAreWritten) {
  rig_ = Fisheyes();
  for (const auto& files : {Kalibr(), KalibrWithImu(), Euroc(), CameraInfo()}) {
    const StereoModel model = ReadStereoModel(files);
    EXPECT_TRUE(model.left.equidistant && model.right.equidistant) << files[0];
    EXPECT_EQ(model.left.distortion, rig_.d1) << files[0];
    EXPECT_EQ(model.right.distortion, rig_.d2) << files[0];
    const RectifiedPair pair = Rectified(model);
    EXPECT_NEAR(pair.fx, rig_.p1(0, 0), 1e-9) << files[0];
    EXPECT_NEAR(pair.fy, rig_.p1(1, 1), 1e-9) << files[0];
    EXPECT_NEAR(pair.cx, rig_.p1(0, 2), 1e-9) << files[0];
    EXPECT_NEAR(pair.cy, rig_.p1(1, 2), 1e-9) << files[0];
    EXPECT_NEAR(pair.baseline_m, rig_.T_right_left.translation().norm(), 1e-9) << files[0];
  }
}

TEST_F(StereoModelTest, TwoCamerasPlacesByTheImuAreTheirPlacesToEachOther) {
  const StereoModel model = ReadStereoModel(KalibrWithImu());
  EXPECT_TRUE(model.T_right_left.isApprox(rig_.T_right_left, 1e-9));
}

/// Any two cameras of about one kind, side by side, turned a little against each other.
Rig AnyRig() {
  Rig rig;
  for (cv::Matx33d* k : {&rig.k1, &rig.k2}) {
    (*k)(0, 0) = AnyNumberIn(300, 900);
    (*k)(1, 1) = (*k)(0, 0) * AnyNumberIn(0.98, 1.02);
    (*k)(0, 2) = AnyNumberIn(340, 410);
    (*k)(1, 2) = AnyNumberIn(210, 270);
  }
  for (std::vector<double>* d : {&rig.d1, &rig.d2}) {
    *d = {AnyNumberIn(-0.3, 0.3), AnyNumberIn(-0.1, 0.1), AnyNumberIn(-1e-3, 1e-3),
          AnyNumberIn(-1e-3, 1e-3)};
  }
  const auto turn = [] { return AnyNumberIn(-0.02, 0.02); };
  rig.T_right_left.linear() = (Eigen::AngleAxisd(turn(), Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(turn(), Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(turn(), Eigen::Vector3d::UnitZ()))
                                  .toRotationMatrix();
  rig.T_right_left.translation() << -AnyNumberIn(0.05, 2), AnyNumberIn(-1e-3, 1e-3),
      AnyNumberIn(-1e-3, 1e-3);
  rig.T_body_left = AnyPose(1);
  rig.Rectify();
  return rig;
}

TEST_F(StereoModelTest, AnyRigIsReadAsWritten) {
  EXPECT_TRUE(rc::check([this] {
    rig_ = AnyRig();
    for (const auto& files : {Kalibr(), Euroc(), CameraInfo(), OpenCv()}) {
      const StereoModel model = ReadStereoModel(files);
      const std::pair<const CameraModel*, const cv::Matx33d*> cameras[] = {
          {&model.left, &rig_.k1}, {&model.right, &rig_.k2}};
      for (const auto& [camera, k] : cameras) {
        RC_ASSERT(camera->fx == (*k)(0, 0) && camera->fy == (*k)(1, 1));
        RC_ASSERT(camera->cx == (*k)(0, 2) && camera->cy == (*k)(1, 2));
        const std::vector<double>& lens = k == &rig_.k1 ? rig_.d1 : rig_.d2;
        RC_ASSERT(std::equal(lens.begin(), lens.end(), camera->distortion.begin()));
      }
      if (model.stated && files[0].ends_with("left.yaml")) continue;  // it says no more than that
      RC_ASSERT(model.T_right_left.isApprox(rig_.T_right_left, 1e-12));
    }
    for (const auto& files : {CameraInfo(), OpenCv(), Kitti()}) {
      const RectifiedPair pair = Rectified(ReadStereoModel(files));
      RC_ASSERT(pair.fx == rig_.p1(0, 0) && pair.cy == rig_.p1(1, 2));
      RC_ASSERT(std::abs(pair.baseline_m + rig_.p2(0, 3) / rig_.p2(0, 0)) < 1e-12);
    }
  }));
}

TEST_F(StereoModelTest, TwoFilesWrongWayRoundAreNamed) {
  std::vector<std::string> euroc = Euroc(), info = CameraInfo();
  std::swap(euroc[0], euroc[1]);
  EXPECT_THAT(WhyNot(euroc), HasSubstr("swapped"));
  std::swap(info[0], info[1]);
  EXPECT_THAT(WhyNot(info), HasSubstr("swapped"));
}

TEST_F(StereoModelTest, MillimetresAreNamed) {
  Rig millimetres = rig_;
  millimetres.T_right_left.translation() *= 1000;
  const std::string file = Kalibr()[0];
  std::ifstream stream(file);
  std::string text((std::istreambuf_iterator<char>(stream)), {});
  const std::size_t at = text.find("  T_cn_cnm1");
  text = text.substr(0, at) + "  T_cn_cnm1: " + List(millimetres.T_right_left, true) + "\n";
  EXPECT_THAT(WhyNot({Put("mm.yaml", text)}), HasSubstr("millimetres"));
}

/// A sign too many in a row keeps the columns square to each other; no camera sees a mirrored
/// world.
TEST_F(StereoModelTest, TurnsThatMirrorAreNamed) {
  const Rig good = rig_;
  rig_.T_right_left.linear().row(1) *= -1;
  EXPECT_THAT(WhyNot(Kalibr()), AllOf(HasSubstr("cam1.T_cn_cnm1"), HasSubstr("mirrors")));
  EXPECT_THAT(WhyNot(OpenCv()), AllOf(HasSubstr(": R: "), HasSubstr("mirrors")));
  rig_ = good;
  rig_.T_body_left.linear().row(1) *= -1;
  EXPECT_THAT(WhyNot(Euroc()), AllOf(HasSubstr("T_BS"), HasSubstr("mirrors")));
  rig_ = good;
  for (int column = 0; column < 3; ++column) rig_.r2(1, column) *= -1;
  EXPECT_THAT(WhyNot(CameraInfo()), AllOf(HasSubstr("rectification_matrix"), HasSubstr("mirrors")));
  EXPECT_THAT(WhyNot(OpenCv()), AllOf(HasSubstr("R2"), HasSubstr("mirrors")));
}

/// Both eyes of what is rendered have one pinhole, as recordings of such a rig are rectified.
TEST_F(StereoModelTest, WhereTheEyesPinholesDifferItIsTheLeftOnes) {
  const double baseline_m = -rig_.p2(0, 3) / rig_.p2(0, 0);
  rig_.p2(0, 2) -= 20;
  for (const auto& files : {CameraInfo(), OpenCv(), Kitti()}) {
    const RectifiedPair pair = Rectified(ReadStereoModel(files));
    EXPECT_EQ(pair.cx, rig_.p1(0, 2)) << files[0];
    EXPECT_NEAR(pair.baseline_m, baseline_m, 1e-9) << files[0];
  }
}

TEST_F(StereoModelTest, WhatIsNoneIsNamedWithWhatIsRead) {
  EXPECT_THAT(WhyNot({Put("other.yaml", "a: 1\n")}), HasSubstr("camchain"));
  EXPECT_THAT(WhyNot({(folder_ / "none.yaml").string()}), HasSubstr("no such file"));
  EXPECT_THAT(WhyNot({Put("bad.yaml", "a: [1\n")}), HasSubstr("not YAML"));
  EXPECT_THAT(WhyNot({Put("omni.yaml", "cam0: {camera_model: omni}\ncam1: {}\n")}),
              HasSubstr("pinhole is read"));
  EXPECT_THAT(WhyNot({Put("short.yaml", "cam0: {camera_model: pinhole, intrinsics: [1, 2]}\n")}),
              HasSubstr("expected 4 numbers"));
}

/// A text with a part of it replaced.
std::string Changed(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

std::string TextOf(const std::string& file) {
  std::ifstream stream(file);
  return {(std::istreambuf_iterator<char>(stream)), {}};
}

/// Windows' editors set it before UTF-8.
TEST_F(StereoModelTest, AByteOrderMarkChangesNothing) {
  for (const auto& files : {Kalibr(), Euroc(), CameraInfo(), OpenCv(), Kitti()}) {
    const RectifiedPair plain = Rectified(ReadStereoModel(files));
    for (const std::string& file : files) {
      Put(fs::path(file).filename().string(), "\xef\xbb\xbf" + TextOf(file));
    }
    const RectifiedPair marked = Rectified(ReadStereoModel(files));
    EXPECT_EQ(marked.fx, plain.fx) << files[0];
    EXPECT_EQ(marked.cx, plain.cx) << files[0];
    EXPECT_EQ(marked.baseline_m, plain.baseline_m) << files[0];
  }
}

/// An alias may stand for its own list, or for 10^9 numbers.
TEST_F(StereoModelTest, AliasesHaveNoEnd) {
  EXPECT_THAT(WhyNot({Put("own.yaml", "cam0: {camera_model: pinhole, intrinsics: &a [*a]}\n")}),
              AllOf(HasSubstr("own.yaml:1:"), HasSubstr("not allowed")));
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 9; ++i) {
    bomb +=
        fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i, i - 1);
  }
  bomb += "cam0: {camera_model: pinhole, intrinsics: *a8}\n";
  EXPECT_THAT(WhyNot({Put("bomb.yaml", bomb)}), HasSubstr("bomb.yaml:1:"));
  EXPECT_THAT(WhyNot({Put("twice.yaml", "cam0: {}\ncam0: {}\n")}),
              HasSubstr("twice.yaml:2:1: cam0: duplicate key"));
}

TEST_F(StereoModelTest, NumbersWithoutEndAreRefused) {
  std::string many;
  for (int i = 0; i < 65; ++i) many += "1,";
  const std::string text =
      Changed(TextOf(Kalibr()[0]), "distortion_coeffs: [", "distortion_coeffs: [" + many);
  EXPECT_THAT(WhyNot({Put("many.yaml", text)}), HasSubstr("cam0.distortion_coeffs: expected"));
}

TEST_F(StereoModelTest, WhatIsNoRegularFileIsNamed) {
  EXPECT_THAT(WhyNot({"/dev/zero"}), HasSubstr("is a device"));
  EXPECT_THAT(WhyNot({folder_.string()}), HasSubstr("is a folder"));
}

TEST_F(StereoModelTest, SizesThatNoImageHasAreNamed) {
  const std::string text = TextOf(Kalibr()[0]);
  for (const char* size : {"[-640, 480]", "[0, 0]", "[20000, 100]", "[320.7, 200]"}) {
    EXPECT_THAT(WhyNot({Put("size.yaml", Changed(text, "[752, 480]", size))}),
                AllOf(HasSubstr("size.yaml: cam0.resolution:"), HasSubstr("not an image size")))
        << size;
  }
  std::vector<std::string> info = CameraInfo();
  Put("left.yaml", Changed(TextOf(info[0]), "image_width: 752", "image_width: 0"));
  EXPECT_THAT(WhyNot(info), HasSubstr("left.yaml: image_width"));
}

TEST_F(StereoModelTest, AMotionsLastRowIsOne) {
  const std::string text = TextOf(Kalibr()[0]);
  const std::size_t row = text.rfind('[');
  EXPECT_THAT(WhyNot({Put("row.yaml", text.substr(0, row) + "[9, 9, 9, 9]]\n")}),
              AllOf(HasSubstr("cam1.T_cn_cnm1"), HasSubstr("0 0 0 1")));
}

TEST_F(StereoModelTest, AKittiRowIsTwelveNumbersOnce) {
  const std::string p0 = "P0: 185 0 156 0 0 185 107 0 0 0 1 0\n";
  EXPECT_EQ(WhyNot({Put("k.txt", p0 + "P1: 185 0 156 -18.5 0 185 107 0 0 0 1 0\r\n")}), "");
  EXPECT_THAT(WhyNot({Put("k.txt", p0 + "P1: 185 0 156 -18.5 0 185 107 0 0 0 1 0 junk 7\n")}),
              AllOf(HasSubstr("k.txt: P1:"), HasSubstr("'junk'")));
  EXPECT_THAT(WhyNot({Put("k.txt", p0 + "P1: 185 0 156 -18.5 0 185 107 0\nP1: 0 0 1 0\n")}),
              AllOf(HasSubstr("k.txt: P1:"), HasSubstr("duplicate row")));
}

/// OpenCV's own exception is none of std::runtime_error's.
TEST_F(StereoModelTest, WhatCannotBeRectifiedIsARuntimeError) {
  StereoModel model = ReadStereoModel(Kalibr());
  model.left.distortion = {0.1, 0.1, 0.1};  // OpenCV has no such lens
  EXPECT_THROW(Rectified(model), std::runtime_error);
}

}  // namespace
}  // namespace aisle::sim
