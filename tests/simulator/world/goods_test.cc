#include "simulator/world/goods.h"

#include <gtest/gtest.h>

#include "tests/simulator/world/mesh_items.h"

namespace aisle::sim {
namespace {

using test::Box;

constexpr std::array kKinds = {GoodsKind::kMixed, GoodsKind::kCartons, GoodsKind::kDrums,
                               GoodsKind::kTotes, GoodsKind::kWrapped, GoodsKind::kIdentical};

TriangleMesh Goods(GoodsKind kind, const Eigen::Vector2f& footprint, float height,
                   std::uint64_t seed) {
  TriangleMesh mesh;
  AddGoods(&mesh, {}, Eigen::Isometry3f::Identity(), footprint, height, kind, Dice(seed, {7}));
  return mesh;
}

struct Room {
  Eigen::Vector2f footprint;
  float height;
};

/// Pallets, and shelves from the widest to the smallest a scene file may ask for.
const std::array<Room, 6> kRooms = {{{{1.18f, 0.78f}, 1.2f},
                                     {{1.18f, 0.78f}, 0.31f},
                                     {{0.45f, 0.8f}, 0.9f},
                                     {{0.9f, 1.3f}, 0.5f},
                                     {{0.54f, 0.46f}, 0.25f},
                                     {{0.27f, 0.46f}, 0.15f}}};

template <class Check>
void ForEveryLoad(const Check& check) {
  for (const GoodsKind kind : kKinds) {
    for (const Room& room : kRooms) {
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(fmt::format("kind {}, {} x {} x {} m, seed {}", static_cast<int>(kind),
                                 room.footprint.x(), room.footprint.y(), room.height, seed));
        check(kind, room, seed);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

/// Goods are put down by hand: a carton a little askew reaches over the edge by this much.
constexpr float kAskew_m = 0.045f;

TEST(Goods, StayWithinTheirFootprintAndHeight) {
  ForEveryLoad([](GoodsKind kind, const Room& room, std::uint64_t seed) {
    Box all;
    for (const auto& p : Goods(kind, room.footprint, room.height, seed).positions) all.extend(p);
    if (all.isEmpty()) return;  // no loose carton was small enough
    EXPECT_NEAR(all.min().z(), 0, 1e-5);
    EXPECT_LE(all.max().z(), room.height + 1e-4f);
    EXPECT_LE(all.max().x(), room.footprint.x() / 2 + kAskew_m);
    EXPECT_GE(all.min().x(), -room.footprint.x() / 2 - kAskew_m);
    EXPECT_LE(all.max().y(), room.footprint.y() / 2 + kAskew_m);
    EXPECT_GE(all.min().y(), -room.footprint.y() / 2 - kAskew_m);
  });
}

TEST(Goods, EachRestsOnTheBoardOrOnAnother) {
  constexpr float kGap_m = 0.012f;  // rims of totes, bulges of cartons
  ForEveryLoad([&](GoodsKind kind, const Room& room, std::uint64_t seed) {
    const std::vector<Box> items = test::ItemsOf(Goods(kind, room.footprint, room.height, seed));
    for (const Box& item : items) {
      const bool on_board = item.min().z() < 1e-4f;
      const bool on_another = std::ranges::any_of(items, [&](const Box& below) {
        const Box shared = below.intersection(
            Box(Eigen::Vector3f(item.min().x(), item.min().y(), below.min().z()),
                Eigen::Vector3f(item.max().x(), item.max().y(), below.max().z())));
        return !shared.isEmpty() && std::abs(below.max().z() - item.min().z()) <= kGap_m;
      });
      EXPECT_TRUE(on_board || on_another) << "at " << item.min().transpose();
    }
  });
}

TEST(Goods, DoNotStandInOneAnother) {
  ForEveryLoad([](GoodsKind kind, const Room& room, std::uint64_t seed) {
    const std::vector<Box> items = test::ItemsOf(Goods(kind, room.footprint, room.height, seed));
    for (std::size_t a = 0; a < items.size(); ++a) {
      for (std::size_t b = a + 1; b < items.size(); ++b) {
        EXPECT_LE(test::Overlap(items[a], items[b]), kAskew_m) << a << " and " << b;
      }
    }
  });
}

TEST(Goods, IdenticalOnesAreIdenticalForEverySeedAndOthersAreNot) {
  const Room& pallet = kRooms[0];
  const auto of = [&](GoodsKind kind, std::uint64_t seed) {
    return Goods(kind, pallet.footprint, pallet.height, seed);
  };
  const std::vector<Box> items = test::ItemsOf(of(GoodsKind::kIdentical, 1));
  for (std::uint64_t seed = 2; seed <= 5; ++seed) {
    EXPECT_TRUE(of(GoodsKind::kIdentical, 1).positions ==
                of(GoodsKind::kIdentical, seed).positions);
    EXPECT_TRUE(of(GoodsKind::kIdentical, 1).uvs == of(GoodsKind::kIdentical, seed).uvs);
    EXPECT_FALSE(of(GoodsKind::kCartons, 1).positions == of(GoodsKind::kCartons, seed).positions);
  }
  for (std::size_t a = 0; a < items.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_LT(test::Overlap(items[a], items[b]), 0);
  }
}

TEST(Goods, NothingIsNothing) {
  EXPECT_TRUE(Goods(GoodsKind::kNothing, {1, 1}, 1, 1).positions.empty());
}

/// The sizes of the EUR pallet, EN 13698-1: 1200 x 800 x 144 mm, three lots of blocks, and room
/// for forks between them.
TEST(Pallet, HasTheSizesOfTheStandardAndRoomForForks) {
  TriangleMesh mesh;
  AddPallet(&mesh, {}, Eigen::Isometry3f::Identity());
  Box all;
  const std::vector<Box> boards = test::ItemsOf(mesh);
  for (const Box& board : boards) all.extend(board);
  EXPECT_TRUE(all.sizes().isApprox(Eigen::Vector3f(1.2f, 0.8f, 0.144f), 0.02f));
  EXPECT_NEAR(all.min().z(), 0, 1e-6);
  // Forks are 10 cm wide, 6 cm high and enter along x between the blocks.
  for (const float y : {-0.165f, 0.165f}) {
    const Box fork(Eigen::Vector3f(-0.6f, y - 0.05f, 0.04f),
                   Eigen::Vector3f(0.6f, y + 0.05f, 0.1f));
    for (const Box& board : boards) EXPECT_LE(test::Overlap(fork, board), 0) << y;
  }
}

TEST(LoadedPallet, CarriesItsGoodsOnItsDeck) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TriangleMesh pallet, loaded;
    const Eigen::Isometry3f pose = At(3, -2, 1.6f, 0.5f);
    AddPallet(&pallet, {}, pose);
    AddLoadedPallet(&loaded, {}, pose, 1, GoodsKind::kMixed, Dice(seed, {}));
    float lowest = 1e9f;
    for (std::size_t i = pallet.positions.size(); i < loaded.positions.size(); ++i) {
      lowest = std::min(lowest, loaded.positions[i].z());
    }
    EXPECT_NEAR(lowest, 1.6f + kPalletHeight_m, 1e-4) << seed;
  }
}

}  // namespace
}  // namespace aisle::sim
