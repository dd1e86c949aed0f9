#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "simulator/world/warehouse.h"
#include "tests/simulator/world/mesh_items.h"

namespace aisle::sim {
namespace {

using test::Box;

struct Built {
  WorldParts parts;
  Eigen::Isometry3f pose;  ///< of the rack: x along the row, y across, z up

  std::vector<std::size_t> Triangles(const std::string& name) const {
    return test::TrianglesOf(parts.instances, parts.statics, name);
  }
  std::vector<Box> Items(const std::string& name) const {
    return test::ItemsOf(parts.statics.mesh, Triangles(name), pose);
  }
};

/// The rack alone, in its own frame as well.
Built Build(const RackSpec& rack, std::uint64_t seed) {
  Scene scene;
  scene.racks = {rack};
  Built built;
  WorldBuilder builder(&built.parts);
  AddRacks(scene, {}, seed, &builder);
  built.pose = At(static_cast<float>(rack.from.x()), static_cast<float>(rack.from.y()), 0,
                  static_cast<float>(rack.heading_rad));
  return built;
}

RackSpec Rack(double bay_m, double depth_m, double level_m, GoodsKind goods, int bays = 3,
              int levels = 2) {
  RackSpec rack;
  rack.bays = bays;
  rack.bay_m = bay_m;
  rack.depth_m = depth_m;
  rack.levels = levels;
  rack.level_m = level_m;
  rack.fill = 1;
  rack.goods = goods;
  return rack;
}

/// Racks for pallets, shelving, and the smallest that a scene file may ask for.
std::vector<RackSpec> AllSorts() {
  std::vector<RackSpec> racks;
  for (const GoodsKind goods : {GoodsKind::kMixed, GoodsKind::kCartons, GoodsKind::kDrums,
                                GoodsKind::kTotes, GoodsKind::kWrapped, GoodsKind::kIdentical}) {
    racks.push_back(Rack(2.7, 1.1, 1.6, goods));
    racks.push_back(Rack(1.9, 1.2, 0.75, goods));
    racks.push_back(Rack(1.2, 0.5, 0.6, goods));
    racks.push_back(Rack(0.6, 0.3, 0.3, goods));
  }
  return racks;
}

template <class Check>
void ForEveryRack(const Check& check) {
  for (const RackSpec& rack : AllSorts()) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(fmt::format("bay {} m, depth {} m, level {} m, goods {}, seed {}", rack.bay_m,
                               rack.depth_m, rack.level_m, static_cast<int>(rack.goods), seed));
      check(rack, Build(rack, seed));
      if (testing::Test::HasFailure()) return;
    }
  }
}

int LevelOf(const RackSpec& rack, const Box& item) {
  return static_cast<int>((item.min().z() + 1e-3) / rack.level_m);
}
int BayOf(const RackSpec& rack, const Box& item) {
  return static_cast<int>(std::floor(item.center().x() / rack.bay_m));
}

TEST(Racks, GoodsRestOnTheirShelf) {
  ForEveryRack([](const RackSpec& rack, const Built& built) {
    std::map<std::pair<int, int>, float> lowest;  // over the shelf, by level and bay
    for (const Box& item : built.Items("goods_0")) {
      const int level = LevelOf(rack, item);
      ASSERT_GE(level, 0);
      ASSERT_LE(level, rack.levels);
      const float above = item.min().z() - static_cast<float>(level * rack.level_m);
      const auto [entry, is_new] = lowest.try_emplace({level, BayOf(rack, item)}, above);
      entry->second = std::min(entry->second, above);
    }
    for (const auto& [place, above] : lowest) {
      EXPECT_NEAR(above, 0, 1e-3) << "level " << place.first << ", bay " << place.second;
    }
  });
}

TEST(Racks, GoodsStayInTheirBayAndUnderTheNextBeam) {
  constexpr float kHalfPost_m = 0.05f, kBeam_m = 0.12f;
  constexpr float kAskew_m = 0.03f;  // what a hand puts down a little askew reaches over
  ForEveryRack([&](const RackSpec& rack, const Built& built) {
    for (const Box& item : built.Items("goods_0")) {
      const int bay = BayOf(rack, item);
      ASSERT_GE(bay, 0);
      ASSERT_LT(bay, rack.bays);
      const float start = static_cast<float>(bay * rack.bay_m);
      EXPECT_GE(item.min().x(), start + kHalfPost_m - kAskew_m);
      EXPECT_LE(item.max().x(), start + static_cast<float>(rack.bay_m) - kHalfPost_m + kAskew_m);
      const double next = (LevelOf(rack, item) + 1) * rack.level_m;
      EXPECT_LE(item.max().z(), static_cast<float>(next) - kBeam_m);
      // Pallets of 1.2 m may overhang a shallower rack, as they do.
      const float half = std::max(0.6f, static_cast<float>(rack.depth_m) / 2);
      EXPECT_LE(std::max(item.max().y(), -item.min().y()), half + 0.09f);
    }
  });
}

TEST(Racks, NothingStandsInPostsBeamsOrGuards) {
  ForEveryRack([](const RackSpec& rack, const Built& built) {
    if (rack.bay_m < 1) return;  // bars and goods are of one size there
    const std::vector<Box> frame = built.Items("rack_0");
    for (const Box& item : built.Items("goods_0")) {
      for (const Box& part : frame) EXPECT_LE(test::Overlap(item, part), 0.03f);
    }
  });
}

TEST(Racks, FillSaysWhichShareOfThePlacesIsTaken) {
  RackSpec rack = Rack(2.7, 1.1, 1.6, GoodsKind::kWrapped, 20, 4);
  const auto places = [&](double fill, std::uint64_t seed) {
    rack.fill = fill;
    // On a pallet, what is wrapped is one box; a pallet's boards are low.
    int loads = 0;
    for (const Box& item : Build(rack, seed).Items("goods_0")) loads += item.sizes().z() > 0.15f;
    return loads;
  };
  const int all = places(1, 1);
  EXPECT_EQ(all, 20 * 5 * 3) << "three pallets a bay";
  EXPECT_EQ(places(0, 1), 0);
  for (const double fill : {0.2, 0.5, 0.85}) {
    const double sigma = std::sqrt(all * fill * (1 - fill));
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      EXPECT_NEAR(places(fill, seed), all * fill, 4 * sigma) << fill << ", seed " << seed;
    }
  }
}

TEST(Racks, ASeedMovesGoodsAndNeverTheRack) {
  for (const RackSpec& rack :
       {Rack(2.7, 1.1, 1.6, GoodsKind::kMixed), Rack(2.7, 1.1, 1.6, GoodsKind::kIdentical)}) {
    const Built one = Build(rack, 1), other = Build(rack, 2);
    const auto frame = one.Triangles("rack_0");
    ASSERT_EQ(frame, other.Triangles("rack_0"));
    for (const std::size_t i : frame) {
      for (const std::uint32_t v : one.parts.statics.mesh.triangles[i]) {
        ASSERT_EQ(one.parts.statics.mesh.positions[v], other.parts.statics.mesh.positions[v]);
        ASSERT_EQ(one.parts.statics.mesh.uvs[v], other.parts.statics.mesh.uvs[v]);
      }
    }
    const bool same = one.parts.statics.mesh.positions == other.parts.statics.mesh.positions;
    EXPECT_EQ(same, rack.goods == GoodsKind::kIdentical) << "a full rack of identical goods";
  }
}

/// Where a row stands and how it is turned changes nothing of it (but for the roll of its bars).
TEST(Racks, ARowIsTheSameInItsOwnFrameWhereverItStands) {
  RackSpec rack = Rack(2.7, 1.1, 1.6, GoodsKind::kMixed);
  const Built straight = Build(rack, 3);
  rack.from = {4, -7};
  rack.heading_rad = 2.1;
  const Built turned = Build(rack, 3);
  const auto &a = straight.parts.statics.mesh, &b = turned.parts.statics.mesh;
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (const std::size_t i : straight.Triangles("goods_0")) {
    for (const std::uint32_t v : a.triangles[i]) {
      ASSERT_LT((turned.pose.inverse() * b.positions[v] - a.positions[v]).norm(), 1e-4f);
    }
  }
  for (std::size_t v = 0; v < a.positions.size(); ++v) {
    ASSERT_LT((turned.pose.inverse() * b.positions[v] - a.positions[v]).norm(), 0.06f);
  }
}

TEST(Racks, BaysAreEvenAndPostsStandBetweenThem) {
  const RackSpec rack = Rack(2.4, 1.0, 1.5, GoodsKind::kNothing, 5, 3);
  std::set<int> posts;  // places in centimetres
  for (const Box& part : Build(rack, 1).Items("rack_0")) {
    if (part.sizes().z() < 3) continue;
    EXPECT_NEAR(part.min().z(), 0, 1e-4);
    EXPECT_GT(part.max().z(), 3 * 1.5) << "posts rise over the highest beam";
    posts.insert(static_cast<int>(std::lround(100 * part.center().x())));
  }
  EXPECT_EQ(posts, (std::set<int>{0, 240, 480, 720, 960, 1200}));
}

TEST(Racks, EndSignsHangBelowTheTopOrNotAtAll) {
  for (const double level_m : {0.3, 0.6, 0.9, 1.6}) {
    for (int levels = 0; levels <= 3; ++levels) {
      const Built built = Build(Rack(2.7, 1.1, level_m, GoodsKind::kNothing, 2, levels), 1);
      const float top = static_cast<float>(level_m * levels + 0.6);
      int signs = 0;
      for (const Box& item : built.Items("rack_0")) {
        if (item.sizes().x() > 0.03f || item.sizes().z() < 0.69f) continue;
        ++signs;
        EXPECT_LT(item.max().z(), top) << level_m << " x " << levels;
        EXPECT_GT(item.min().z(), 0.3f) << level_m << " x " << levels;
      }
      EXPECT_EQ(signs, top > 1.15f ? 2 : 0) << level_m << " x " << levels;
    }
  }
}

}  // namespace
}  // namespace aisle::sim
