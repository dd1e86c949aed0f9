#include <gtest/gtest.h>

#include "slam/stereo_slam.h"
#include "tests/slam/face/room_scene.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kFrameNs = 50'000'000;

/// A rig that drives ahead and turns; what its wheels say, exact, with the deviations stated.
class MeasuredDrive {
 public:
  explicit MeasuredDrive(int frames, double turn_deg) {
    for (int i = 0; i < frames; ++i) path_.push_back(PoseAt(0.01 * i, 0, 0.04 * i, turn_deg * i));
  }

  int frames() const { return static_cast<int>(path_.size()); }
  StereoImages See(int i) const {
    return RoomScene().See(i, i * kFrameNs, path_[static_cast<std::size_t>(i)]);
  }
  StereoImages Dark(int i) const {
    const StereoCamera camera = RoomScene().camera();
    const cv::Mat1b black(camera.height, camera.width, static_cast<std::uint8_t>(0));
    return {i, i * kFrameNs, black, black};
  }
  std::optional<MeasuredMotion> Wheels(int i) const {
    if (i == 0) return std::nullopt;
    const auto at = static_cast<std::size_t>(i);
    return MeasuredMotion{path_[at].inverse() * path_[at - 1], 1e-6 * Matrix6d::Identity()};
  }
  double ErrorM(const TrackedFrame& frame, int i) const {
    const Eigen::Isometry3d found = path_[0] * *frame.T_world_rig;
    return (found.translation() - path_[static_cast<std::size_t>(i)].translation()).norm();
  }

 private:
  std::vector<Eigen::Isometry3d> path_;
};

TEST(MeasuredMotion, CarriesTheRigThroughTheDarkAndIsLeftWhenItSeesAgain) {
  const MeasuredDrive drive(44, 0.2);
  StereoSlam with(RoomScene().camera(), {}), without(RoomScene().camera(), {});
  for (int i = 0; i < drive.frames(); ++i) {
    const bool dark = i >= 12 && i < 36;
    const StereoImages images = dark ? drive.Dark(i) : drive.See(i);
    const TrackedFrame frame = with.Track(images, {}, drive.Wheels(i));
    EXPECT_EQ(frame.state, dark ? TrackingState::kCoasting : TrackingState::kTracking) << i;
    ASSERT_TRUE(frame.T_world_rig) << i;
    EXPECT_LT(drive.ErrorM(frame, i), 0.02) << i;
    if (i >= 36) continue;
    const TrackedFrame by_inertia = without.Track(images);
    const bool gone = dark && i > 31;  // a second after frame 11
    if (dark) {
      EXPECT_EQ(by_inertia.state, gone ? TrackingState::kLost : TrackingState::kCoasting) << i;
    }
    if (dark && !gone) {
      EXPECT_LT(drive.ErrorM(by_inertia, i), 0.1) << i;
    }
  }
  EXPECT_EQ(with.Finish().size(), 44u);
}

/// It sees again where nothing of the map is left to be seen: the map goes on from there.
TEST(MeasuredMotion, ExtendsTheMapWhereNothingOfItIsSeen) {
  const MeasuredDrive drive(60, 3);  // half a turn
  StereoSlam slam(RoomScene().camera(), {});
  int coasted = 0, tracked_after = 0;
  for (int i = 0; i < drive.frames(); ++i) {
    const bool dark = i >= 8 && i < 44;
    const TrackedFrame frame = slam.Track(dark ? drive.Dark(i) : drive.See(i), {}, drive.Wheels(i));
    ASSERT_TRUE(frame.T_world_rig) << i;
    EXPECT_LT(drive.ErrorM(frame, i), 0.03) << i;
    coasted += frame.state == TrackingState::kCoasting;
    tracked_after += !dark && i >= 44 && frame.state == TrackingState::kTracking;
  }
  EXPECT_GE(coasted, 36);
  EXPECT_GE(tracked_after, 12);
}

/// Frame 15 and those from 20 on go by inertia, until a second after the last that was measured.
TEST(MeasuredMotion, WithoutOneTheRigCoastsForASecond) {
  const MeasuredDrive drive(44, 0);
  StereoSlam slam(RoomScene().camera(), {});
  for (int i = 0; i < drive.frames(); ++i) {
    const auto wheels = i < 20 && i != 15 ? drive.Wheels(i) : std::nullopt;
    const TrackedFrame frame = slam.Track(i < 10 ? drive.See(i) : drive.Dark(i), {}, wheels);
    if (i < 10) continue;
    EXPECT_EQ(frame.state, i <= 39 ? TrackingState::kCoasting : TrackingState::kLost) << i;
    ASSERT_EQ(frame.T_world_rig.has_value(), i <= 39) << i;
    if (i <= 20) {
      EXPECT_LT(drive.ErrorM(frame, i), 0.03) << i;
    }
  }
}

TEST(MeasuredMotion, SaysNothingToThePublishedBase) {
  const MeasuredDrive drive(14, 0.2);
  StereoSlam with(RoomScene().camera(), OptionsOf(Base::kOrbSlam2));
  StereoSlam without(RoomScene().camera(), OptionsOf(Base::kOrbSlam2));
  for (int i = 0; i < drive.frames(); ++i) {
    const StereoImages images = i < 10 ? drive.See(i) : drive.Dark(i);
    const TrackedFrame a = with.Track(images, {}, drive.Wheels(i)), b = without.Track(images);
    EXPECT_EQ(a.state, b.state);
    ASSERT_EQ(a.T_world_rig.has_value(), b.T_world_rig.has_value());
    if (a.T_world_rig) {
      EXPECT_EQ(a.T_world_rig->matrix(), b.T_world_rig->matrix());
    }
  }
}

TEST(MeasuredMotion, RefusesWhatIsNone) {
  const MeasuredDrive drive(2, 0);
  StereoSlam slam(RoomScene().camera(), {});
  slam.Track(drive.See(0));
  MeasuredMotion wheels = *drive.Wheels(1);
  wheels.covariance(2, 2) = 0;
  EXPECT_THROW(slam.Track(drive.See(1), {}, wheels), std::invalid_argument);
  wheels.covariance(2, 2) = NAN;
  EXPECT_THROW(slam.Track(drive.See(1), {}, wheels), std::invalid_argument);
  EXPECT_EQ(slam.Track(drive.See(1), {}, drive.Wheels(1)).state, TrackingState::kTracking);
}

}  // namespace
}  // namespace aisle::slam
