#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <gtest/gtest.h>

#include "slam/feature/extract.h"
#include "slam/map/create_landmarks.h"
#include "slam/map/match_keyframe.h"
#include "slam/place/find_loop.h"
#include "slam/stereo/match_stereo.h"
#include "tests/slam/face/real_sequences.h"

namespace aisle::slam {
namespace {

/// How far, in pixels to first order, a match of two views lies from their epipolar geometry
/// (Sampson's distance; Hartley and Zisserman 2004, equation 11.9).
struct EpipolarError {
  Eigen::Vector3d before, now;  // K^-1 (u, v, 1)
  double focal_px;

  template <typename T>
  bool operator()(const T* rotation, const T* direction, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    Eigen::Matrix<T, 3, 3> R;
    ceres::AngleAxisToRotationMatrix(rotation, R.data());
    const Vector t = Eigen::Map<const Vector>(direction);
    const Vector line_now = t.cross(R * before.cast<T>());              // E x
    const Vector line_before = R.transpose() * now.cast<T>().cross(t);  // E^T x'
    residual[0] = focal_px * line_now.dot(now.cast<T>()) /
                  sqrt(line_now.template head<2>().squaredNorm() +
                       line_before.template head<2>().squaredNorm());
    return true;
  }
};

using Rays = std::vector<Eigen::Vector3d>;

/// The pose now of the view before, up to scale, that fits all pairs of rays best; from `start` on.
Eigen::Isometry3d FitEpipolarGeometry(const Rays& before, const Rays& now, double focal_px,
                                      const Eigen::Isometry3d& start) {
  Eigen::Vector3d direction = start.translation(), rotation;
  const Eigen::Matrix3d R = start.linear();
  ceres::RotationMatrixToAngleAxis(R.data(), rotation.data());
  ceres::Problem problem;
  for (std::size_t i = 0; i < now.size(); ++i) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<EpipolarError, 1, 3, 3>(
                                 new EpipolarError{before[i], now[i], focal_px}),
                             new ceres::CauchyLoss(0.5), rotation.data(), direction.data());
  }
  problem.SetManifold(direction.data(), new ceres::SphereManifold<3>);
  ceres::Solver::Summary summary;
  ceres::Solve({}, &problem, &summary);
  EXPECT_EQ(summary.termination_type, ceres::CONVERGENCE) << summary.FullReport();
  return Eigen::Translation3d(direction) *
         Eigen::AngleAxisd(rotation.norm(), rotation.normalized());
}

/// Four stereo pairs of EuRoC, (0, 1) and (2, 3) showing one place each, as keyframes of a map that
/// knows nothing of how they lie to each other.
class LoopPairs : public testing::Test {
 protected:
  void SetUp() override {
    if (!HasRealData("euroc-loop-pairs"))
      GTEST_SKIP() << "no data at " << TestData("euroc-loop-pairs");
    const std::filesystem::path root = TestData("euroc-loop-pairs");
    const EurocRectifier rectifier(ReadEurocCamera(root / "sensorLeft.yaml"),
                                   ReadEurocCamera(root / "sensorRight.yaml"), {752, 480});
    camera = rectifier.camera();
    T_body_rig = rectifier.T_body_rig();
    for (int i = 0; i < 4; ++i) {
      const auto read = [&](const char* side) {
        return cv::imread(root / fmt::format("{}_img_{}.png", side, i), cv::IMREAD_GRAYSCALE);
      };
      AddKeyframe(rectifier.Rectify(i, i, read("left"), read("right")));
    }
  }

  void AddKeyframe(const StereoImages& images) {
    const ImageFeatures left = ExtractFeatures(images.left, {}, {});
    const ImageFeatures right = ExtractFeatures(images.right, {}, {});
    const std::vector<Disparity> disparities = MatchStereo(left, right, camera, {});
    auto frame = std::make_shared<Frame>();
    frame->features = left.features;
    for (std::size_t i = 0; i < disparities.size(); ++i) {
      const Keypoint& keypoint = left.features.keypoints[i];
      frame->measurements.push_back({{keypoint.pixel.x, keypoint.pixel.y, disparities[i].value},
                                     left.pyramid.scales[static_cast<std::size_t>(keypoint.level)],
                                     disparities[i].sigma});
    }
    frame->grid = FeatureGrid(left.features.keypoints, images.left.size());
    Keyframe keyframe;
    keyframe.id = map.NextKeyframeId();
    keyframe.frame = frame;
    if (keyframe.id.value > 0) keyframe.parent = {keyframe.id.value - 1};
    keyframe.T_world_rig.translation().x() = 100.0 * static_cast<double>(keyframe.id.value);
    keyframe.landmarks.resize(frame->features.keypoints.size());
    MapEdit edit;
    edit.new_landmarks = CreateLandmarks(keyframe, camera, {});
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
  }

  /// How far the body moved between two keyframes: what the data states, as its truth is the
  /// body's.
  double BodyBaseline(const LoopEdge& loop) const {
    return (T_body_rig * loop.T_matched_current * T_body_rig.inverse()).translation().norm();
  }

  /// T_current_matched up to scale, from the left images alone: the five-point method's, which fits
  /// five matches, fitted to all that agree with it.
  Eigen::Isometry3d FivePointPose(KeyframeId current, KeyframeId matched) const {
    const Keyframe& keyframe = map.At(matched);
    const Frame& frame = *map.At(current).frame;
    std::vector<cv::Point2f> before, now;
    for (const Match& match : MatchKeyframe(map, keyframe, frame, 50, 0.8)) {
      const auto old = static_cast<std::size_t>(map.At(match.landmark).observations[0].feature);
      before.push_back(keyframe.frame->features.keypoints[old].pixel);
      now.push_back(frame.features.keypoints[static_cast<std::size_t>(match.feature)].pixel);
    }
    const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    cv::Mat1b inlier;
    cv::Mat R, t;
    const cv::Mat E = cv::findEssentialMat(before, now, K, cv::RANSAC, 0.999, 1.0, inlier);
    cv::recoverPose(E, before, now, K, R, t, inlier);
    using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::Map<const Matrix3>(R.ptr<double>());
    pose.translation() = Eigen::Map<const Eigen::Vector3d>(t.ptr<double>());
    const auto agreeing = [&](const std::vector<cv::Point2f>& pixels) {
      Rays rays;
      for (int i = 0; i < inlier.rows; ++i) {
        const cv::Point2f& pixel = pixels[static_cast<std::size_t>(i)];
        if (inlier(i))
          rays.emplace_back((pixel.x - camera.cx) / camera.fx, (pixel.y - camera.cy) / camera.fy,
                            1);
      }
      return rays;
    };
    return FitEpipolarGeometry(agreeing(before), agreeing(now), camera.fx, pose);
  }

  StereoCamera camera;
  Eigen::Isometry3d T_body_rig;
  Map map;
};

TEST_F(LoopPairs, RevisitsAreFoundAndMeasured) {
  LoopOptions options;
  options.least_inliers = 25;  // from single keyframes, without the landmarks of neighbours
  const auto first = VerifyLoop(map, {1}, {0}, camera, 8, options);
  ASSERT_TRUE(first);
  // The stated pose of this pair leaves its images' epipolar lines by 13 pixels (median), the one
  // measured by half a pixel: two centimetres is as near as the two can come.
  EXPECT_NEAR(BodyBaseline(*first), 0.411, 0.02);
  const auto second = VerifyLoop(map, {3}, {2}, camera, 8, options);
  ASSERT_TRUE(second);
  EXPECT_NEAR(BodyBaseline(*second), 0.318, 0.01);
}

TEST_F(LoopPairs, ARevisitIsWhereTheFivePointMethodSeesIt) {
  LoopOptions options;
  options.least_inliers = 25;
  for (const auto& [current, matched] : {std::pair<int, int>{1, 0}, {3, 2}}) {
    const auto loop = VerifyLoop(map, {current}, {matched}, camera, 8, options);
    ASSERT_TRUE(loop);
    const Eigen::Isometry3d ours = loop->T_matched_current.inverse();
    const Eigen::Isometry3d theirs = FivePointPose({current}, {matched});
    // From one camera, a turn looks like a step aside: over baselines of a tenth of the depth, 0.1
    // in the direction is worth 0.01 in the rotation.
    EXPECT_LT(Eigen::AngleAxisd(ours.linear().transpose() * theirs.linear()).angle(), 0.015);
    EXPECT_GT(ours.translation().normalized().dot(theirs.translation()), std::cos(0.1));
  }
}

TEST_F(LoopPairs, DifferentPlacesAreNotTakenForOne) {
  for (const auto& [current, matched] :
       {std::pair<int, int>{2, 0}, {2, 1}, {3, 0}, {3, 1}, {0, 2}, {1, 3}}) {
    EXPECT_FALSE(VerifyLoop(map, {current}, {matched}, camera, 8, {}))
        << current << " and " << matched;
  }
}

TEST_F(LoopPairs, TheOtherVisitIsTheMostAlike) {
  std::vector<std::vector<Descriptor>> images;
  for (const auto& [id, keyframe] : map.keyframes()) {
    images.push_back(keyframe->frame->features.descriptors);
  }
  const Vocabulary vocabulary = Vocabulary::Train(images, {.depth = 3});
  for (const auto& [current, other] : {std::pair<int, int>{0, 1}, {1, 0}, {2, 3}, {3, 2}}) {
    PlaceIndex index;
    for (int i = 0; i < 4; ++i) {
      if (i != current) index.Add({i}, vocabulary.Describe(images[static_cast<std::size_t>(i)]));
    }
    const auto found = index.Query(vocabulary.Describe(images[static_cast<std::size_t>(current)]));
    EXPECT_EQ(found.front().keyframe, KeyframeId{other}) << "asked for " << current;
  }
}

TEST_F(LoopPairs, KeyframesBesideTheNewestAreAskedForItsLoop) {
  LoopOptions options;
  options.least_inliers = 25;
  Keyframe twin =
      map.At(KeyframeId{1});  // the same view three keyframes later: it shares every landmark
  twin.id = map.NextKeyframeId();
  twin.parent = {3};
  MapEdit edit;
  edit.new_keyframes = {twin};
  map.Apply(edit);
  const auto own = VerifyLoop(map, twin.id, {0}, camera, 8, options);
  ASSERT_TRUE(own);
  const std::vector<LoopEdge> beside = SeenBeside(map, *own, camera, 8, options);
  ASSERT_EQ(beside.size(), 1u);
  EXPECT_EQ(beside[0].current, KeyframeId{1});
  EXPECT_EQ(beside[0].matched, KeyframeId{0});
  EXPECT_NEAR(BodyBaseline(beside[0]), 0.411, 0.02);
  options.neighbours = 2;  // it stands further back
  EXPECT_TRUE(SeenBeside(map, *own, camera, 8, options).empty());
  options.neighbours = 3;
  options.neighbour_shared = 100000;
  EXPECT_TRUE(SeenBeside(map, *own, camera, 8, options).empty());
}

/// Loops as a drive would find them, each confirmed by so many landmarks.
std::vector<LoopEdge> LoopsWithCorrections(const std::vector<double>& corrections_m,
                                           int inliers = 100) {
  std::vector<LoopEdge> loops;
  for (const double correction_m : corrections_m) {
    LoopEdge loop{{1}, {0}, Eigen::Isometry3d::Identity(), inliers};
    loop.T_matched_current.translation().x() = 100 + correction_m;
    loops.push_back(loop);
  }
  return loops;
}

TEST_F(LoopPairs, OnlyLoopsThatAgreeAreBelieved) {
  LoopOptions options;
  EXPECT_EQ(AgreeingLoops(map, LoopsWithCorrections({0.2, 0.21, 0.19}), options).size(), 3u);
  EXPECT_TRUE(AgreeingLoops(map, LoopsWithCorrections({0.2}), options).empty());
  EXPECT_TRUE(AgreeingLoops(map, LoopsWithCorrections({2, -0.5, 0.2}), options).empty());
  // A rack's pitch after a hundred metres: more than odometry can have drifted.
  EXPECT_TRUE(AgreeingLoops(map, LoopsWithCorrections({2.7, 2.7, 2.7}), options).empty());
  EXPECT_TRUE(AgreeingLoops(map, {}, options).empty());
}

TEST_F(LoopPairs, TwoClearLoopsAreBelievedAndOfFaintOnesThree) {
  EXPECT_EQ(AgreeingLoops(map, LoopsWithCorrections({0.2, 0.21}, 60), {}).size(), 2u);
  EXPECT_TRUE(AgreeingLoops(map, LoopsWithCorrections({0.2, 0.21}, 40), {}).empty());
  EXPECT_EQ(AgreeingLoops(map, LoopsWithCorrections({0.2, 0.21, 0.19}, 40), {}).size(), 3u);
  EXPECT_TRUE(AgreeingLoops(map, LoopsWithCorrections({0.2}, 500), {}).empty());
  // What does not agree confirms nothing.
  EXPECT_TRUE(AgreeingLoops(map, LoopsWithCorrections({2, 0.2, 0.21}, 50), {}).empty());
}

}  // namespace
}  // namespace aisle::slam
