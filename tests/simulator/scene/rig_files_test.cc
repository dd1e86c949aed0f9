#include "simulator/scene/rig_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <utility>

#include "simulator/motion/recorded_path.h"
#include "simulator/scene/load.h"
#include "simulator/scene/rig_path.h"
#include "simulator/scene/vary.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RigFilesTest : public testing::Test {
 protected:
  RigFilesTest() : folder_(fs::temp_directory_path() / fmt::format("aisle_rig_{}", ::getpid())) {
    fs::create_directories(folder_);
    Put("calib.txt",
        "P0: 200 0 180 0 0 201 120 0 0 0 1 0\nP1: 200 0 180 -20 0 201 120 0 0 0 1 0\n");
    Put("drive.txt",
        "# ours\n1700000000.000000001 1 0 0.5 0 0 0 1\n1700000000.100000001 1.5 0 0.5 0 0 0 1\n"
        "1700000002.000000001 2 1 0.5 0 0 0 1\n");
  }
  ~RigFilesTest() override { fs::remove_all(folder_); }

  std::string Put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string SceneWith(const std::string& rig, int frames = 20) const {
    return Put("scene.yaml", fmt::format("about: A rig.\nframes: {}\nrate_hz: 20\nrig: {{{}}}\n"
                                         "hall: {{from: [-5, -8], to: [20, 8]}}\n"
                                         "lights: [{{rows: 2, per_row: 3}}]\n",
                                         frames, rig));
  }
  std::string WhyNot(const std::string& rig, int frames = 20) const {
    return fmt::format("{}", fmt::join(CheckScene(SceneWith(rig, frames)), "\n"));
  }

  const fs::path folder_;
};

TEST_F(RigFilesTest, TheCalibrationDecidesTheCamera) {
  const Scene scene = LoadScene(SceneWith("calibration: calib.txt, start: [0, 0]"));
  EXPECT_EQ(scene.camera.focal_px, Eigen::Vector2d(200, 201));
  EXPECT_EQ(scene.camera.center_px, Eigen::Vector2d(180, 120));
  EXPECT_EQ(scene.camera.baseline_m, 0.1);
  EXPECT_EQ(scene.camera.size_px, (std::array<int, 2>{752, 480})) << "the file does not say";
}

TEST_F(RigFilesTest, TheTrajectoryIsReadToTheNanosecond) {
  const Scene scene = LoadScene(SceneWith("trajectory: drive.txt, trajectory_of: vehicle"));
  ASSERT_EQ(scene.rig.poses.size(), 3u);
  EXPECT_EQ(scene.rig.poses[0].time_ns, 0);
  EXPECT_EQ(scene.rig.poses[1].time_ns, 100'000'000);
  EXPECT_EQ(scene.rig.poses[2].T_world_body.translation(), Eigen::Vector3d(2, 1, 0.5));
  EXPECT_EQ(scene.rig.body, TrajectoryBody::kVehicle);
}

/// A camera that is carried along the hall at eye level, looking ahead.
std::string CarriedThrough() {
  std::string poses;
  for (int i = 0; i < 200; ++i) {
    poses += fmt::format("{:.2f} {:.3f} 0 1.2 -0.5 0.5 -0.5 0.5\n", 0.05 * i, -4 + 0.06 * i);
  }
  return poses;
}

TEST_F(RigFilesTest, ACrowdGoesRoundTheRecordedRig) {
  Put("way.txt", CarriedThrough());
  const std::string file =
      SceneWith("trajectory: way.txt}\ncrowd: {people: 5, in: [-2, -4, 12, 4]", 160);
  EXPECT_THAT(CheckScene(file), testing::ElementsAre());
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = Seeded(LoadScene(file), seed);
    const RecordedPath rig(scene.rig.poses);
    double nearest_m = 1e9;
    for (const PersonSpec& person : scene.people) {
      const Route route(person.route.plan, person.route.limits);
      for (double t = 0; t < scene.duration_s(); t += 0.05) {
        const Eigen::Isometry3d at = rig.At(std::llround(1e9 * t));
        nearest_m = std::min(nearest_m, (at.translation().head<2>() - route.At(t).position).norm());
      }
    }
    EXPECT_GT(nearest_m, 0.5) << "seed " << seed;
  }
}

TEST_F(RigFilesTest, WhoStandsInTheWayOfARecordingIsTold) {
  Put("way.txt", CarriedThrough());
  const std::string somebody = "people:\n- {name: in_the_way, start: [2, 0.1]";
  EXPECT_THAT(CheckScene(SceneWith("trajectory: way.txt}\n" + somebody, 160)),
              testing::ElementsAre(testing::AllOf(HasSubstr("people[0]"), HasSubstr("the rig"))));
}

TEST(RigFloor, IsTheVehiclesOrBelowTheCamera) {
  Scene scene;
  scene.rig.mount = {.height_m = 1, .forward_m = 0.4, .yaw_rad = 0.3};
  const RouteState at{.position = {3, 2}, .heading_rad = 0.7};
  scene.rig.route.plan.start = at.position;
  scene.rig.route.plan.heading_rad = at.heading_rad;
  const Eigen::Isometry3d camera = RigPathOf(scene)(0);
  EXPECT_TRUE(RigFloorOf(scene)(0).position.isApprox(at.position));

  Eigen::Isometry3d vehicle = Eigen::Isometry3d::Identity();
  vehicle.translation() << at.position, 0;
  vehicle.linear() = Eigen::AngleAxisd(at.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  scene.rig.poses = {{0, vehicle}};
  scene.rig.body = TrajectoryBody::kVehicle;
  EXPECT_TRUE(RigPathOf(scene)(0).isApprox(camera));
  EXPECT_TRUE(RigFloorOf(scene)(0).position.isApprox(at.position));
  EXPECT_NEAR(RigFloorOf(scene)(0).heading_rad, at.heading_rad, 1e-12);

  scene.rig.poses = {{0, camera}};
  scene.rig.body = TrajectoryBody::kCamera;
  EXPECT_TRUE(RigPathOf(scene)(0).isApprox(camera));
  EXPECT_TRUE(RigFloorOf(scene)(0).position.isApprox(camera.translation().head<2>().eval()));
  EXPECT_NEAR(RigFloorOf(scene)(0).heading_rad, at.heading_rad + 0.3, 1e-12);
}

/// A recording is of the first pair; another one stands to it as their mounts say.
TEST(RigPath, OfASecondPairOnARecordingIsWhereTheRouteWouldHaveIt) {
  const RigMount first{.height_m = 0.9, .forward_m = 0.4, .pitch_rad = 0.1, .yaw_rad = 0.2};
  const RigMount second{.height_m = 1.3,
                        .forward_m = -0.5,
                        .pitch_rad = -0.2,
                        .left_m = 0.3,
                        .yaw_rad = 2.8,
                        .roll_rad = 0.1};
  Scene scene;
  scene.rig.route.plan.steps.emplace_back().go = {{4, 0}, {4, 5}};
  scene.rig.mount = first;
  const auto recorded = RigPathOf(scene);
  scene.rig.mount = second;
  const auto expected = RigPathOf(scene);
  for (std::int64_t i = 0; i < 100; ++i) {
    scene.rig.poses.push_back({i * 50'000'000, recorded(i * 50'000'000)});
  }
  scene.rig.first_mount = first;
  const auto path = RigPathOf(scene);
  for (const TimedPose& pose : scene.rig.poses) {
    EXPECT_TRUE(path(pose.time_ns).isApprox(expected(pose.time_ns), 1e-9)) << pose.time_ns;
  }
}

TEST_F(RigFilesTest, ARecordingHasNeitherBumpsNorSteering) {
  for (const char* key : {"bumps: [{at_s: 1}]", "jerk_mps3: 2", "curvature_rate_per_m_s: 1",
                          "lateral_jerk_mps3: 1", "start: [0, 0]"}) {
    const std::string name = std::string(key).substr(0, std::string(key).find(':'));
    EXPECT_THAT(WhyNot(fmt::format("trajectory: drive.txt, {}", key)),
                testing::AllOf(HasSubstr("scene.yaml:4:"), HasSubstr("rig." + name + ":")));
  }
}

TEST_F(RigFilesTest, TheirFilesAreTheScenes) {
  const std::string file =
      SceneWith("calibration: calib.txt, trajectory: drive.txt, trajectory_of: vehicle");
  const std::vector<std::string> files = SceneFiles(file);
  EXPECT_THAT(files, testing::ElementsAre(file, (folder_ / "calib.txt").string(),
                                          (folder_ / "drive.txt").string()));
  EXPECT_EQ(LoadScene(file).files, files);
}

/// A scene that extends another gives some of the files, which lie beside it; the rest lies beside
/// the one that is extended.
TEST_F(RigFilesTest, EachIsMeantFromTheFolderOfTheFileThatNamesIt) {
  fs::create_directories(folder_ / "above");
  fs::create_directories(folder_ / "below");
  for (const char* name : {"calib.txt", "drive.txt"}) {
    fs::rename(folder_ / name, folder_ / "below" / name);
  }
  SceneWith("calibration: calib.txt");
  fs::rename(folder_ / "scene.yaml", folder_ / "below/base.yaml");
  fs::rename(folder_ / "below/drive.txt", folder_ / "above/drive.txt");
  const std::string above = (folder_ / "above").string(), below = (folder_ / "below").string();
  const std::string file =
      Put("above/s.yaml",
          "extend: ../below/base\nrig: {trajectory: drive.txt, trajectory_of: vehicle}\n");
  EXPECT_THAT(CheckScene(file), testing::ElementsAre());
  EXPECT_THAT(SceneFiles(file), testing::ElementsAre(file, below + "/base.yaml",
                                                     below + "/calib.txt", above + "/drive.txt"));
  Put("above/s.yaml",
      "extend: ../below/base\nrig: {trajectory: drive.txt, trajectory_of: vehicle, "
      "calibration_right: r.yaml}\n");
  EXPECT_THAT(CheckScene(file), testing::ElementsAre(HasSubstr(above + "/r.yaml")));
}

/// A drive of ten poses along x: each the quaternion "qx qy qz qw" of its index, `z_m` up.
std::string Poses(const std::function<std::string(int)>& turn, double z_m) {
  std::string poses;
  for (int i = 0; i < 10; ++i) {
    poses += fmt::format("{:.1f} {:.1f} 0 {} {}\n", 0.2 * i, 0.1 * i, z_m, turn(i));
  }
  return poses;
}

/// Level and ahead, turned to the left by `yaw_deg`, its numbers in the order "qx qy qz qw".
std::array<double, 4> Turned(double yaw_deg, bool is_camera) {
  const Eigen::Quaterniond level =
      is_camera ? Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5) : Eigen::Quaterniond::Identity();
  const Eigen::Quaterniond q(Eigen::AngleAxisd(yaw_deg * M_PI / 180, Eigen::Vector3d::UnitZ()) *
                             level);
  return {q.x(), q.y(), q.z(), q.w()};
}

TEST_F(RigFilesTest, WhoseAxesAndWhichOrderTheTurnsHaveIsSeenByHowTheRigStands) {
  const auto in_order = [](const std::array<double, 4>& q) {
    return fmt::format("{} {} {} {}", q[0], q[1], q[2], q[3]);
  };
  const auto qw_first = [](const std::array<double, 4>& q) {
    return fmt::format("{} {} {} {}", q[3], q[0], q[1], q[2]);
  };
  for (const bool is_camera : {false, true}) {
    const std::string own = is_camera ? "camera" : "vehicle",
                      other = is_camera ? "vehicle" : "camera";
    const double z_m = is_camera ? 1.2 : 0;
    const auto rig = [](const std::string& of) {
      return "trajectory: way.txt, trajectory_of: " + of;
    };
    const auto turn = [&](int i) { return Turned(40 + 2 * i, is_camera); };
    Put("way.txt", Poses([&](int i) { return in_order(turn(i)); }, z_m));
    EXPECT_EQ(WhyNot(rig(own)), "") << own;
    EXPECT_THAT(WhyNot(rig(other)), HasSubstr("trajectory_of: " + own));
    Put("way.txt", Poses([&](int i) { return qw_first(turn(is_camera ? i + 15 : i)); }, z_m));
    EXPECT_THAT(WhyNot(rig(own)), testing::AllOf(HasSubstr("way.txt"), HasSubstr("qw last")))
        << own;
  }
}

TEST_F(RigFilesTest, ACameraMayLookDownOrHangUpsideDownByItsMounting) {
  Put("way.txt", Poses([](int) { return "0 0 0 1"; }, 0));
  EXPECT_EQ(WhyNot("trajectory: way.txt, trajectory_of: vehicle, camera_pitch_deg: 60"), "");
  // The camera's own way on such a vehicle: pitched, and turned about its axis.
  for (const auto& [angles_deg, mounting] :
       {std::pair(std::array{60.0, 0.0}, "camera_pitch_deg: 60"),
        std::pair(std::array{30.0, 180.0}, "camera_pitch_deg: 30, camera_roll_deg: 180"),
        std::pair(std::array{0.0, 90.0}, "camera_roll_deg: 90")}) {
    const Eigen::Quaterniond q(
        Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5) *
        Eigen::AngleAxisd(-angles_deg[0] * M_PI / 180, Eigen::Vector3d::UnitX()) *
        Eigen::AngleAxisd(angles_deg[1] * M_PI / 180, Eigen::Vector3d::UnitZ()));
    Put("way.txt",
        Poses([&](int) { return fmt::format("{} {} {} {}", q.x(), q.y(), q.z(), q.w()); }, 1));
    EXPECT_EQ(WhyNot(fmt::format("trajectory: way.txt, {}", mounting)), "") << mounting;
    const bool is_usual = angles_deg[1] == 0;  // a camera that looks down by 60 degrees
    EXPECT_EQ(WhyNot("trajectory: way.txt") == "", is_usual) << mounting;
  }
}

TEST_F(RigFilesTest, ARigMayFallForAWhile) {
  const auto falling = [](int from) {
    return Poses([from](int i) { return i < from ? "0 0 0 1" : "1 0 0 0"; }, 0);
  };
  const std::string rig = "trajectory: way.txt, trajectory_of: vehicle";
  Put("way.txt", falling(6));
  EXPECT_EQ(WhyNot(rig, 37), "");
  Put("way.txt", falling(3));
  EXPECT_THAT(WhyNot(rig, 37), HasSubstr("in 7 of 10 poses"));
  EXPECT_EQ(WhyNot(rig, 17), "") << "what comes after the scene's end is not driven";
}

TEST_F(RigFilesTest, ACameraBelowTheFloorIsTold) {
  Put("way.txt", Poses([](int) { return "-0.5 0.5 -0.5 0.5"; }, 0));
  EXPECT_THAT(WhyNot("trajectory: way.txt"),
              HasSubstr("in 5 of 5 poses the camera is on or below the floor"));
}

TEST_F(RigFilesTest, MistakesAreNamed) {
  EXPECT_THAT(WhyNot("calibration: none.yaml, start: [0, 0]"), HasSubstr("no such file"));
  EXPECT_THAT(WhyNot("trajectory: none.txt"), HasSubstr("no such file"));
  EXPECT_THAT(WhyNot("trajectory: drive.txt", 60), HasSubstr("at most 41 frames"));
  Put("far.txt", "1 100 0 0 0 0 0 1\n9 100 0 0 0 0 0 1\n");
  EXPECT_THAT(WhyNot("trajectory: far.txt"), HasSubstr("outside the hall"));
  Put("torn.txt", "1 0 0 0 0 0 0 1\n2 0 0 0\n");
  EXPECT_THAT(WhyNot("trajectory: torn.txt"), HasSubstr("torn.txt:2"));
  EXPECT_THAT(WhyNot("trajectory: drive.txt, start: [0, 0]"), HasSubstr("start"));
  EXPECT_THAT(WhyNot("start: [0, 0], calibration_right: calib.txt"), HasSubstr("left camera"));
}

std::string KalibrFile(const std::string& intrinsics, const std::string& lens) {
  std::string text;
  for (const char* name : {"cam0", "cam1"}) {
    text += fmt::format(
        "{}:\n  camera_model: pinhole\n  intrinsics: {}\n  distortion_model: {}\n"
        "  distortion_coeffs: [0, 0, 0, 0]\n  resolution: [320, 200]\n",
        name, intrinsics, lens);
  }
  return text + "  T_cn_cnm1: [[1,0,0,-0.1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]\n";
}

/// A calibration decides the camera as the scene would, within the same bounds.
TEST_F(RigFilesTest, ACalibrationMakesNoCameraThatASceneCouldNotHave) {
  const std::string rig = "calibration: c.yaml, start: [0, 0]";
  Put("c.yaml", KalibrFile("[185, 185, 156, 107]", "radtan"));
  EXPECT_EQ(WhyNot(rig), "");
  for (const char* intrinsics :
       {"[1e300, 1e300, 156, 107]", "[1e-300, 1e-300, 156, 107]", "[185, 185, 1e300, 1e300]"}) {
    for (const char* lens : {"radtan", "equidistant"}) {
      Put("c.yaml", KalibrFile(intrinsics, lens));
      EXPECT_THAT(WhyNot(rig), testing::AllOf(HasSubstr("scene.yaml:4:"), HasSubstr("/c.yaml: ")))
          << intrinsics << lens;
    }
  }
  const auto kitti = [](const char* f, const char* cx, const char* shift) {
    return fmt::format("P0: {0} 0 {1} 0 0 {0} 120 0 0 0 1 0\nP1: {0} 0 {1} {2} 0 {0} 120 0 0 0 1 0",
                       f, cx, shift);
  };
  for (const auto& [text, wrong] :
       {std::pair(kitti("19", "180", "-2"), "fx in pixels is 19; expected 20 to 10000"),
        std::pair(kitti("200", "-1", "-20"), "cx in pixels is -1; expected 0 to 4096"),
        std::pair(kitti("200", "180", "-0.2"), "baseline in metres is 0.001; expected 0.005")}) {
    Put("c.yaml", text);
    EXPECT_THAT(WhyNot(rig), testing::AllOf(HasSubstr("/c.yaml: "), HasSubstr(wrong)));
  }
}

TEST_F(RigFilesTest, StampsAreReadWhateverTheirNotation) {
  Put("way.txt",
      "\xef\xbb\xbf-1.000000000000000056e-01 1 0 0.5 0 0 0 1\r\n"
      "0.000000000000000000e+00 1.5e+00 0 0.5 0 0 0 1\r\n"
      "2.000000000000000111e-01 2 1 0.5 0 0 0 1\r\n");
  const Scene scene = LoadScene(SceneWith("trajectory: way.txt, trajectory_of: vehicle", 5));
  ASSERT_EQ(scene.rig.poses.size(), 3u);
  EXPECT_EQ(scene.rig.poses[1].time_ns, 100'000'000);
  EXPECT_EQ(scene.rig.poses[1].T_world_body.translation().x(), 1.5);
  EXPECT_EQ(scene.rig.poses[2].time_ns, 300'000'000);
}

TEST_F(RigFilesTest, WhatIsNoPoseIsNamedWithItsLine) {
  for (const char* line :
       {"2.000000000zzz 0 0 0 0 0 0 1", "2, 0 0 0 0 0 0 1", "2,5 0 0 0 0 0 0 1", "2 0-1 0 0 0 0 1",
        "2 0x1 0 0 0 0 0 1", "2 nan 0 0 0 0 0 1", "2 0 0 0 0 0 0 1 5",
        "1403636579763555584 0 0 0 0 0 0 1", "2 0 0 0 0 0 0 0"}) {
    Put("way.txt", std::string("# first\n1 0 0 0 0 0 0 1\n") + line + "\n");
    EXPECT_THAT(WhyNot("trajectory: way.txt"), HasSubstr("way.txt:3: ")) << line;
  }
  Put("way.txt", "1 0 0 0 0 0 0 1 \x1b[2J\n");
  EXPECT_THAT(WhyNot("trajectory: way.txt"), testing::Not(HasSubstr("\x1b")));
  Put("way.txt", std::string(100'000, '1'));
  EXPECT_THAT(WhyNot("trajectory: way.txt"), HasSubstr("way.txt:1: a line of 100000 bytes"));
  EXPECT_THAT(WhyNot("trajectory: ."), HasSubstr("is a folder"));
  EXPECT_THAT(WhyNot("trajectory: /dev/zero"), HasSubstr("is a device"));
}

}  // namespace
}  // namespace aisle::sim
