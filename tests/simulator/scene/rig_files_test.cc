#include "simulator/scene/rig_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "simulator/scene/load.h"

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

TEST_F(RigFilesTest, TheirFilesAreTheScenes) {
  const std::string file = SceneWith("calibration: calib.txt, trajectory: drive.txt");
  const std::vector<std::string> files = SceneFiles(file);
  EXPECT_THAT(files, testing::ElementsAre(file, (folder_ / "calib.txt").string(),
                                          (folder_ / "drive.txt").string()));
  EXPECT_EQ(LoadScene(file).files, files);
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

}  // namespace
}  // namespace aisle::sim
