#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "slam/map/map_file.h"
#include "tests/slam/face/room_scene.h"

namespace aisle::slam {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFrameNs = 50'000'000;

std::vector<StereoImages> Film(const std::vector<Eigen::Isometry3d>& path) {
  std::vector<StereoImages> film;
  for (const Eigen::Isometry3d& pose : path) {
    const auto id = static_cast<std::int64_t>(film.size());
    film.push_back(RoomScene().See(id, id * kFrameNs, pose));
  }
  return film;
}

StereoImages Black(StereoImages images) {
  images.left = cv::Mat1b(images.left.size(), std::uint8_t{0});
  images.right = images.left.clone();
  return images;
}

/// Down the room, then on the spot to the back wall and all the way round to where it began.
std::vector<Eigen::Isometry3d> RoundPath() {
  std::vector<Eigen::Isometry3d> path;
  for (int i = 0; i < 24; ++i) path.push_back(PoseAt(0, 0, 0.06 * i));
  for (int i = 0; i <= 60; ++i) path.push_back(PoseAt(0.01 * i, 0, 0.6, 180 + 3.0 * i));
  for (int i = 0; i < 40; ++i) path.push_back(PoseAt(0.6 - 0.015 * i, 0, 0.6 + 0.02 * i));
  return path;
}

const std::vector<StereoImages>& RoundFilm() {
  static const std::vector<StereoImages> film = Film(RoundPath());
  return film;
}

std::string BytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class MapOfADrive : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    options.vocabulary_file = (folder / "words.voc").string();
    std::vector<cv::Mat1b> images;
    for (std::size_t i = 0; i < RoundFilm().size(); i += 5) images.push_back(RoundFilm()[i].left);
    TrainVocabulary(images, options.feature, options.vocabulary_file);
  }
  void TearDown() override { fs::remove_all(folder); }

  /// Frames [0, count) of the film, and the map they leave.
  void MapTheRoom(std::size_t count) {
    StereoSlam slam(RoomScene().camera(), options);
    for (std::size_t i = 0; i < count; ++i) slam.Track(RoundFilm()[i]);
    slam.SaveMap(map_file);
  }
  SlamOptions WithMap(bool localise_only) const {
    SlamOptions with_map = options;
    with_map.map_file = map_file;
    with_map.localise_only = localise_only;
    return with_map;
  }

  const fs::path folder =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string map_file = (folder / "room.map").string();
  SlamOptions options;
};

TEST_F(MapOfADrive, GoesOnInASavedMapAsThoughItHadNeverStopped) {
  StereoSlam first(RoomScene().camera(), options);
  for (std::size_t i = 0; i < 12; ++i) first.Track(RoundFilm()[i]);
  first.Track(Black(RoundFilm()[12]));  // a stop without sight, for both
  first.SaveMap(map_file);
  StereoSlam second(RoomScene().camera(), WithMap(false));
  for (std::size_t i = 13; i < 24; ++i) {
    const TrackedFrame a = first.Track(RoundFilm()[i]);
    const TrackedFrame b = second.Track(RoundFilm()[i]);
    ASSERT_EQ(a.state, TrackingState::kTracking) << "frame " << i;
    ASSERT_EQ(b.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_EQ(a.T_world_rig->matrix(), b.T_world_rig->matrix()) << "frame " << i;
    EXPECT_EQ(a.is_keyframe, b.is_keyframe) << "frame " << i;
  }
  first.SaveMap(map_file + ".first");
  second.SaveMap(map_file + ".second");
  EXPECT_TRUE(BytesOf(map_file + ".first") == BytesOf(map_file + ".second"));
}

TEST_F(MapOfADrive, AMapThatCannotBeWrittenCostsNothingElse) {
  StereoSlam slam(RoomScene().camera(), options);
  for (std::size_t i = 0; i < 6; ++i) slam.Track(RoundFilm()[i]);
  fs::create_directories(map_file);  // where the file ought to go
  EXPECT_THROW(slam.SaveMap(map_file), std::runtime_error);
  EXPECT_EQ(slam.Track(RoundFilm()[6]).state, TrackingState::kTracking);
  EXPECT_EQ(slam.Finish().size(), 7u);
}

TEST_F(MapOfADrive, LocaliseOnlyFindsItsWayAndLeavesTheMapAsItIs) {
  MapTheRoom(20);
  StereoSlam slam(RoomScene().camera(), WithMap(true));
  for (std::size_t i = 23; i-- > 0;) {  // the other way, and from further on
    StereoImages images = RoundFilm()[i];
    images.stamp_ns = static_cast<std::int64_t>(23 - i) * 50'000'000;
    const TrackedFrame tracked = slam.Track(images);
    ASSERT_EQ(tracked.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_LT((tracked.T_world_rig->translation() - RoundPath()[i].translation()).norm(), 0.03)
        << "frame " << i;
    EXPECT_FALSE(tracked.is_keyframe);
  }
  slam.SaveMap(map_file + ".after");
  SavedMap after = LoadMap(map_file + ".after");
  after.reference = LoadMap(map_file).reference;
  SaveMap(after, map_file + ".compared");
  EXPECT_TRUE(BytesOf(map_file + ".compared") == BytesOf(map_file));
}

TEST_F(MapOfADrive, LocaliseOnlyAwayFromTheMapIsLostAndStaysSo) {
  MapTheRoom(20);
  StereoSlam slam(RoomScene().camera(), WithMap(true));
  for (std::size_t i = 24; i < 54; ++i) {  // the back wall
    const TrackedFrame tracked = slam.Track(RoundFilm()[i]);
    EXPECT_EQ(tracked.state, TrackingState::kLost) << "frame " << i;
  }
}

/// A drive with a black-out in which the rig is carried to where it has never been.
struct Carried {
  std::vector<std::size_t> shown;  // frame of the film, by number
  std::vector<TrackedFrame> live;
  std::vector<StampedPose> final_track;
};

constexpr int kBlackFrames = 8;

Carried DriveAndBeCarried(const SlamOptions& options) {
  StereoSlam slam(RoomScene().camera(), options);
  Carried drive;
  const auto track = [&](StereoImages images) {
    images.stamp_ns = static_cast<std::int64_t>(drive.shown.size()) * kFrameNs;
    drive.shown.push_back(static_cast<std::size_t>(images.id));
    drive.live.push_back(slam.Track(images));
  };
  for (std::size_t i = 0; i < 24; ++i) track(RoundFilm()[i]);
  for (int i = 0; i < kBlackFrames; ++i) track(Black(RoundFilm()[23]));
  for (std::size_t i = 24; i < RoundFilm().size(); ++i) track(RoundFilm()[i]);
  drive.final_track = slam.Finish();
  return drive;
}

TEST_F(MapOfADrive, ALostRigMapsAnewAndJoinsTheOldMapWhereItRecognisesIt) {
  options.new_part_after_s = 0.3;
  const Carried drive = DriveAndBeCarried(options);
  int apart = 0, joined = 0;
  for (const TrackedFrame& frame : drive.live) {
    apart += frame.state == TrackingState::kApart;
    joined += frame.loop_closed;
    EXPECT_EQ(frame.T_world_rig.has_value(),
              frame.state == TrackingState::kTracking || frame.state == TrackingState::kCoasting);
  }
  EXPECT_GT(apart, 20);
  EXPECT_GE(joined, 1);
  const TrackedFrame& last = drive.live.back();
  ASSERT_EQ(last.state, TrackingState::kTracking);
  EXPECT_LT((last.T_world_rig->translation() - RoundPath().back().translation()).norm(), 0.04);

  // In the end it is one trajectory: the frames that were apart stand where they were. In the dark
  // it was thought to go on.
  EXPECT_GE(std::ssize(drive.final_track), std::ssize(drive.shown) - 2 * kBlackFrames);
  for (const StampedPose& pose : drive.final_track) {
    const auto at = static_cast<std::size_t>(pose.stamp_ns / kFrameNs);
    if (drive.live[at].state == TrackingState::kCoasting) continue;
    const std::size_t frame = drive.shown[at];
    EXPECT_LT((pose.T_world_rig.translation() - RoundPath()[frame].translation()).norm(), 0.06)
        << "frame " << frame;
  }
}

TEST_F(MapOfADrive, JoiningGivesTheSameBitsForAnyThreads) {
  options.new_part_after_s = 0.3;
  options.threads = 1;
  options.schedule.background = false;
  const Carried alone = DriveAndBeCarried(options);
  options.threads = 4;
  options.schedule.background = true;
  const Carried threaded = DriveAndBeCarried(options);
  ASSERT_EQ(alone.final_track.size(), threaded.final_track.size());
  for (std::size_t i = 0; i < alone.final_track.size(); ++i) {
    EXPECT_EQ(alone.final_track[i].T_world_rig.matrix(),
              threaded.final_track[i].T_world_rig.matrix())
        << "pose " << i;
  }
}

TEST_F(MapOfADrive, WhatIsNeverRecognisedStaysOutOfTheTrajectory) {
  options.new_part_after_s = 0.3;
  StereoSlam slam(RoomScene().camera(), options);
  for (std::size_t i = 0; i < 24; ++i) slam.Track(RoundFilm()[i]);
  for (std::size_t i = 24; i < 50; ++i) slam.Track(RoundFilm()[i]);  // the back wall at once
  EXPECT_EQ(slam.Finish().size(), 24u);
}

TEST_F(MapOfADrive, AMapServesTheCameraItWasMadeWith) {
  MapTheRoom(6);
  StereoCamera other = RoomScene().camera();
  other.baseline_m = 0.2;
  EXPECT_THROW(StereoSlam(other, WithMap(false)), std::runtime_error);
  SlamOptions finer = WithMap(false);
  finer.feature.scale = 1.3;
  EXPECT_THROW(StereoSlam(RoomScene().camera(), finer), std::runtime_error);
  SlamOptions nowhere;
  nowhere.localise_only = true;
  EXPECT_THROW(StereoSlam(RoomScene().camera(), nowhere), std::invalid_argument);
  StereoSlam empty(RoomScene().camera(), options);
  EXPECT_THROW(empty.SaveMap(map_file), std::runtime_error);
}

}  // namespace
}  // namespace aisle::slam
