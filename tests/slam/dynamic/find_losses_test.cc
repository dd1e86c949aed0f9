#include "slam/dynamic/find_losses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/dynamic_stages.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A walker who crosses before a rig that drives on, and what the paper's method made of it.
class FindLossesTest : public testing::Test {
 protected:
  FindLossesTest() { Play(1.2, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.03))); }

  /// The walker's speed across, and where the rig is a frame later.
  void Play(double speed_mps, const Eigen::Isometry3d& T_world_now) {
    std::vector<test::Panel> panels = test::StaticHall();
    panels.push_back(test::Walker({0.2, 0.1, 3.5}, {speed_mps, 0, 0}));
    const auto before = test::Render(panels, camera_, Eigen::Isometry3d::Identity(), 0);
    const auto now = test::Render(panels, camera_, T_world_now, 0.05);
    T_now_before_ = T_world_now.inverse();
    stages_.left = now.left;
    stages_.paper.emplace();
    dynamic::PaperResult result =
        dynamic::DetectDynamicRegions({before.left, before.right}, {now.left, now.right}, {});
    stages_.regions = result.dynamic;
    stages_.paper->stages = std::move(result.stages);
    cv::Mat1b his;
    cv::compare(now.panel, static_cast<double>(panels.size()), his, cv::CMP_EQ);
    mover_ = {his, cv::boundingRect(his)};
  }

  std::string Loss() const {
    const auto losses = FindLosses(stages_, camera_, {mover_}, T_now_before_);
    return losses.size() == 1 ? losses[0] : "not one answer";
  }
  /// All of the mover's groups found this rectangle, and no other.
  void LetRegionsBe(const std::vector<cv::Rect>& boxes) {
    stages_.regions.regions.clear();
    const auto& groups = stages_.paper->stages.groups;
    for (std::size_t k = 0; k < groups.size(); ++k) {
      const bool on = std::any_of(groups[k].points.begin(), groups[k].points.end(), [&](auto& p) {
        return mover_.pixels(cvRound(p.position.y), cvRound(p.position.x)) != 0;
      });
      if (!on) continue;
      for (const cv::Rect& box : boxes) {
        stages_.regions.regions.push_back({static_cast<int>(k), box, 1});
      }
      return;
    }
  }

  StereoCamera camera_;
  Eigen::Isometry3d T_now_before_;
  DynamicStages stages_;
  MoverTruth mover_;
};

TEST_F(FindLossesTest, TheTestIsOfAMoverWithAGroup) {
  ASSERT_FALSE(stages_.paper->stages.groups.empty());
}

TEST_F(FindLossesTest, TooFewPointsComeFirst) {
  stages_.paper->stages.tracks.clear();
  EXPECT_EQ(Loss(), "few points");
}

TEST_F(FindLossesTest, WithoutDisparityNothingIsTested) {
  stages_.paper->stages.disparity.setTo(kNoDisparity);
  EXPECT_EQ(Loss(), "no disparity");
}

TEST_F(FindLossesTest, LinesThatLeadEverywhereAreWrongWhereTheTrueOnesTell) {
  stages_.paper->stages.fundamental.F.setZero();  // nothing is off such lines
  EXPECT_EQ(Loss(), "wrong lines");
}

TEST_F(FindLossesTest, WhereTheTrueLinesAreSilentTheMotionIsTheCause) {
  stages_.paper->options.epipolar.alpha_px = 500;
  EXPECT_EQ(Loss(), "along its line");
}

TEST_F(FindLossesTest, DynamicPointsWithoutAGroup) {
  stages_.paper->stages.groups.clear();
  EXPECT_EQ(Loss(), "not one group");
}

TEST_F(FindLossesTest, OutlinesAreNamedByHowTheyMiss) {
  const cv::Rect box = mover_.box;
  LetRegionsBe({});
  EXPECT_EQ(Loss(), "no outline");
  LetRegionsBe({{box.x, box.y, box.width, box.height / 4}});
  EXPECT_EQ(Loss(), "outline too small");
  LetRegionsBe({{0, 0, camera_.width, camera_.height}});
  EXPECT_EQ(Loss(), "outline too large");
  LetRegionsBe({{box.x, box.y, box.width, box.height * 2 / 5},
                {box.x, box.y + box.height * 3 / 5, box.width, box.height * 2 / 5}});
  EXPECT_EQ(Loss(), "in parts");
}

TEST_F(FindLossesTest, ARigThatStoodIsAskedForPointsAndNotForLines) {
  T_now_before_.setIdentity();
  stages_.paper->stages.fundamental.F.setZero();
  EXPECT_EQ(Loss(), "wrong lines") << "the walker left his place by more than the threshold";
}

/// All of the image goes by, and the more the farther it is from its middle: a turn is no motion of
/// what stands.
TEST_F(FindLossesTest, ARigThatTurnsOnTheSpotHasNotStood) {
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitY()));
  for (const double speed_mps : {0.0, 1.2}) {
    Play(speed_mps, turned);
    stages_.paper->stages.fundamental.standing = false;
    stages_.paper->stages.fundamental.F.setZero();
    EXPECT_EQ(Loss(), speed_mps == 0 ? "along its line" : "wrong lines");
  }
}

TEST_F(FindLossesTest, EveryMoverHasItsAnswerAndOtherMethodsHaveNone) {
  stages_.paper->stages.tracks.clear();
  EXPECT_THAT(FindLosses(stages_, camera_, {mover_, mover_}, T_now_before_),
              ElementsAre("few points", "few points"));
  EXPECT_THAT(FindLosses(stages_, camera_, {}, T_now_before_), IsEmpty());
  stages_.paper.reset();
  EXPECT_THAT(FindLosses(stages_, camera_, {mover_}, T_now_before_), IsEmpty());
}

}  // namespace
}  // namespace aisle::slam
