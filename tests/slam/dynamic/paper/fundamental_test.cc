#include "slam/dynamic/paper/fundamental.h"

#include <gtest/gtest.h>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/common/counter_random.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const StereoCamera kCamera;

Matrix3d Intrinsics() {
  Matrix3d K;
  K << kCamera.fx, 0, kCamera.cx, 0, kCamera.fy, kCamera.cy, 0, 0, 1;
  return K;
}

Isometry3d SomeMotion() {
  Isometry3d T = Isometry3d::Identity();  // T_previous_current
  T.translate(Vector3d(0.06, -0.01, 0.12));
  T.rotate(Eigen::AngleAxisd(0.03, Vector3d(0.2, 1, -0.1).normalized()));
  return T;
}

/// F from the motion by its definition, K^-T [t]x R K^-1.
Matrix3d TrueFundamental(const Isometry3d& T_previous_current) {
  const Isometry3d T = T_previous_current.inverse();
  const Vector3d t = T.translation();
  Matrix3d cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  const Matrix3d F =
      Intrinsics().inverse().transpose() * cross * T.linear() * Intrinsics().inverse();
  return F / F.norm();
}

cv::Point2f Project(const Vector3d& p) {
  return {static_cast<float>(kCamera.fx * p.x() / p.z() + kCamera.cx),
          static_cast<float>(kCamera.fy * p.y() / p.z() + kCamera.cy)};
}

/// Tracks of points in a box before the camera; the first `movers` of them also move on their own.
std::vector<Track> MakeTracks(int count, int movers, double noise_px) {
  CounterRandom random(3, 0);
  const auto uniform = [&] { return random.Below(1 << 20) / double{1 << 20} - 0.5; };
  std::vector<Track> tracks;
  while (static_cast<int>(tracks.size()) < count) {
    const Vector3d p(6 * uniform(), 4 * uniform(), 5 + 6 * uniform());
    const bool moves = static_cast<int>(tracks.size()) < movers;
    const Vector3d q = p + (moves ? Vector3d(0, 0.25, 0) : Vector3d::Zero());
    Track track{Project(p), Project(SomeMotion().inverse() * q)};
    track.current.x += static_cast<float>(2 * noise_px * uniform());
    track.current.y += static_cast<float>(2 * noise_px * uniform());
    tracks.push_back(track);
  }
  return tracks;
}

TEST(FundamentalFromTracks, IsTheMotionsOwnForExactTracks) {
  const Matrix3d F = FundamentalFromTracks(MakeTracks(40, 0, 0));
  const Matrix3d truth = TrueFundamental(SomeMotion());
  EXPECT_LT(std::min((F - truth).norm(), (F + truth).norm()), 2e-3);
  EXPECT_NEAR(F.determinant(), 0, 1e-12);
}

TEST(FundamentalFromTracks, NineTracksAreEnough) {
  const auto tracks = MakeTracks(9, 0, 0);
  const Matrix3d F = FundamentalFromTracks(tracks);
  for (const Track& track : tracks) EXPECT_LT(EpipolarDistance(F, track), 0.05);
}

TEST(EpipolarDistance, IsThePixelDistanceToTheTrueLine) {
  const Matrix3d F = TrueFundamental(SomeMotion());
  for (Track track : MakeTracks(50, 0, 0)) {
    EXPECT_LT(EpipolarDistance(F, track), 1e-3);
    const Vector3d line = F * Vector3d(track.previous.x, track.previous.y, 1);
    const Eigen::Vector2d across = line.head<2>().normalized();
    track.current +=
        cv::Point2f(static_cast<float>(7 * across.x()), static_cast<float>(7 * across.y()));
    EXPECT_NEAR(EpipolarDistance(F, track), 7, 1e-3);
  }
}

TEST(EstimateFundamental, SetsMoversApartAndIsNearTheTruth) {
  const int movers = 60;
  const auto tracks = MakeTracks(300, movers, 0.2);
  const FundamentalEstimate estimate = EstimateFundamental(tracks, {});
  ASSERT_TRUE(estimate.found);
  const Matrix3d truth = TrueFundamental(SomeMotion());
  int kept_movers = 0, lost_static = 0;
  for (int k = 0; k < 300; ++k) {
    const Track& track = tracks[static_cast<std::size_t>(k)];
    if (k < movers) {
      kept_movers += EpipolarDistance(truth, track) > 3 && EpipolarDistance(estimate.F, track) < 1;
    } else {
      lost_static += EpipolarDistance(estimate.F, track) > 0.8;
    }
  }
  EXPECT_LE(kept_movers, 2);
  EXPECT_LE(lost_static, 3);
}

TEST(EstimateFundamental, GivesTheSameBitsTwice) {
  const auto tracks = MakeTracks(200, 40, 0.2);
  const auto a = EstimateFundamental(tracks, {}), b = EstimateFundamental(tracks, {});
  EXPECT_EQ(a.F, b.F);
  EXPECT_EQ(a.is_inlier, b.is_inlier);
}

TEST(EstimateFundamental, FindsNothingInTooFewTracks) {
  EXPECT_FALSE(EstimateFundamental({}, {}).found);
  EXPECT_FALSE(EstimateFundamental(MakeTracks(8, 0, 0), {}).found);
}

TEST(TrackPoints, FollowsTheTrueFlowOfAStaticHall) {
  const auto before = test::Render(test::StaticHall(), kCamera, Isometry3d::Identity(), 0);
  Isometry3d T = Isometry3d::Identity();
  T.translate(Vector3d(0.02, 0, 0.04));
  const auto now = test::Render(test::StaticHall(), kCamera, T, 0.05);
  std::vector<cv::Point2f> points;
  for (int y = 40; y < 460; y += 20) {
    for (int x = 40; x < 730; x += 20) points.emplace_back(x, y);
  }
  const auto tracks = TrackPoints(before.left, now.left, points, {});
  EXPECT_GT(tracks.size(), points.size() * 8 / 10);
  std::vector<double> errors;
  for (const Track& track : tracks) {
    const double d = before.disparity(cv::Point(track.previous));
    const double z = kCamera.fx * kCamera.baseline_m / d;
    const Vector3d p((track.previous.x - kCamera.cx) / kCamera.fx * z,
                     (track.previous.y - kCamera.cy) / kCamera.fy * z, z);
    errors.push_back(cv::norm(Project(T.inverse() * p) - track.current));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.1);
  EXPECT_LT(errors[errors.size() * 9 / 10], 0.5);
}

}  // namespace
}  // namespace aisle::slam::dynamic
