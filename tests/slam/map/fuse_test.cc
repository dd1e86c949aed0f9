#include "slam/map/fuse.h"

#include <gtest/gtest.h>

#include "slam/map/landmarks_of.h"

namespace aisle::slam {
namespace {

/// Two keyframes in one place. The first sees a landmark exactly where it is; the second has one
/// feature that looks like it, `off` from there in pixels and disparity, and names none.
class TwoKeyframes {
 public:
  explicit TwoKeyframes(const Eigen::Vector3d& off) {
    const Eigen::Vector3d uvd = Project(camera_, {0.2, 0.1, 4});
    for (const Eigen::Vector3d& seen : {uvd, Eigen::Vector3d(uvd + off)}) {
      auto frame = std::make_shared<Frame>();
      frame->features.keypoints.push_back(
          {cv::Point2f(static_cast<float>(seen.x()), static_cast<float>(seen.y())), 0, 0, 50});
      frame->features.descriptors.push_back({1, 2, 3, 4});
      frame->measurements.push_back({seen, kSigmaPx, kSigmaPx});
      frame->grid = FeatureGrid(frame->features.keypoints, {camera_.width, camera_.height});
      Keyframe keyframe;
      keyframe.id = map_.NextKeyframeId();
      keyframe.frame = frame;
      keyframe.landmarks.resize(1);
      MapEdit edit;
      edit.new_keyframes = {keyframe};
      map_.Apply(edit);
    }
    MapEdit edit;
    edit.new_landmarks.emplace_back();
    edit.new_landmarks[0].position = Backproject(camera_, uvd);
    edit.new_landmarks[0].observations = {{{0}, 0}};
    edit.new_landmarks[0].created_by = {0};
    map_.Apply(edit);
  }

  /// Whether the second keyframe sees the landmark after fusing.
  bool Fused(FuseBound bound) const {
    const std::vector<LandmarkId> landmarks = LandmarksOf(map_, {{0}});
    return FuseInto(map_, {1}, landmarks, camera_, 8, {}, bound).links.size() == 1;
  }

 private:
  static constexpr double kSigmaPx = 0.7;
  StereoCamera camera_;
  Map map_;
};

TEST(FuseInto, TakesWhatLiesWithinTheErrorsOfItsMeasurement) {
  for (const Eigen::Vector3d& off :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, -1, 0.5), Eigen::Vector3d(0, 0, 1.5)}) {
    EXPECT_TRUE(TwoKeyframes(off).Fused(FuseBound::kChi2)) << off.transpose();
    EXPECT_TRUE(TwoKeyframes(off).Fused(FuseBound::kRadius)) << off.transpose();
  }
}

TEST(FuseInto, AmongNeighboursNothingIsFusedThatChiSquareTellsApart) {
  // 2.8 of 0.7 pixels are 16 squared deviations; 95 % of measurements keep below 7.8.
  for (const Eigen::Vector3d& off :
       {Eigen::Vector3d(2.8, 0, 0), Eigen::Vector3d(0, -2.8, 0), Eigen::Vector3d(0, 0, 2.8)}) {
    EXPECT_FALSE(TwoKeyframes(off).Fused(FuseBound::kChi2)) << off.transpose();
    EXPECT_TRUE(TwoKeyframes(off).Fused(FuseBound::kRadius)) << off.transpose();
  }
}

}  // namespace
}  // namespace aisle::slam
