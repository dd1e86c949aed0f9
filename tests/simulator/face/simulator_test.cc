#include "simulator/simulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "simulator/proof/proofs.h"
#include "simulator/scene_file.h"
#include "simulator/site.h"

namespace aisle::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";
constexpr const char* kScene = R"(about: A small hall.
frames: 3
rate_hz: 20
camera: {size_px: [192, 128], focal_px: [110, 110], center_px: [95.5, 63.5]}
rig: {start: [0, 0], steps: [{go: [[1, 0]]}], camera_height_m: 0.9, camera_forward_m: 0.4}
hall: {from: [-3, -3], to: [6, 3], height_m: 4}
columns: [{at: [4, 1]}]
lights: [{height_m: 3.8}]
)";

class SimulatorFace : public testing::Test {
 protected:
  SimulatorFace()
      : folder_(std::filesystem::temp_directory_path() / fmt::format("aisle_face_{}", ::getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~SimulatorFace() override { std::filesystem::remove_all(folder_); }

  std::string Put(const std::string& text) const {
    const std::string file = (folder_ / "scene.yaml").string();
    std::ofstream(file) << text;
    return file;
  }
  Simulator Open(const std::string& text) const {
    return Simulator::Load(Put(text), kAssets, {.light_spacing = 8, .keep_light = false});
  }

  const std::filesystem::path folder_;
};

/// The same bits, for pictures and depth with their infinities.
void ExpectSame(const cv::Mat& a, const cv::Mat& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data, b.data, a.total() * a.elemSize()), 0);
}

TEST_F(SimulatorFace, TheSceneGoesOnBehindItsLastFrame) {
  const Simulator simulator = Open(kScene);
  EXPECT_EQ(simulator.frame_count(), 3);
  EXPECT_EQ(simulator.Stamp(7), 350'000'000);
  const std::int64_t late_ns = simulator.Stamp(400);
  const Eigen::Isometry3d end = simulator.PlannedPose(late_ns);
  EXPECT_NEAR(end.translation().x(), 1.4, 1e-9) << "it stands at the end of its route";
  const RenderedFrame frame = simulator.Render(400, late_ns, end);
  EXPECT_EQ(frame.stamp_ns, late_ns);
  ExpectSame(frame.truth.depth, simulator.RenderDepth(late_ns, end));
}

TEST_F(SimulatorFace, TheFramesNumberDecidesNoiseAlone) {
  const Simulator simulator = Open(kScene);
  const Eigen::Isometry3d pose = simulator.PlannedPose(0);
  const RenderedFrame one = simulator.Render(0, 0, pose), other = simulator.Render(1, 0, pose);
  ExpectSame(one.truth.depth, other.truth.depth);
  ExpectSame(one.truth.instance, other.truth.instance);
  EXPECT_GT(cv::norm(one.left, other.left, cv::NORM_L1), 0);
}

TEST_F(SimulatorFace, RefusesWhatCannotBe) {
  const Simulator simulator = Open(kScene);
  EXPECT_FALSE(simulator.has_colour());
  EXPECT_THROW(simulator.RenderColour(0, 0, simulator.PlannedPose(0)), std::logic_error);
  EXPECT_THROW(simulator.Plan(0), std::invalid_argument);
  EXPECT_EQ(simulator.Plan(200).cols, 200);
  EXPECT_THROW(BenchRender(simulator, 0), std::invalid_argument);
  EXPECT_THROW(CheckLight(simulator, 0, 0, 2), std::invalid_argument);
  EXPECT_THROW(CheckLight(simulator, 0, 2, 0), std::invalid_argument);
  EXPECT_THROW(CheckLightChange(simulator, 0, -1, 2), std::invalid_argument);
  EXPECT_THROW(Simulator::Load(Put(kScene), kAssets, {.pair = "side", .keep_light = false}),
               std::runtime_error);
}

TEST_F(SimulatorFace, ProofsJudgeAPlannedFrameFromOutside) {
  const Simulator simulator = Open(kScene);
  EXPECT_EQ(Verify(simulator, 1).failure(), "");
  EXPECT_EQ(HashStages(simulator, 1), HashStages(simulator, 1));
  EXPECT_NE(HashStages(simulator, 1).back(), HashStages(simulator, 2).back());
  const RenderBench bench = BenchRender(simulator, 2);
  EXPECT_EQ(bench.frames, 2);
  EXPECT_GT(bench.pair_ms, 0);
  EXPECT_THAT(bench.stage_ms, testing::Contains(testing::Key("sensor")));
  const LightCheck light = CheckLight(simulator, 1, 2, 2);
  EXPECT_EQ(light.rendered.size(), cv::Size(96, 64));
  EXPECT_NEAR(light.mean_ratio, 1, 0.3);
}

TEST_F(SimulatorFace, TheSiteSaysWhereTheCameraIsOnItsVehicle) {
  const Simulator simulator = Open(kScene);
  const Site& site = simulator.site();
  EXPECT_FALSE(site.drive().there);
  EXPECT_TRUE(site.ground().things().empty()) << "nobody asked for them";
  const Eigen::Isometry3d T_world_rig = site.RigPoseAt({{2, 1}, 0}, 0);
  EXPECT_TRUE(T_world_rig.translation().isApprox(Eigen::Vector3d(2.4, 1, 0.9)));
  EXPECT_TRUE(site.Mount().translation().isApprox(Eigen::Vector3d(0.4, 0, 0.9)));
  EXPECT_TRUE(site.Mount().linear().isApprox(T_world_rig.linear()));
}

TEST_F(SimulatorFace, ASceneFileAnswersWithoutBeingBuilt) {
  EXPECT_THAT(CheckSceneFile(Put(kScene), kAssets), ElementsAre());
  const SceneInfo plain = ReadSceneInfo(Put(kScene));
  EXPECT_EQ(plain.frames, 3);
  EXPECT_FALSE(plain.drive.there);
  EXPECT_EQ(plain.hall, "");
  const std::string driven = std::string(kScene) + "drive: {height_m: 1.5}\n";
  EXPECT_TRUE(ReadSceneInfo(Put(driven)).drive.there);
  EXPECT_EQ(ReadSceneInfo(Put(driven)).drive.height_m, 1.5);
  EXPECT_THROW(ReadSceneInfo(Put("frames: many\n")), std::runtime_error);
  EXPECT_THROW(ReadSceneInfo((folder_ / "none.yaml").string()), std::runtime_error);
  EXPECT_THAT(CheckSceneFile(Put("frames: many\n")),
              testing::Contains(HasSubstr("scene.yaml:1:9: frames")));
}

/// The face hands the reader of bags to all that reads the scene.
TEST_F(SimulatorFace, ABagIsReadByWhoeverIsGiven) {
  std::string text = kScene;
  const std::string rig = "start: [0, 0], steps: [{go: [[1, 0]]}]";
  text.replace(text.find(rig), rig.size(), "trajectory: way.mcap:/odom, trajectory_of: vehicle");
  const std::string file = Put(text);
  const BagPoseReader bags = [](const std::string&) {
    std::vector<TimedPose> poses(2);
    poses[1].time_ns = 1'000'000'000;
    poses[1].T_world_body.translation().x() = 1;
    return poses;
  };
  EXPECT_THAT(CheckSceneFile(file), ElementsAre(HasSubstr("this program cannot read bags")));
  EXPECT_THROW(ReadSceneInfo(file), std::runtime_error);
  EXPECT_THROW(Simulator::Load(file, kAssets, {}), std::runtime_error);
  EXPECT_THAT(CheckSceneFile(file, kAssets, bags), ElementsAre());
  EXPECT_EQ(ReadSceneInfo(file, 1, bags).frames, 3);
  EXPECT_THAT(FilesOfScene(file, bags), testing::Contains((folder_ / "way.mcap").string()));
  EXPECT_THAT(DescribeSceneMeshes(file, bags), ElementsAre());
  EXPECT_NE(EssenceOfScene(file, Twin::kLive, bags), EssenceOfScene(file, Twin::kLive));
  const Simulator simulator =
      Simulator::Load(file, kAssets, {.light_spacing = 8, .keep_light = false, .bags = bags});
  EXPECT_NEAR(simulator.PlannedPose(1'000'000'000).translation().x(), 1.4, 1e-9);
}

}  // namespace
}  // namespace aisle::sim
