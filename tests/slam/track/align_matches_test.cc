#include "slam/track/align_matches.h"

#include <gtest/gtest.h>

#include "tests/slam/stereo/synthetic_view.h"
#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

/// A wall 5 m ahead with corners on a grid of whole pixels, seen from the origin by a keyframe and
/// from a little aside now: corners are found on the nearest whole pixels, as FAST finds them.
class AlignMatchesTest : public testing::Test {
 protected:
  static constexpr double kWall_m = 5;

  void SetUp() override {
    Keyframe keyframe;
    keyframe.id = map.NextKeyframeId();
    keyframe.frame = See(Eigen::Isometry3d::Identity(), true);
    keyframe.landmarks.resize(static_cast<std::size_t>(keyframe.frame->size()));
    MapEdit edit;
    edit.new_landmarks = CreateLandmarks(keyframe, camera, {});
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
  }

  /// Where the corner that lies on whole pixel `corner` of the keyframe is for a rig that stands
  /// so.
  Eigen::Vector3d SeenFrom(const Eigen::Isometry3d& T_world_rig, const cv::Point& corner) const {
    const double disparity = camera.fx * camera.baseline_m / kWall_m;
    const Eigen::Vector3d on_wall = Backproject(
        camera, {static_cast<double>(corner.x), static_cast<double>(corner.y), disparity});
    return Project(camera, T_world_rig.inverse() * on_wall);
  }

  std::shared_ptr<const Frame> See(const Eigen::Isometry3d& T_world_rig, bool keeps_patches) const {
    // The wall faces both views, so one is the other shifted.
    const Eigen::Vector3d shift = SeenFrom(T_world_rig, {0, 0});
    ImageFeatures image;
    image.pyramid.levels = {Render({camera.width, camera.height}, [&](double u, double v) {
      return texture(u - shift.x(), v - shift.y());
    })};
    image.pyramid.scales = {1};
    image.pyramid.steps = {{1, 1}};
    auto frame = std::make_shared<Frame>();
    for (int y = 60; y < 420; y += 40) {
      for (int x = 60; x < 700; x += 40) {
        const Eigen::Vector3d uvd = SeenFrom(T_world_rig, {x, y});
        Keypoint keypoint;
        keypoint.pixel = {static_cast<float>(std::round(uvd.x())),
                          static_cast<float>(std::round(uvd.y()))};
        image.features.keypoints.push_back(keypoint);
        image.features.descriptors.push_back({});
        frame->measurements.push_back({{keypoint.pixel.x, keypoint.pixel.y, uvd.z()}, 0.7, 0.3});
      }
    }
    if (keeps_patches) frame->patches = CutPatches(image);
    frame->features = std::move(image.features);
    return frame;
  }

  std::vector<Match> AllMatched() const {
    std::vector<Match> matches;
    for (const Landmark* landmark : map.Landmarks()) {
      matches.push_back({landmark->id, landmark->observations.front().feature, 0});
    }
    return matches;
  }

  static std::vector<Measurement> Observed(const Frame& frame, const std::vector<Match>& matches) {
    std::vector<Measurement> observed;
    for (const Match& match : matches) {
      observed.push_back(frame.measurements[static_cast<std::size_t>(match.feature)]);
    }
    return observed;
  }

  /// Of the measured pixels from where the landmarks truly are.
  double Error(const Eigen::Isometry3d& T_world_rig, const std::vector<Match>& matches,
               const std::vector<Measurement>& measured) const {
    double squares = 0;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Eigen::Vector3d truth =
          Project(camera, T_world_rig.inverse() * map.At(matches[i].landmark).position);
      squares += (measured[i].uvd - truth).head<2>().squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(matches.size()));
  }

  const StereoCamera camera;
  const Texture texture{5, 6};
  Map map;
};

TEST_F(AlignMatchesTest, FindsLandmarksBetweenPixels) {
  const Eigen::Isometry3d T_world_rig = At(0.0385, 0);
  const auto frame = See(T_world_rig, true);
  const PlainContext context{map, *frame, camera, 8, {}};
  const std::vector<Match> matches = AllMatched();
  ASSERT_GT(matches.size(), 100u);
  // From a guess of where the rig is that is off by some pixels.
  const auto measured = AlignMatches(context, At(0.05, 0.02).inverse(), matches);
  ASSERT_EQ(measured.size(), matches.size());
  std::size_t aligned = 0;
  for (const Measurement& one : measured) aligned += one.sigma_px < 0.7;
  EXPECT_GT(aligned, matches.size() * 3 / 4);
  EXPECT_GT(Error(T_world_rig, matches, Observed(*frame, matches)), 0.2);
  EXPECT_LT(Error(T_world_rig, matches, measured),
            Error(T_world_rig, matches, Observed(*frame, matches)) / 2);
}

TEST_F(AlignMatchesTest, WithoutPatchesEveryFeatureMeasuresByItself) {
  const auto frame = See(At(0.0385, 0), false);
  const PlainContext context{map, *frame, camera, 8, {}};
  const std::vector<Match> matches = AllMatched();
  const auto measured = AlignMatches(context, At(0.0385, 0).inverse(), matches);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto feature = static_cast<std::size_t>(matches[i].feature);
    EXPECT_EQ(measured[i].uvd, frame->measurements[feature].uvd);
    EXPECT_EQ(measured[i].sigma_px, 0.7);
  }
}

}  // namespace
}  // namespace aisle::slam
