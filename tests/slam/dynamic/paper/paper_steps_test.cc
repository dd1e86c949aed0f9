// The steps of the paper's method on rendered frames, each against what the rendering knows.
#include <gtest/gtest.h>

#include "slam/common/median.h"
#include "slam/dynamic/paper/boundary_labels.h"
#include "slam/dynamic/paper/disparity.h"
#include "slam/dynamic/paper/dynamic_points.h"
#include "slam/dynamic/paper/mark_regions.h"
#include "slam/dynamic/paper/spread_features.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const StereoCamera kCamera;
const Vector3d kWalkerVelocity(1.0, 0, 0.3);  // metres a second
constexpr double kStep = 0.05;                // seconds

/// Two frames of a rig that drives and turns past a walker, and what is true of them.
struct TwoFrames {
  Isometry3d T_previous_current = Isometry3d::Identity();
  test::SyntheticView previous, current;
  std::vector<cv::Point2f> features;
  std::vector<Track> tracks;
  cv::Mat1f disparity;  // of the current frame, by SGBM

  TwoFrames() {
    T_previous_current.translate(Vector3d(0.03, 0, 0.08));
    T_previous_current.rotate(Eigen::AngleAxisd(0.01, Vector3d::UnitY()));
    auto panels = test::StaticHall();
    panels.push_back(test::Walker({0.1, 0.1, 3.2}, kWalkerVelocity));
    previous = test::Render(panels, kCamera, Isometry3d::Identity(), 0);
    current = test::Render(panels, kCamera, T_previous_current, kStep);
    features = SpreadFeatures(previous.left, {});
    tracks = TrackPoints(previous.left, current.left, features, {});
    DisparityOptions whole_size;  // the steps after it are tested on the finest there is
    whole_size.half_size = false;
    disparity = ComputeDisparity(current.left, current.right, whole_size);
  }

  /// Where a pixel of the previous frame is seen in the current one.
  cv::Point2f TruePlaceOf(const cv::Point2f& pixel) const {
    const cv::Point at(cvRound(pixel.x), cvRound(pixel.y));
    const double z = kCamera.fx * kCamera.baseline_m / previous.disparity(at);
    Vector3d p((pixel.x - kCamera.cx) / kCamera.fx * z, (pixel.y - kCamera.cy) / kCamera.fy * z, z);
    if (previous.moving(at) != 0) p += kStep * kWalkerVelocity;
    const Vector3d q = T_previous_current.inverse() * p;
    return {static_cast<float>(kCamera.fx * q.x() / q.z() + kCamera.cx),
            static_cast<float>(kCamera.fy * q.y() / q.z() + kCamera.cy)};
  }
};

const TwoFrames& Frames() {
  static const TwoFrames frames;
  return frames;
}

/// Whether a pixel and all around it within a radius shows the same panel.
bool IsInside(const cv::Mat1b& panel, const cv::Point& at, int radius) {
  const cv::Rect image({0, 0}, panel.size());
  const cv::Rect window(at.x - radius, at.y - radius, 2 * radius + 1, 2 * radius + 1);
  if ((window & image) != window) return false;
  return cv::countNonZero(panel(window) == panel(at)) == window.area();
}

TEST(TrackPointsOnAFrame, FollowsTheTrueFlowOfTheHallAndOfTheWalker) {
  std::vector<double> errors[2];
  for (const Track& track : Frames().tracks) {
    const cv::Point at(track.previous);
    if (!IsInside(Frames().previous.panel, at, 6)) continue;  // windows across an edge see both
    const bool moves = Frames().previous.moving(at) != 0;
    errors[moves ? 1 : 0].push_back(cv::norm(track.current - Frames().TruePlaceOf(track.previous)));
  }
  ASSERT_GE(errors[1].size(), 10U);
  EXPECT_LT(Median(errors[0]), 0.15);
  EXPECT_LT(Median(errors[1]), 0.15);
}

TEST(EstimateFundamentalOnAFrame, ItsLinesPassThroughTheTruePlacesOfTheHall) {
  const FundamentalEstimate estimate = EstimateFundamental(Frames().tracks, {});
  ASSERT_TRUE(estimate.found);
  EXPECT_FALSE(estimate.standing);
  std::vector<double> distances;
  for (int y = 20; y < kCamera.height - 20; y += 10) {
    for (int x = 20; x < kCamera.width - 20; x += 10) {
      if (Frames().previous.moving(y, x) != 0 || Frames().previous.disparity(y, x) <= 0) continue;
      const cv::Point2f pixel(static_cast<float>(x), static_cast<float>(y));
      distances.push_back(EpipolarDistance(estimate.F, {pixel, Frames().TruePlaceOf(pixel)}));
    }
  }
  std::sort(distances.begin(), distances.end());
  EXPECT_LT(distances[distances.size() / 2], 0.2);
  EXPECT_LT(distances[distances.size() * 95 / 100], 0.6);
}

TEST(DistanceFromStatic, OfAStandingCameraIsTheWayThePointWent) {
  FundamentalEstimate estimate;
  estimate.standing = true;
  estimate.F(1, 2) = -1, estimate.F(2, 1) = 1;  // whose lines are the rows
  EXPECT_NEAR(DistanceFromStatic(estimate, {{10, 10}, {13, 14}}), 5, 1e-9);
  estimate.standing = false;
  EXPECT_NEAR(DistanceFromStatic(estimate, {{10, 10}, {13, 14}}), 4, 1e-9);
}

TEST(TestAgainstEpipolarLinesOnAFrame, TheWalkerIsDynamicAndTheHallIsNot) {
  const FundamentalEstimate estimate = EstimateFundamental(Frames().tracks, {});
  double walker = 0, walker_found = 0, hall = 0, hall_found = 0;
  std::vector<double> disparity_errors;
  for (const TestedPoint& point :
       TestAgainstEpipolarLines(Frames().tracks, estimate, Frames().disparity, {})) {
    const cv::Point at(cvRound(point.position.x), cvRound(point.position.y));
    if (!IsInside(Frames().current.panel, at, 6)) continue;
    const bool moves = Frames().current.moving(at) != 0;
    (moves ? walker : hall) += 1;
    (moves ? walker_found : hall_found) += point.IsDynamic() ? 1 : 0;
    disparity_errors.push_back(std::abs(point.disparity - Frames().current.disparity(at)));
  }
  ASSERT_GE(walker, 10);
  EXPECT_LT(Median(disparity_errors), 0.3);
  EXPECT_GT(walker_found / walker, 0.7);
  EXPECT_LT(hall_found / hall, 0.03);
}

/// The part of the image around the walker, cut into superpixels with planes.
struct Cut {
  cv::Rect roi = cv::Rect(260, 120, 260, 300);
  Superpixels superpixels;
  std::vector<DisparityPlane> planes;
  std::vector<int> panel;         // per superpixel: the one that nine tenths of it show, else -1
  std::vector<double> disparity;  // per superpixel: the mean of the truth

  Cut() {
    const cv::Mat1b image = Frames().current.left(roi).clone();
    superpixels = SegmentUnstable(image, ColourScale(image, {}), {});
    planes = FitDisparityPlanes(superpixels, Frames().disparity(roi), {});
    std::vector<std::map<int, int>> votes(planes.size());
    disparity.assign(planes.size(), 0);
    for (int y = 0; y < roi.height; ++y) {
      for (int x = 0; x < roi.width; ++x) {
        ++votes[Of(x, y)][Frames().current.panel(roi.y + y, roi.x + x)];
        disparity[Of(x, y)] += double{Frames().current.disparity(roi.y + y, roi.x + x)} /
                               superpixels.centres[Of(x, y)].pixels;
      }
    }
    for (std::size_t k = 0; k < votes.size(); ++k) {
      panel.push_back(-1);
      for (const auto& [seen, pixels] : votes[k]) {
        if (pixels * 10 >= superpixels.centres[k].pixels * 9) panel.back() = seen;
      }
    }
  }
  /// Difference of the true disparities of two superpixels.
  double Step(const BoundaryKey& key) const {
    return std::abs(disparity[static_cast<std::size_t>(key.first)] -
                    disparity[static_cast<std::size_t>(key.second)]);
  }
  std::size_t Of(int x, int y) const { return static_cast<std::size_t>(superpixels.labels(y, x)); }
};

const Cut& TheCut() {
  static const Cut cut;
  return cut;
}

TEST(FitDisparityPlanesOnAFrame, AreTheTruePlanesOfTheSurfaces) {
  std::vector<double> squares(TheCut().planes.size(), 0);
  for (int y = 0; y < TheCut().roi.height; ++y) {
    for (int x = 0; x < TheCut().roi.width; ++x) {
      const std::size_t k = TheCut().Of(x, y);
      const float truth = Frames().current.disparity(TheCut().roi.y + y, TheCut().roi.x + x);
      const double error = TheCut().planes[k].At(x, y) - truth;
      squares[k] += error * error / TheCut().superpixels.centres[k].pixels;
    }
  }
  std::vector<double> rms;
  std::size_t pure = 0;
  for (std::size_t k = 0; k < squares.size(); ++k) {
    if (TheCut().panel[k] <= 0 || TheCut().superpixels.centres[k].pixels < 60) continue;
    ++pure;
    if (TheCut().planes[k].valid) rms.push_back(std::sqrt(squares[k]));
  }
  ASSERT_GE(rms.size(), 60U);
  EXPECT_GT(static_cast<double>(rms.size()), 0.9 * static_cast<double>(pure));
  std::sort(rms.begin(), rms.end());
  EXPECT_LT(rms[rms.size() / 2], 0.33);  // pixels, of superpixels of 16 by 16
  EXPECT_LT(rms[rms.size() * 9 / 10], 1.5);
}

/// What the labels say of the walker's outline and of the inside of surfaces, in shares.
struct LabelShares {
  double outline = 0, outline_right = 0, inner = 0, inner_occluded = 0;
};

LabelShares SharesOf(const std::map<BoundaryKey, BoundaryType>& boundaries) {
  const int walker = static_cast<int>(test::StaticHall().size()) + 1;
  LabelShares s;
  for (const auto& [key, type] : boundaries) {
    const int i = TheCut().panel[static_cast<std::size_t>(key.first)],
              j = TheCut().panel[static_cast<std::size_t>(key.second)];
    if (i <= 0 || j <= 0 || type == BoundaryType::kUnknown) continue;
    if (i == j) {
      ++s.inner;
      s.inner_occluded += IsOcclusion(boundaries, key.first, key.second) ? 1 : 0;
    } else if ((i == walker || j == walker) && TheCut().Step(key) > 6) {  // not at his feet
      ++s.outline;
      s.outline_right +=
          type == (i == walker ? BoundaryType::kLeftOcclusion : BoundaryType::kRightOcclusion);
    }
  }
  return s;
}

TEST(LabelBoundariesOnAFrame, TheWalkerOccludesTheHallAndASurfaceDoesNotOccludeItself) {
  const cv::Mat1f truth = Frames().current.disparity(TheCut().roi).clone();
  const auto true_planes = FitDisparityPlanes(TheCut().superpixels, truth, {});
  const LabelShares by_truth =
      SharesOf(LabelBoundaries(TheCut().superpixels.labels, true_planes, {}));
  ASSERT_GE(by_truth.outline, 10);
  EXPECT_GT(by_truth.outline_right / by_truth.outline, 0.95);
  EXPECT_LT(by_truth.inner_occluded / by_truth.inner, 0.02);
  // SGBM carries the nearer disparity beyond the outline: planes there are mixed.
  const LabelShares by_sgbm =
      SharesOf(LabelBoundaries(TheCut().superpixels.labels, TheCut().planes, {}));
  EXPECT_GT(by_sgbm.outline_right / by_sgbm.outline, 0.7);
  EXPECT_LT(by_sgbm.inner_occluded / by_sgbm.inner, 0.05);
}

TEST(MarkRegionOnAFrame, ARectangleAroundTheWalkerGrowsFromPointsOnHim) {
  const auto boundaries = LabelBoundaries(TheCut().superpixels.labels, TheCut().planes, {});
  cv::Rect truth;
  std::vector<cv::Point> points;
  for (int y = 0; y < TheCut().roi.height; ++y) {
    for (int x = 0; x < TheCut().roi.width; ++x) {
      if (Frames().current.moving(TheCut().roi.y + y, TheCut().roi.x + x) == 0) continue;
      truth |= cv::Rect(x, y, 1, 1);
      if (x % 15 == 0 && y % 15 == 0) points.emplace_back(x, y);
    }
  }
  const auto box = MarkRegion(points, TheCut().superpixels.labels, boundaries, {});
  ASSERT_TRUE(box);
  const double shared = (*box & truth).area();
  // His feet stand on the floor: there is no occlusion below them.
  EXPECT_GT(shared / (box->area() + truth.area() - shared), 0.7) << *box << " for " << truth;
}

}  // namespace
}  // namespace aisle::slam::dynamic
