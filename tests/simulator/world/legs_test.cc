#include <gtest/gtest.h>

#include <random>

#include "simulator/world/assets.h"
#include "simulator/world/held.h"
#include "simulator/world/leg_steps.h"
#include "simulator/world/shapes.h"

namespace aisle::sim {
namespace {

const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";

double MeanStride(const std::vector<WalkClip>& walks, const WalkShares& shares) {
  double mean = 0;
  for (std::size_t i = 0; i < walks.size(); ++i) mean += shares.walks[i] * walks[i].stride_m;
  return mean;
}

TEST(WalkShares, SumToOneAndGiveTheStrideThatWasAskedFor) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 500; ++i) {
    std::vector<WalkClip> walks;
    double stride = 0;
    for (int k = 0; k <= i % 4; ++k) walks.push_back({k, stride += 0.1 + unit(random), 1});
    const double asked = 1.2 * stride * unit(random);
    const WalkShares shares = SharesOf(walks, asked);
    float sum = shares.stand;
    int mixed = shares.stand > 0;
    for (const float share : shares.walks) {
      EXPECT_GE(share, 0);
      sum += share;
      mixed += share > 0;
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_LE(mixed, 2) << "only neighbours are mixed";
    EXPECT_NEAR(MeanStride(walks, shares), std::min(asked, stride), 1e-6);
  }
  EXPECT_EQ(SharesOf({{0, 1.4, 1}}, 0).stand, 1);
}

struct Walker {
  std::shared_ptr<const Model> model;
  std::vector<WalkClip> walks;
  std::vector<LegSteps> legs;
};

const Walker& Anton() {
  static const Walker walker = [] {
    AssetLibrary assets(kAssets);
    Walker made{assets.Load("people/worker_anton"), {}, {}};
    for (const char* name : {"walk_slow", "walk", "walk_fast"}) {
      const ClipFacts& facts = assets.Person("worker_anton").clips.at(name);
      made.walks.push_back({made.model->FindClip(name), facts.stride_m, facts.duration_s});
    }
    std::ranges::sort(made.walks, {}, &WalkClip::stride_m);
    for (const char* side : {"left", "right"}) {
      made.legs.emplace_back(*made.model, made.walks, made.model->FindClip("stand"), side);
    }
    return made;
  }();
  return walker;
}

/// A step goes from one place on the floor to the next: it starts at the one, ends a stride ahead
/// at the other, on the same side of the body, and the foot never goes back from swing to stance.
TEST(LegSteps, AStepLeadsFromOnePlaceToTheNext) {
  const Walker& walker = Anton();
  for (const double stride : {0.5, 0.9, 1.4, 1.7}) {
    const WalkShares shares = SharesOf(walker.walks, stride);
    for (const LegSteps& leg : walker.legs) {
      const FootMotion start = leg.At(shares, 0), end = leg.At(shares, 1);
      const double mean = MeanStride(walker.walks, shares);
      EXPECT_NEAR(start.way.norm(), 0, 1e-5);
      EXPECT_NEAR(end.way.x(), mean, 0.01) << stride;
      EXPECT_NEAR(end.way.y(), 0, 0.01) << stride;
      EXPECT_NEAR(end.stride_m, mean, 1e-5);
      EXPECT_EQ(start.swing, 0);
      EXPECT_EQ(end.swing, 1);
      EXPECT_NEAR(end.height_m, start.height_m, 0.005);
      float swing = 0, highest = start.height_m;
      for (double share = 0; share <= 1; share += 0.01) {
        const FootMotion motion = leg.At(shares, share);
        EXPECT_GE(motion.swing, swing - 1e-6f) << share;
        swing = motion.swing;
        highest = std::max(highest, motion.height_m);
      }
      EXPECT_GT(highest, start.height_m + 0.03f) << "the foot is lifted";
    }
  }
}

TEST(LegSteps, TheTwoLegsMirrorEachOtherHalfACycleApart) {
  const Walker& walker = Anton();
  const double apart = std::abs(walker.legs[0].mid_stance() - walker.legs[1].mid_stance());
  EXPECT_NEAR(apart, 0.5, 0.06);
  const WalkShares shares = SharesOf(walker.walks, 1.2);
  const Eigen::Vector2f left = walker.legs[0].PlantUnderBody(shares);
  const Eigen::Vector2f right = walker.legs[1].PlantUnderBody(shares);
  EXPECT_GT(left.y(), 0) << "y is to the left";
  EXPECT_LT(right.y(), 0);
  EXPECT_NEAR(left.y(), -right.y(), 0.03);
}

TEST(RestPhase, IsWhereBothFeetStandInTheSlowestWalk) {
  const Walker& walker = Anton();
  const double phase = RestPhase(walker.legs, walker.walks.size());
  WalkShares slowest{0, std::vector<float>(walker.walks.size(), 0)};
  slowest.walks.front() = 1;
  for (const LegSteps& leg : walker.legs) {
    const double steps = phase - leg.mid_stance();
    const float swing = leg.At(slowest, steps - std::floor(steps)).swing;
    EXPECT_TRUE(swing == 0 || swing == 1) << swing;
  }
  EXPECT_EQ(RestPhase({walker.legs[0]}, 3), 0);
}

/// What is held keeps its place in the frame of what holds it, whatever the pose.
TEST(Carrying, AThingGoesWithItsNodeAndLeavesTheBodyAlone) {
  const Model& model = *Anton().model;
  const int chest = model.FindNode("chest");
  ASSERT_GE(chest, 0);
  const NodeFrames held_at = PoseNodes(model, {});
  TriangleMesh box;
  AddBox(&box, At(0.4f, 0, 1.1f), {0.4f, 0.3f, 0.3f}, BoxPaint::Whole(0));
  const Model loaded = Carrying(model, box, chest, held_at);
  ASSERT_EQ(loaded.bind_positions.size(), model.bind_positions.size() + box.positions.size());
  for (const double time_s : {0.0, 0.3, 0.77}) {
    const PoseLayer layer{model.FindClip("walk"), time_s, 1, -1};
    const NodeFrames frames = PoseNodes(model, {&layer, 1});
    std::vector<Eigen::Vector3f> body, all, normals;
    SkinVertices(model, JointMatrices(model, frames), &body, &normals);
    SkinVertices(loaded, JointMatrices(loaded, frames), &all, &normals);
    EXPECT_TRUE(std::equal(body.begin(), body.end(), all.begin()));
    const auto at = static_cast<std::size_t>(chest);
    const Eigen::Affine3f moved = frames[at] * held_at[at].inverse();
    for (std::size_t i = 0; i < box.positions.size(); ++i) {
      EXPECT_LT((all[body.size() + i] - moved * box.positions[i]).norm(), 1e-5f) << time_s;
    }
  }
}

}  // namespace
}  // namespace aisle::sim
