#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "tests/slam/face/room_scene.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kFrameNs = 50'000'000;

/// A textured box that crosses the view, before the room.
void DrawMover(int frame, StereoImages& images) {
  const int side = images.left.cols / 6 + frame, disparity = images.left.cols / 16;
  const int x = images.left.cols / 3 + 4 * frame, y = images.left.rows / 3 + 3 * frame;
  for (int dy = 0; dy < side; ++dy) {
    for (int dx = 0; dx < side; ++dx) {
      const auto grey = static_cast<unsigned char>(60 + 150 * Uniform(5, dx / 3, dy / 3));
      images.left(y + dy, x + dx) = grey;
      images.right(y + dy, x + dx - disparity) = grey;
    }
  }
}

/// A short drive with a mover, two frames of it black.
std::vector<StereoImages> ShortFilm(int frames) {
  std::vector<StereoImages> film;
  for (int i = 0; i < frames; ++i) {
    film.push_back(RoomScene(true).See(i, i * kFrameNs, PoseAt(0.01 * i, 0, 0.1 * i, 0.5 * i)));
    DrawMover(i, film.back());
    if (i == 5 || i == 6) film.back().left.setTo(0), film.back().right.setTo(0);
  }
  return film;
}

/// More than once around on the spot, so that the first place is seen again.
const std::vector<StereoImages>& RoundFilm() {
  static const std::vector<StereoImages> film = [] {
    std::vector<StereoImages> frames;
    for (int i = 0; i < 40; ++i) {
      frames.push_back(RoomScene(true).See(i, i * kFrameNs, PoseAt(0.01 * i, 0, 0, 12.0 * i)));
    }
    return frames;
  }();
  return film;
}

struct Drive {
  int tracked = 0, loops = 0, regions = 0;
  bool finite = true;
};

Drive DriveThrough(const std::vector<StereoImages>& film, const SlamOptions& options) {
  Drive drive;
  StereoSlam slam(RoomScene(true).camera(), options);
  for (const StereoImages& images : film) {
    const TrackedFrame frame = slam.Track(images);
    drive.tracked += frame.T_world_rig.has_value();
    drive.loops += frame.loop_closed;
    drive.regions += static_cast<int>(frame.dynamic.regions.size());
    if (frame.T_world_rig) drive.finite &= frame.T_world_rig->matrix().allFinite();
  }
  for (const StampedPose& pose : slam.Finish())
    drive.finite &= pose.T_world_rig.matrix().allFinite();
  return drive;
}

/// Where an option at a bound needs another one to make room, by the rules between options.
struct Room {
  const char *path, *bound, *other, *value;
};
constexpr Room kRooms[] = {
    {"feature.fast_threshold", "1", "feature.fast_threshold_low", "1"},
    {"feature.fast_threshold_low", "254", "feature.fast_threshold", "254"},
    {"dynamic.paper.spread.fast_threshold", "1", "dynamic.paper.spread.fast_threshold_low", "1"},
    {"dynamic.paper.spread.fast_threshold_low", "254", "dynamic.paper.spread.fast_threshold",
     "254"},
    {"dynamic.paper.boundary.lambda_occlusion", "1e-06", "dynamic.paper.boundary.lambda_hinge",
     "1e-7"},
    {"dynamic.paper.boundary.lambda_hinge", "100000000", "dynamic.paper.boundary.lambda_occlusion",
     "1e9"},
    {"dynamic.robust.disparity.p1", "73", "dynamic.robust.disparity.p2", "73"},
    {"dynamic.robust.disparity.p1", "73", "dynamic.robust.disparity.least_p2", "73"},
    {"dynamic.robust.disparity.p2", "0", "dynamic.robust.disparity.p1", "0"},
    {"dynamic.robust.disparity.p2", "0", "dynamic.robust.disparity.least_p2", "0"},
    {"dynamic.robust.disparity.least_p2", "0", "dynamic.robust.disparity.p1", "0"},
    {"dynamic.robust.disparity.least_p2", "73", "dynamic.robust.disparity.p2", "73"},
    {"dynamic.robust.field.limit", "1", "dynamic.robust.field.grow_to", "-1"},
    {"dynamic.robust.field.moving", "100", "dynamic.robust.field.limit", "100"},
    {"dynamic.robust.field.grow_to", "-100", "dynamic.robust.field.limit", "100"},
    {"dynamic.robust.region.birth_core_px", "0", "dynamic.robust.region.keep_core_px", "0"},
    {"dynamic.robust.region.keep_core_px", "1000000", "dynamic.robust.region.birth_core_px",
     "1000000"},
};

/// The bounds of a number, else everything that the option can be.
std::vector<std::string> ExtremesOf(const OptionDescription& one) {
  if (one.kind == OptionDescription::Kind::kFlag) return {"false", "true"};
  if (!one.choices.empty()) return one.choices;
  return {fmt::format("{}", one.low), fmt::format("{}", one.high)};
}

/// Drives the film with every option of a group at its low and at its high bound, one at a time.
void ExpectEveryBoundIsSafe(const std::vector<StereoImages>& film, const SlamOptions& base,
                            const std::string& group) {
  int driven = 0;
  for (const OptionDescription& one : DescribeOptions(base)) {
    if (!one.path.starts_with(group)) continue;
    for (const std::string& text : ExtremesOf(one)) {
      SCOPED_TRACE(one.path + ": " + text);
      SlamOptions options = base;
      ASSERT_EQ(SetOption(one.path, text, &options), "");
      for (const Room& room : kRooms) {
        if (one.path != room.path || text != room.bound) continue;
        ASSERT_EQ(SetOption(room.other, room.value, &options), "");
      }
      ASSERT_EQ(Validate(options), "");
      EXPECT_TRUE(DriveThrough(film, options).finite);
      ++driven;
    }
  }
  EXPECT_GT(driven, 0) << group;
}

constexpr const char* kOfEveryDrive[] = {
    "feature.",        "stereo.",           "track.",        "keyframe.",         "mapping.",
    "least_keyframes", "keypoint_noise_px", "equal_columns", "least_first_points"};
constexpr const char* kOfOrbSlam2[] = {"orbslam2.", "orbslam2_mapping."};
constexpr const char* kOfLoops[] = {"loop.", "global.", "schedule.", "new_part_after_s"};

TEST(OptionBounds, AreAllDriven) {
  for (const OptionDescription& one : DescribeOptions({})) {
    const auto is_of = [&](const char* group) { return one.path.starts_with(group); };
    EXPECT_TRUE(std::ranges::any_of(kOfEveryDrive, is_of) || std::ranges::any_of(kOfLoops, is_of) ||
                std::ranges::any_of(kOfOrbSlam2, is_of) || is_of("dynamic.paper.") ||
                is_of("dynamic.robust.") || is_of("dynamic.method") || is_of("base"))
        << one.path;
  }
}

TEST(OptionBounds, OfTheFrontEndTrackingAndMappingAreSafe) {
  const std::vector<StereoImages> film = ShortFilm(8);
  ASSERT_EQ(DriveThrough(film, {}).tracked, 8);
  for (const char* group : kOfEveryDrive) ExpectEveryBoundIsSafe(film, {}, group);
}

TEST(OptionBounds, OfTheOrbSlam2BaseAreSafe) {
  const std::vector<StereoImages> film = ShortFilm(12);
  const SlamOptions base = OptionsOf(Base::kOrbSlam2);
  ASSERT_EQ(DriveThrough(film, base).tracked, 10);
  for (const char* group : kOfOrbSlam2) ExpectEveryBoundIsSafe(film, base, group);
}

/// Every pose of a drive, as known at its frame and as known at the end.
std::vector<Eigen::Matrix4d> PosesOf(const std::vector<StereoImages>& film,
                                     const SlamOptions& options) {
  StereoSlam slam(RoomScene(true).camera(), options);
  std::vector<Eigen::Matrix4d> poses;
  for (const StereoImages& images : film) {
    const TrackedFrame frame = slam.Track(images);
    if (frame.T_world_rig) poses.push_back(frame.T_world_rig->matrix());
  }
  for (const StampedPose& pose : slam.Finish()) poses.push_back(pose.T_world_rig.matrix());
  return poses;
}

TEST(OptionsWithoutEffect, ChangeNoBitWithTheirBase) {
  const std::vector<StereoImages> film = ShortFilm(12);
  for (const Base base : {Base::kPlain, Base::kOrbSlam2}) {
    const SlamOptions as_is = OptionsOf(base);
    SlamOptions changed = as_is;
    int idle = 0;
    for (const OptionDescription& one : DescribeOptions(as_is)) {
      if (WhyWithoutEffect(one.path, as_is).empty()) continue;
      ++idle;
      for (const std::string& text : ExtremesOf(one)) {
        if (text == one.value) continue;
        ASSERT_EQ(SetOption(one.path, text, &changed), "") << one.path;
      }
    }
    EXPECT_GT(idle, 10);
    const std::vector<Eigen::Matrix4d> poses = PosesOf(film, as_is);
    EXPECT_GE(poses.size(), 5u);
    EXPECT_EQ(PosesOf(film, changed), poses);
  }
}

TEST(OptionBounds, OfThePapersMethodAreSafe) {
  const std::vector<StereoImages> film = ShortFilm(3);
  SlamOptions base;
  base.dynamic.method = DynamicMethod::kPaper;
  ASSERT_GT(DriveThrough(film, base).regions, 0);
  ExpectEveryBoundIsSafe(film, base, "dynamic.paper.");
}

TEST(OptionBounds, OfTheRobustMethodAreSafe) {
  const std::vector<StereoImages> film = ShortFilm(5);
  SlamOptions base;
  base.dynamic.method = DynamicMethod::kRobust;
  ASSERT_GT(DriveThrough(film, base).regions, 0);
  ExpectEveryBoundIsSafe(film, base, "dynamic.robust.");
}

TEST(OptionBounds, OfLoopClosingAreSafe) {
  SlamOptions base;
  base.vocabulary_file = (std::filesystem::path(testing::TempDir()) / "option_bounds.voc").string();
  std::vector<cv::Mat1b> images;
  for (std::size_t i = 0; i < RoundFilm().size(); i += 4) images.push_back(RoundFilm()[i].left);
  TrainVocabulary(images, base.feature, base.vocabulary_file);
  // So few keyframes make a loop only where little is asked of one.
  base.loop.recent_keyframes = 3;
  base.loop.similarity_ratio = 0.2;
  base.loop.least_inliers = 20;
  base.loop.consistent_loops = 1;
  base.loop.consistent_inliers = 30;
  base.loop.drift_m = 1;
  ASSERT_GT(DriveThrough(RoundFilm(), base).loops, 0);
  for (const char* group : kOfLoops) ExpectEveryBoundIsSafe(RoundFilm(), base, group);
  std::filesystem::remove(base.vocabulary_file);
}

}  // namespace
}  // namespace aisle::slam
