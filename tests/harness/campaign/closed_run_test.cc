#include "harness/campaign/closed_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "harness/campaign/teaching.h"
#include "harness/contract/system_fault.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/loop/closed_drive.h"
#include "harness/loop/localiser.h"
#include "harness/plugs/cached_drive.h"
#include "harness/plugs/simulated_drive.h"
#include "harness/plugs/systems.h"
#include "harness/record/drive_json.h"
#include "harness/score/drive_scores.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Two metres down an aisle, past somebody who yields, with blur and a rolling shutter.
constexpr const char* kScene = R"(
about: A short drive.
frames: 80
rate_hz: 20
camera: {size_px: [320, 200], focal_px: [185, 185], center_px: [160, 105]}
sensor: {motion_blur: true, readout_ms: 8}
rig:
  start: [0, 0]
  steps: [{go: [[2, 0]], speed_mps: 0.9}]
drive: {footprint_m: [[-0.3, -0.3], [0.6, -0.3], [0.6, 0.3], [-0.3, 0.3]]}
hall: {from: [-4, -5], to: [12, 5], height_m: 5}
racks:
  - {from: [-2, 2.2], bays: 4}
  - {from: [-2, -2.2], bays: 4, goods: cartons}
stacks: [{at: [8, 0], goods: drums}]
lights: [{rows: 2, per_row: 4, height_m: 4.5}]
people:
  - name: walker
    start: [4, 1.2]
    yields: true
    yields_within_m: 3
    steps: [{go: [[4, -1.2]], speed_mps: 1}]
)";

class ClosedRunTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_closed_{}", ::getpid());
    fs::create_directories(folder_);
    std::ofstream(folder_ / "short.yaml") << kScene;
  }
  void TearDown() override { RemoveFolder(folder_); }

  std::unique_ptr<DriveScene> Open(int threads = 0) const {
    return OpenSimulatedDrive({.scene_file = (folder_ / "short.yaml").string(),
                               .scene_name = "short",
                               .assets_dir = AssetsDir().string(),
                               .seed = 1,
                               .threads = threads});
  }
  static ClosedRun Drive(const DriveScene& scene, int threads = 0,
                         const Steering& steering = {.latency_ms = 60}) {
    const auto estimator = MakeSystem(BuiltIn("plain"), scene.calibration(), {.threads = threads});
    return RunClosed(scene, *estimator, MasksFromTruth(MaskSource::kNone), steering, 1);
  }

  fs::path folder_;
};

/// The same world whose truth is rubbish.
class GarbageTruth : public DriveScene {
 public:
  explicit GarbageTruth(const DriveScene& scene) : scene_(scene) {}
  const Course& course() const override { return scene_.course(); }
  StereoCalibration calibration() const override { return scene_.calibration(); }
  double rate_hz() const override { return scene_.rate_hz(); }
  std::int64_t Stamp(std::int64_t frame) const override { return scene_.Stamp(frame); }
  Capsule ActorAt(std::size_t actor, std::int64_t time_ns) const override {
    return scene_.ActorAt(actor, time_ns);
  }
  Eigen::Isometry3d RigAt(const FloorPose& vehicle, std::int64_t stamp_ns) const override {
    return scene_.RigAt(vehicle, stamp_ns);
  }
  SequenceFrame Take(const Exposure& exposure) const override {
    SequenceFrame frame = scene_.Take(exposure);
    frame.truth->T_world_rig.translation().setConstant(static_cast<double>(exposure.id));
    frame.truth->dynamic.setTo(255);
    frame.truth->depth.setTo(0.5f);
    frame.truth->objects.clear();
    return frame;
  }

 private:
  const DriveScene& scene_;
};

TEST_F(ClosedRunTest, ArrivesAndHasTheSameBitsOnOneThreadOrManyAndWithGarbageForTruth) {
  const auto scene = Open();
  const ClosedRun run = Drive(*scene);
  EXPECT_EQ(run.result.status, RunStatus::kOk) << run.result.status_why;
  EXPECT_EQ(run.drive.track.end, DriveEnd::kArrived);
  EXPECT_NEAR(run.drive.track.samples.back().truth.position.x(), 2, 0.03);
  EXPECT_EQ(run.drive.truth_steered.end, DriveEnd::kArrived);
  EXPECT_LT(run.drive.track.frames_shown, run.drive.track.frames_due);
  EXPECT_EQ(static_cast<std::size_t>(run.drive.track.frames_shown), run.result.facts.size());

  const auto alone = Open(1);
  EXPECT_EQ(Drive(*alone, 1).drive.track, run.drive.track);
  EXPECT_EQ(Drive(GarbageTruth(*scene)).drive.track, run.drive.track);
}

TEST_F(ClosedRunTest, ATaughtWayIsDrivenByTheMapOfTheTeaching) {
  const auto scene = WithKeptFrames(Open(), FrameStore(folder_ / "led"));
  const MaskMaker masks = MasksFromTruth(MaskSource::kNone);
  const fs::path map = folder_ / "taught.map";
  const auto teach = [&] {
    const auto estimator = MakeSystem(BuiltIn("plain"), scene->calibration());
    return Teach(*scene, *estimator, masks, 1, map);
  };
  const Teaching teaching = teach();
  const TaughtCourse taught = TaughtBy(teaching, scene->course());
  // Once more, of kept frames: the same way, the same map.
  const std::string bytes = ReadFile(map);
  EXPECT_EQ(teach().poses, teaching.poses);
  EXPECT_TRUE(ReadFile(map) == bytes);

  // Kept for other drives, and not believed when it is damaged.
  const fs::path kept = folder_ / "kept", copy = folder_ / "copy.map";
  EXPECT_FALSE(ReadTeaching(kept, copy));
  KeepTeaching(teaching, map, kept);
  const auto read = ReadTeaching(kept, copy);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->poses, teaching.poses);
  EXPECT_EQ(read->T_site_slam.matrix(), teaching.T_site_slam.matrix());
  EXPECT_TRUE(ReadFile(copy) == bytes);
  WriteFileAtomically(kept / "taught.map", bytes.substr(1));
  EXPECT_FALSE(ReadTeaching(kept, copy));
  KeepTeaching(teaching, map, kept);
  WriteFileAtomically(kept / "teaching.json", R"({"schema": 1})");
  EXPECT_FALSE(ReadTeaching(kept, copy));

  const auto estimator = MakeSystem(BuiltIn("plain"), scene->calibration(), {.load_map = map});
  const Steering steering{.latency_ms = 60};
  const ClosedRun run = RunClosed(*scene, *estimator, masks, steering, 1, {}, taught);
  EXPECT_EQ(run.drive.track.end, DriveEnd::kArrived);
  EXPECT_NEAR(run.drive.track.samples.back().truth.position.x(), 2, 0.01);
  EXPECT_TRUE(DriveLogFromJson(ToJson(run.drive), "drive.json").taught);
  // It goes on in the map: there is one before its first frame.
  EXPECT_GT(run.result.estimates.front().counts.at("map_keyframes"), 2);
  // The twin that is told the truth is the one without a teaching.
  TruthLocaliser truth;
  EXPECT_EQ(run.drive.truth_steered, DriveClosed(*scene, &truth, {.steering = steering}));
}

TEST_F(ClosedRunTest, WhoSeesNothingWhileItIsLedIsTaughtNothing) {
  const auto scene = Open();
  const auto estimator = MakeSystem(BuiltIn("plain"), scene->calibration());
  const MaskMaker nothing_left = [](const SequenceFrame& frame) {
    const cv::Mat1b all(frame.images.left.size(), 255);
    return ExternalMask{all, all};
  };
  try {
    Teach(*scene, *estimator, nothing_left, 1, folder_ / "taught.map");
    ADD_FAILURE() << "taught";
  } catch (const SystemFault& fault) {
    EXPECT_EQ(fault.status, RunStatus::kLost);
    EXPECT_THAT(fault.what(), testing::HasSubstr("could not be taught"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "taught.map"));
}

TEST_F(ClosedRunTest, WhatIsWrittenIsReadBack) {
  const auto scene = Open();
  const ClosedRun run = Drive(*scene, 0, {.steered_by_truth = true});
  const DriveLog read = DriveLogFromJson(ToJson(run.drive), "drive.json");
  EXPECT_EQ(read.track, run.drive.track);
  EXPECT_EQ(read.truth_steered, run.drive.truth_steered);
  EXPECT_EQ(read.route.size(), run.drive.route.size());
  EXPECT_EQ(read.steered_by, "truth");
  // Steered by truth, and shown to the system: its twin drove the same.
  EXPECT_EQ(run.drive.track.samples.back().truth, run.drive.truth_steered.samples.back().truth);
  EXPECT_EQ(ScoreDrive(read).at("docking_error_m").value,
            ScoreDrive(run.drive).at("docking_error_m").value);
}

TEST_F(ClosedRunTest, TheOutlineOfWhatStandsIsThatOfTheScene) {
  const auto scene = Open();
  // Racks of 1.1 m depth stand with their middle 2.2 m beside the route.
  TruthLocaliser truth;
  const DriveTrack track = DriveClosed(*scene, &truth, {});
  EXPECT_NEAR(track.min_clearance_static_m, 2.2 - 0.55 - 0.3, 0.1);
  EXPECT_TRUE(track.contacts.empty());
}

TEST_F(ClosedRunTest, ASceneWithoutADriveIsRefused) {
  EXPECT_THROW(OpenSimulatedDrive({.scene_file = SceneFile("smoke/short"),
                                   .scene_name = "short",
                                   .assets_dir = AssetsDir().string()}),
               InputError);
}

}  // namespace
}  // namespace aisle
