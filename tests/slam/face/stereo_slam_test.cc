#include "slam/stereo_slam.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/slam/face/room_scene.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kFrameNs = 50'000'000;

/// Frames along a path, rendered once for all tests.
std::vector<StereoImages> Film(const std::vector<Eigen::Isometry3d>& path) {
  std::vector<StereoImages> frames;
  for (const Eigen::Isometry3d& pose : path) {
    const auto id = static_cast<std::int64_t>(frames.size());
    frames.push_back(RoomScene().See(id, id * kFrameNs, pose));
  }
  return frames;
}

std::vector<Eigen::Isometry3d> StraightPath() {
  std::vector<Eigen::Isometry3d> path;
  for (int i = 0; i < 30; ++i) path.push_back(PoseAt(0.01 * i, 0, 0.06 * i, 0.2 * i));
  return path;
}

const std::vector<StereoImages>& StraightFilm() {
  static const std::vector<StereoImages> film = Film(StraightPath());
  return film;
}

double ErrorM(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth) {
  return (estimate.translation() - truth.translation()).norm();
}

std::vector<TrackedFrame> TrackAll(StereoSlam& slam, const std::vector<StereoImages>& film) {
  std::vector<TrackedFrame> tracked;
  for (const StereoImages& images : film) tracked.push_back(slam.Track(images));
  return tracked;
}

StereoImages Black(StereoImages images) {
  images.left = cv::Mat1b::zeros(images.left.size());
  images.right = images.left.clone();
  return images;
}

void ExpectFollows(const std::vector<TrackedFrame>& tracked,
                   const std::vector<Eigen::Isometry3d>& path, double worst_m) {
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    ASSERT_EQ(tracked[i].state, TrackingState::kTracking) << "frame " << i;
    ASSERT_TRUE(tracked[i].T_world_rig);
    EXPECT_LT(ErrorM(path.front() * *tracked[i].T_world_rig, path[i]), worst_m) << "frame " << i;
  }
}

TEST(StereoSlam, FollowsADriveThroughARoom) {
  StereoSlam slam(RoomScene().camera(), {});
  const std::vector<TrackedFrame> tracked = TrackAll(slam, StraightFilm());
  ExpectFollows(tracked, StraightPath(), 0.025);
  const std::vector<StampedPose> final_track = slam.Finish();
  ASSERT_EQ(final_track.size(), tracked.size());
  EXPECT_LT(ErrorM(final_track.back().T_world_rig, StraightPath().back()), 0.03);
  EXPECT_EQ(final_track.back().stamp_ns, 29 * kFrameNs);
}

TEST(StereoSlam, FollowsATurnOnTheSpot) {
  std::vector<Eigen::Isometry3d> path;
  for (int i = 0; i < 30; ++i) path.push_back(PoseAt(0, 0, 0, 3.0 * i));
  StereoSlam slam(RoomScene().camera(), {});
  ExpectFollows(TrackAll(slam, Film(path)), path, 0.04);
}

TEST(StereoSlam, StandsStillWithoutAFloodOfKeyframes) {
  StereoSlam slam(RoomScene().camera(), {});
  const std::vector<Eigen::Isometry3d> path(25, PoseAt(0, 0, 0));
  const std::vector<TrackedFrame> tracked = TrackAll(slam, Film(path));
  ExpectFollows(tracked, path, 0.011);
  EXPECT_EQ(std::count_if(tracked.begin(), tracked.end(),
                          [](const TrackedFrame& frame) { return frame.is_keyframe; }),
            1);
}

TEST(StereoSlam, FollowsAnAbruptStop) {
  std::vector<Eigen::Isometry3d> path = StraightPath();
  for (std::size_t i = 21; i < path.size(); ++i) path[i] = path[20];
  std::vector<StereoImages> film(StraightFilm().begin(), StraightFilm().begin() + 21);
  for (std::int64_t i = 21; i < 30; ++i) {
    film.push_back(RoomScene().See(i, i * kFrameNs, path[20]));
  }
  StereoSlam slam(RoomScene().camera(), {});
  ExpectFollows(TrackAll(slam, film), path, 0.025);
}

TEST(StereoSlam, ComesBackAfterFramesThatShowNothing) {
  StereoSlam slam(RoomScene().camera(), {});
  for (std::size_t i = 0; i < StraightFilm().size(); ++i) {
    StereoImages images = StraightFilm()[i];
    const bool black = i >= 15 && i < 18, white = i == 22;
    if (black || white) {
      images.left = cv::Mat1b(images.left.size(), black ? 0 : 255);
      images.right = images.left.clone();
    }
    const TrackedFrame tracked = slam.Track(images);
    EXPECT_EQ(tracked.state, black || white ? TrackingState::kCoasting : TrackingState::kTracking)
        << "frame " << i;
    ASSERT_TRUE(tracked.T_world_rig) << "frame " << i;
    EXPECT_LT(ErrorM(*tracked.T_world_rig, StraightPath()[i]), 0.03) << "frame " << i;
  }
  EXPECT_EQ(slam.Finish().size(), StraightFilm().size());
}

TEST(StereoSlam, RefusesStampsThatDoNotRiseAndGoesOn) {
  StereoSlam slam(RoomScene().camera(), {});
  slam.Track(StraightFilm()[0]);
  slam.Track(StraightFilm()[2]);
  EXPECT_THROW(slam.Track(StraightFilm()[2]), std::invalid_argument);
  EXPECT_THROW(slam.Track(StraightFilm()[1]), std::invalid_argument);
  EXPECT_EQ(slam.Track(StraightFilm()[3]).state, TrackingState::kTracking);
  EXPECT_EQ(slam.Finish().size(), 3u);
}

TEST(StereoSlam, DrivesOnThroughDarknessAndKnowsWhereItIsWhenTheLightReturns) {
  StereoSlam slam(RoomScene().camera(), {});
  for (std::size_t i = 0; i < StraightFilm().size(); ++i) {
    StereoImages images = StraightFilm()[i];
    const bool dark = i >= 10 && i < 26;  // 0.8 s and a metre
    if (dark) images.left = images.right = cv::Mat1b(images.left.size(), std::uint8_t{0});
    const TrackedFrame tracked = slam.Track(images);
    ASSERT_EQ(tracked.state, dark ? TrackingState::kCoasting : TrackingState::kTracking)
        << "frame " << i;
    EXPECT_LT(ErrorM(*tracked.T_world_rig, StraightPath()[i]), dark ? 0.1 : 0.04) << "frame " << i;
  }
}

TEST(StereoSlam, IsLostWhereItIsCarriedAwayHoweverFewFeaturesItMayHave) {
  SlamOptions options;
  options.feature.features = 400;
  StereoSlam slam(RoomScene().camera(), options);
  for (std::size_t i = 0; i < 12; ++i) slam.Track(StraightFilm()[i]);
  StereoImages away = RoomScene().See(12, 12 * kFrameNs, PoseAt(0, 0, 0.6, 180));
  EXPECT_EQ(slam.Track(away).state, TrackingState::kLost);
}

/// Another wall at every frame, of too few features to tell that it is a cut. What inertia makes a
/// keyframe of is no proof of it.
TEST(StereoSlam, InertiaIsBelievedForASecondThoughItMakesKeyframes) {
  SlamOptions options;
  options.feature.features = 15000;
  StereoSlam slam(RoomScene().camera(), options);
  for (std::size_t i = 0; i < 12; ++i) slam.Track(StraightFilm()[i]);
  int extended = 0;
  for (int i = 12; i < 40; ++i) {
    const Texture wall(static_cast<std::uint64_t>(1000 + 2 * i));
    const auto seen = [&](double right_px) {
      return Render(StraightFilm()[0].left.size(),
                    [&](double u, double v) { return wall(u + right_px, v); });
    };
    const double disparity_px = 4 + 4 * (i % 4);  // and at another depth: no two agree by chance
    const TrackedFrame tracked = slam.Track({i, i * kFrameNs, seen(0), seen(disparity_px)});
    extended += tracked.is_keyframe;
    ASSERT_LT(2 * tracked.features, options.feature.features);
    EXPECT_EQ(tracked.state, i <= 31 ? TrackingState::kCoasting : TrackingState::kLost) << i;
  }
  EXPECT_GE(extended, 1);
}

TEST(StereoSlam, AfterDarknessAnExposureThatSettlesMisleadsNobody) {
  const std::vector<double> gains = {3.0, 2.2, 1.6, 1.3, 1.1};  // of the first frames with light
  StereoSlam slam(RoomScene().camera(), {});
  for (std::size_t i = 0; i < StraightFilm().size(); ++i) {
    const StereoImages& shown = StraightFilm()[i];
    const bool dark = i >= 8 && i < 18;
    const bool settled = i >= 18 + gains.size();
    const double gain = dark ? 0 : i < 8 || settled ? 1 : gains[i - 18];
    StereoImages images{shown.id, shown.stamp_ns, {}, {}};
    shown.left.convertTo(images.left, CV_8U, gain);
    shown.right.convertTo(images.right, CV_8U, gain);
    const TrackedFrame tracked = slam.Track(images);
    if (settled) {
      EXPECT_EQ(tracked.state, TrackingState::kTracking) << "frame " << i;
    }
    if (!tracked.T_world_rig) continue;  // overexposed, it may look like another place
    EXPECT_LT(ErrorM(*tracked.T_world_rig, StraightPath()[i]), settled ? 0.04 : 0.1)
        << "frame " << i;
  }
}

TEST(StereoSlam, WaitsForAFirstFrameWithDepth) {
  StereoSlam slam(RoomScene().camera(), {});
  StereoImages images = StraightFilm()[0];
  images.right = cv::Mat1b(images.left.size(), std::uint8_t{90});  // a dead right camera
  EXPECT_EQ(slam.Track(images).state, TrackingState::kInitializing);
  images.left = images.right;
  images.stamp_ns += 1'000'000;
  EXPECT_EQ(slam.Track(images).state, TrackingState::kInitializing);
  EXPECT_TRUE(slam.Finish().empty());
  EXPECT_EQ(slam.Track(StraightFilm()[1]).state, TrackingState::kTracking);
}

TEST(StereoSlam, TracksAFrameWithoutStereoMatches) {
  StereoSlam slam(RoomScene().camera(), {});
  for (std::size_t i = 0; i < 20; ++i) {
    StereoImages images = StraightFilm()[i];
    if (i == 10) images.right = cv::Mat1b(images.left.size(), std::uint8_t{90});
    const TrackedFrame tracked = slam.Track(images);
    ASSERT_EQ(tracked.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_LT(ErrorM(*tracked.T_world_rig, StraightPath()[i]), 0.03) << "frame " << i;
  }
}

TEST(StereoSlam, TakesARepeatedFrameAndDroppedOnes) {
  StereoSlam slam(RoomScene().camera(), {});
  std::int64_t stamp_ns = 0;  // a camera that delivers a picture again gives it a new one
  for (const std::size_t i : {0, 1, 2, 3, 3, 3, 4, 5, 8, 9, 9, 10, 14, 15, 16, 17}) {
    StereoImages images = StraightFilm()[i];
    images.stamp_ns = stamp_ns += 50'000'000;
    const TrackedFrame tracked = slam.Track(images);
    ASSERT_EQ(tracked.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_LT(ErrorM(*tracked.T_world_rig, StraightPath()[i]), 0.03) << "frame " << i;
  }
}

TEST(StereoSlam, TakesAPauseOfMinutes) {
  StereoSlam slam(RoomScene().camera(), {});
  for (std::size_t i = 0; i < 20; ++i) {
    StereoImages images = StraightFilm()[i];
    if (i >= 10) images.stamp_ns += 300'000'000'000;
    const TrackedFrame tracked = slam.Track(images);
    ASSERT_EQ(tracked.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_LT(ErrorM(*tracked.T_world_rig, StraightPath()[i]), 0.03) << "frame " << i;
  }
}

TEST(StereoSlam, UsesNothingUnderTheMask) {
  StereoSlam slam(RoomScene().camera(), {});
  ExternalMask mask{cv::Mat1b(240, 376, std::uint8_t{0}), cv::Mat1b(240, 376, std::uint8_t{0}), {}};
  mask.left(cv::Rect(90, 0, 180, 240)) = 255;
  mask.right(cv::Rect(90, 0, 180, 240)) = 255;
  for (std::size_t i = 0; i < 20; ++i) {
    const TrackedFrame tracked = slam.Track(StraightFilm()[i], mask);
    ASSERT_EQ(tracked.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_LT(ErrorM(*tracked.T_world_rig, StraightPath()[i]), 0.03) << "frame " << i;
    for (const cv::Point2f& pixel : tracked.keypoints) {
      EXPECT_FALSE(mask.left(cv::Point(pixel))) << "frame " << i << " at " << pixel;
    }
  }
}

TEST(StereoSlam, BelievesWhatItIsToldToTrust) {
  // A poster goes past on the right: trusted little, it does not carry the rig along.
  std::vector<StereoImages> film;
  for (const StereoImages& images : StraightFilm()) {
    StereoImages posted{images.id, images.stamp_ns, images.left.clone(), images.right.clone()};
    const cv::Mat1b poster = StraightFilm().front().left(cv::Rect(60, 40, 130, 150));
    const int x = 200 - 3 * static_cast<int>(images.id);
    poster.copyTo(posted.left(cv::Rect(x, 45, 130, 150)));
    poster.copyTo(posted.right(cv::Rect(x - 26, 45, 130, 150)));
    film.push_back(posted);
  }
  StereoSlam slam(RoomScene().camera(), {});
  for (std::size_t i = 0; i < film.size(); ++i) {
    ExternalMask trust;
    trust.confidence = cv::Mat1f(240, 376, 1.0F);
    trust.confidence(cv::Rect(200 - 3 * static_cast<int>(i), 45, 130, 150)) = 0.0F;
    const TrackedFrame tracked = slam.Track(film[i], trust);
    ASSERT_EQ(tracked.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_LT(ErrorM(*tracked.T_world_rig, StraightPath()[i]), 0.03) << "frame " << i;
  }
}

TEST(StereoSlam, TheMapGrowsWithThePlaceAndNotWithTime) {
  SlamOptions options;
  options.schedule.background = false;
  StereoSlam slam(RoomScene().camera(), options);
  constexpr int kLaps = 8;
  std::vector<TrackedFrame> lap_ends;
  std::int64_t id = 0;
  for (int lap = 0; lap < kLaps; ++lap) {
    TrackedFrame last;
    for (std::size_t step = 0; step < 48; step += 2) {  // there and back
      StereoImages images = StraightFilm()[step < 24 ? step : 47 - step];
      images.stamp_ns = id++ * 2 * kFrameNs;
      last = slam.Track(images);
      ASSERT_EQ(last.state, TrackingState::kTracking) << "lap " << lap << " step " << step;
    }
    lap_ends.push_back(last);
  }
  EXPECT_LE(lap_ends.back().map_keyframes, lap_ends[2].map_keyframes + 2);
  EXPECT_LE(lap_ends.back().map_landmarks, 1.1 * lap_ends[2].map_landmarks);
}

TEST(StereoSlam, FreeRunningFollowsACameraButPromisesNoBits) {
  SlamOptions options;
  options.schedule.free_running = true;
  StereoSlam slam(RoomScene().camera(), options);
  std::vector<TrackedFrame> tracked;
  for (const StereoImages& images : StraightFilm()) {
    tracked.push_back(slam.Track(images));
    // The pace of a camera: frames that come as fast as they can be tracked leave a mapper that
    // nobody waits for no time to follow.
    std::this_thread::sleep_for(std::chrono::nanoseconds(kFrameNs));
  }
  ExpectFollows(tracked, StraightPath(), 0.05);
  EXPECT_EQ(slam.Finish().size(), StraightFilm().size());
  options.schedule.background = false;
  EXPECT_THROW(StereoSlam(RoomScene().camera(), options), std::invalid_argument);
}

SlamOptions OrbSlam2With(int threads, bool background, int mapping_frames) {
  SlamOptions options = OptionsOf(Base::kOrbSlam2);
  options.threads = threads;
  options.schedule.background = background;
  options.schedule.mapping_frames = mapping_frames;
  return options;
}

TEST(OrbSlam2Base, FollowsADriveThroughARoom) {
  for (const int mapping_frames : {1, 5}) {
    StereoSlam slam(RoomScene().camera(), OrbSlam2With(2, true, mapping_frames));
    ExpectFollows(TrackAll(slam, StraightFilm()), StraightPath(), 0.05);
    EXPECT_EQ(slam.Finish().size(), StraightFilm().size());
  }
}

TEST(OrbSlam2Base, GivesTheSameBitsForAnyThreadsAndForInlineMapping) {
  for (const int mapping_frames : {1, 5}) {
    const auto run = [&](int threads, bool background) {
      StereoSlam slam(RoomScene().camera(), OrbSlam2With(threads, background, mapping_frames));
      TrackAll(slam, StraightFilm());
      return slam.Finish();
    };
    const std::vector<StampedPose> first = run(1, false);
    for (int i = 0; i < 4; ++i) {
      const std::vector<StampedPose> again = run(1 + i, i % 2 == 0);
      ASSERT_EQ(again.size(), first.size());
      for (std::size_t k = 0; k < first.size(); ++k) {
        EXPECT_EQ(again[k].T_world_rig.matrix(), first[k].T_world_rig.matrix()) << k;
      }
    }
  }
}

TEST(OrbSlam2Base, BeginsAnewWhereASmallMapIsLost) {
  StereoSlam slam(RoomScene().camera(), OrbSlam2With(2, true, 1));
  slam.Track(StraightFilm()[0]);
  EXPECT_EQ(slam.Track(StraightFilm()[1]).map_id, 0);
  EXPECT_EQ(slam.Track(Black(StraightFilm()[2])).state, TrackingState::kInitializing);
  const TrackedFrame next = slam.Track(StraightFilm()[3]);
  ASSERT_TRUE(next.T_world_rig);
  EXPECT_EQ(next.T_world_rig->matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(next.map_id, 1);
  EXPECT_EQ(slam.Finish().size(), 1u);
}

TEST(OrbSlam2Base, AMapIsGivenUpOnceHoweverLongTheDarkness) {
  StereoSlam slam(RoomScene().camera(), OrbSlam2With(2, true, 1));
  EXPECT_EQ(slam.Track(Black(StraightFilm()[0])).map_id, 0) << "there was none to give up";
  EXPECT_EQ(slam.Track(StraightFilm()[1]).map_id, 0);
  for (std::size_t i = 2; i < 6; ++i) EXPECT_EQ(slam.Track(Black(StraightFilm()[i])).map_id, 1);
  EXPECT_EQ(slam.Track(StraightFilm()[6]).map_id, 1);
}

/// The rig is carried to the back wall in the dark, before it has mapped anything to speak of.
TEST(StereoSlam, MapIdRisesWhereTheWorldBeginsAnew) {
  const std::string words = (std::filesystem::path(testing::TempDir()) / "map_id.voc").string();
  TrainVocabulary({StraightFilm()[0].left}, {}, words);
  SlamOptions options;
  options.vocabulary_file = words;
  options.new_part_after_s = 0.2;
  options.track.inertia.longest_s = 0;
  StereoSlam slam(RoomScene().camera(), options);
  std::filesystem::remove(words);
  std::vector<Eigen::Isometry3d> away;
  for (int i = 0; i < 20; ++i) away.push_back(PoseAt(0, 0, 0.6, 180 + 0.5 * i));
  std::int64_t id = 0;
  const auto track = [&](StereoImages images) {
    images.id = id;
    images.stamp_ns = id++ * kFrameNs;
    return slam.Track(images);
  };
  for (int i = 0; i < 2; ++i) EXPECT_EQ(track(StraightFilm()[0]).map_id, 0);
  std::vector<TrackedFrame> later;
  for (const StereoImages& images : Film(away)) later.push_back(track(images));
  EXPECT_EQ(later.front().map_id, 0) << "lost, but not given up yet";
  EXPECT_EQ(later.back().map_id, 1);
  ASSERT_TRUE(later.back().T_world_rig);
  // Finish speaks of the same world.
  const std::vector<StampedPose> final_track = slam.Finish();
  const auto begun = std::ranges::find(later, 1, &TrackedFrame::map_id);
  ASSERT_FALSE(final_track.empty());
  EXPECT_EQ(final_track.front().stamp_ns, begun->stamp_ns);
}

TEST(StereoSlam, RefusesImagesOfAnotherSize) {
  StereoSlam slam(RoomScene().camera(), {});
  StereoImages images = StraightFilm()[0];
  images.right = cv::Mat1b(100, 100);
  EXPECT_THROW(slam.Track(images), std::invalid_argument);
  EXPECT_THROW(slam.Track(StraightFilm()[0], {cv::Mat1b(10, 10), {}, {}}), std::invalid_argument);
  StereoCamera mono = RoomScene().camera();
  mono.baseline_m = 0;
  EXPECT_THROW(StereoSlam(mono, {}), std::invalid_argument);
}

/// Everything an outsider sees of a run, to the last bit.
std::vector<double> Bits(const SlamOptions& options) {
  StereoSlam slam(RoomScene().camera(), options);
  const std::vector<StereoImages> film(StraightFilm().begin(), StraightFilm().begin() + 18);
  std::vector<double> bits;
  const auto append = [&](const Eigen::Isometry3d& pose) {
    bits.insert(bits.end(), pose.matrix().data(), pose.matrix().data() + 16);
  };
  for (const TrackedFrame& tracked : TrackAll(slam, film)) {
    append(*tracked.T_world_rig);
    bits.push_back(tracked.inliers);
    bits.push_back(tracked.is_keyframe);
  }
  for (const StampedPose& pose : slam.Finish()) append(pose.T_world_rig);
  return bits;
}

TEST(StereoSlam, GivesTheSameBitsTwentyTimesForAnyThreadsAndForInlineMapping) {
  SlamOptions inline_mapping;
  inline_mapping.threads = 1;
  inline_mapping.schedule.background = false;
  const std::vector<double> reference = Bits(inline_mapping);
  for (const int threads : {1, 2, 4, 0}) {
    SlamOptions options;
    options.threads = threads;
    for (int again = 0; again < 5; ++again) {
      EXPECT_EQ(Bits(options), reference) << threads << " threads, time " << again;
    }
  }
}

TEST(StereoSlam, RunsSideBySideWithOthersOfItsKind) {
  const std::vector<double> alone = Bits({});
  std::vector<double> a, b;
  std::thread first([&] { a = Bits({}); }), second([&] { b = Bits({}); });
  first.join();
  second.join();
  EXPECT_EQ(a, alone);
  EXPECT_EQ(b, alone);
}

}  // namespace
}  // namespace aisle::slam
