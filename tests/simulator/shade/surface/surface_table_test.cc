#include "simulator/shade/surface/surface_table.h"

#include <gtest/gtest.h>

#include <random>

#include "simulator/shade/surface/luminaires.h"
#include "simulator/shade/surface/surface_lanes.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float In(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  Vector3f Point() { return {In(-2, 2), In(-2, 2), In(-2, 2)}; }
  std::size_t Below(std::size_t count) { return engine_() % count; }

 private:
  std::mt19937 engine_;
};

TriangleMesh Triangles(unsigned seed, std::size_t count) {
  Random random(seed);
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 3; ++k) {
      mesh.positions.push_back(random.Point());
      mesh.normals.emplace_back(0, 0, 1);
      mesh.uvs.emplace_back(random.In(-1, 2), random.In(-1, 2));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.materials.push_back(static_cast<std::uint16_t>(i % 3));
  }
  return mesh;
}

std::vector<Material> Materials() {
  std::vector<Material> materials(3);
  materials[0] = {.name = "plain", .albedo = 0.4f};
  materials[1] = {.name = "textured", .albedo = 0.9f, .albedo_texture = 0};
  materials[2] = {.name = "lamp", .albedo = 0.3f, .albedo_texture = 0, .emission = 5};
  return materials;
}

/// The gradient is what takes a way along the surface to the change of the texture coordinates.
TEST(SurfaceTable, GradientsGiveEachEdgeItsTextureCoordinates) {
  const TriangleMesh mesh = Triangles(1, 300);
  const LightGrid grid = MakeLightGrid(mesh, 0.5f);
  const auto table =
      MakeSurfaceTable(mesh, mesh.positions, grid.patches, Materials(), Luminaires::kReflect);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Eigen::Map<const Vector3f> normal(table[i].normal), du(table[i].du), dv(table[i].dv);
    EXPECT_NEAR(normal.norm(), 1, 1e-4);
    EXPECT_NEAR(du.dot(normal), 0, 1e-3f * du.norm() + 1e-5f);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
      const Vector3f edge = mesh.positions[b] - mesh.positions[a];
      const Eigen::Vector2f change = mesh.uvs[b] - mesh.uvs[a];
      const float slack = 1e-4f * edge.norm() * (1 + du.norm() + dv.norm());
      EXPECT_NEAR(du.dot(edge), change.x(), slack) << i;
      EXPECT_NEAR(dv.dot(edge), change.y(), slack) << i;
      EXPECT_NEAR(normal.dot(edge), 0, 1e-4f * edge.norm());
    }
  }
}

TEST(SurfaceTable, APoseChangesWhatAPoseMayAndIsThatOfATableMadeThere) {
  const TriangleMesh mesh = Triangles(2, 60), elsewhere = Triangles(3, 60);
  const LightGrid grid = MakeLightGrid(mesh, 0.5f);
  auto posed =
      MakeSurfaceTable(mesh, mesh.positions, grid.patches, Materials(), Luminaires::kShine);
  PoseSurfaceTable(mesh, elsewhere.positions, posed);
  const auto made =
      MakeSurfaceTable(mesh, elsewhere.positions, grid.patches, Materials(), Luminaires::kShine);
  EXPECT_EQ(std::memcmp(posed.data(), made.data(), made.size() * sizeof(SurfaceRecord)), 0);
}

TEST(SurfaceTable, LampsOfTheWorldShineAndThoseOfMoversReflect) {
  const TriangleMesh mesh = Triangles(4, 3);
  const LightGrid grid = MakeLightGrid(mesh, 0.5f);
  const auto of = [&](Luminaires luminaires) {
    return MakeSurfaceTable(mesh, mesh.positions, grid.patches, Materials(), luminaires);
  };
  const auto shine = of(Luminaires::kShine), reflect = of(Luminaires::kReflect);
  EXPECT_EQ(shine[2].albedo, 1);
  EXPECT_EQ(shine[2].texture, -1);
  EXPECT_EQ(shine[2].f0, -1);
  EXPECT_EQ(reflect[2].albedo, 0.3f);
  EXPECT_EQ(reflect[2].texture, 0);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_EQ(shine[i].albedo, reflect[i].albedo);
    EXPECT_EQ(shine[i].texture, reflect[i].texture);
  }
}

struct Lookup {
  TriangleMesh mesh = Triangles(5, 90);
  LightGrid grid = MakeLightGrid(mesh, 0.3f);
  std::vector<float> slots;
  std::vector<SurfaceRecord> table;
  TexturePool textures{std::vector<Texture>{{"speckle", test::Speckle(64, 1)}}};

  Lookup() : slots(grid.point_of_slot.size()) {
    Random random(6);
    std::vector<float> values;
    for (std::size_t i = 0; i < grid.points.size(); ++i) values.push_back(random.In(0, 9));
    FillSlots(grid, values, slots);
    table = MakeSurfaceTable(mesh, mesh.positions, grid.patches, Materials(), Luminaires::kReflect);
  }
  SurfaceLanes At(const HitLanes& hits) const {
    const RayStep step{{0.002f, 0, 0.0001f}, {0, 0.002f, 0}};
    return LookUp({table.data(), slots.data()}, textures, hits, step);
  }
};

HitLanes RandomHits(Random* random, std::size_t triangles) {
  HitLanes hits{};
  for (int k = 0; k < 8; ++k) {
    hits.record[k] = static_cast<int>(random->Below(triangles));
    hits.u[k] = random->In(0, 1);
    hits.v[k] = random->In(0, 1 - hits.u[k]);
    hits.t[k] = random->In(0.5f, 20);
    hits.dx[k] = random->In(-1, 1);
    hits.dy[k] = random->In(-1, 1);
    hits.dz[k] = 1;
  }
  return hits;
}

/// A lane alone, in all eight places: there the reader takes each field of the record once.
HitLanes Spread(const HitLanes& hits, int k) {
  return {Wide(hits.t[k]),  Wide(hits.u[k]),  Wide(hits.v[k]),        Wide(hits.dx[k]),
          Wide(hits.dy[k]), Wide(hits.dz[k]), WideInt(hits.record[k])};
}

TEST(LookUp, LightIsThatOfOneLaneAndNobodysNeighbourMatters) {
  const Lookup lookup;
  Random random(7);
  for (int round = 0; round < 300; ++round) {
    const HitLanes hits = RandomHits(&random, lookup.mesh.triangles.size());
    const SurfaceLanes all = lookup.At(hits);
    for (int k = 0; k < 8; ++k) {
      const auto record = static_cast<std::size_t>(hits.record[k]);
      const float light =
          ReadLight(lookup.grid.patches[record], lookup.slots, hits.u[k], hits.v[k]);
      EXPECT_EQ(all.irradiance[k], light);
      const SurfaceLanes alone = lookup.At(Spread(hits, k));
      EXPECT_EQ(alone.irradiance[k], all.irradiance[k]);
      // Whether levels are blended is decided for the packet: a fiftieth of a level at most.
      EXPECT_NEAR(alone.reflectance[k], all.reflectance[k], 0.01f);
      if (lookup.table[record].texture < 0) {
        EXPECT_EQ(all.reflectance[k], lookup.table[record].albedo);
      } else {
        EXPECT_LE(all.reflectance[k], lookup.table[record].albedo * 1.0001f);
        EXPECT_GE(all.reflectance[k], 0);
      }
    }
  }
}

TEST(FillSlots, OneLightEverywhereIsReadEverywhere) {
  const TriangleMesh mesh = Triangles(8, 100);
  const LightGrid grid = MakeLightGrid(mesh, 0.3f);
  std::vector<float> slots(grid.point_of_slot.size(), -1.0f);
  FillSlots(grid, std::vector<float>(grid.points.size(), 3.5f), slots);
  Random random(9);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 30; ++k) {
      const float u = k == 0 ? 1.0f : k == 1 ? 0.0f : random.In(0, 1);
      const float v = k == 1 ? 1.0f : random.In(0, 1 - u);
      EXPECT_NEAR(ReadLight(grid.patches[i], slots, u, v), 3.5f, 1e-4f)
          << i << " " << u << " " << v;
    }
  }
}

TEST(LightGrid, HasAPointOnEveryTriangleAndEverySlotInItsArrays) {
  const TriangleMesh mesh = Triangles(10, 100);
  for (const float texel : {0.05f, 0.3f, 100.0f}) {
    const LightGrid grid = MakeLightGrid(mesh, texel);
    ASSERT_EQ(grid.patches.size(), mesh.triangles.size());
    std::vector<int> shown(grid.points.size());
    for (const std::uint32_t point : grid.point_of_slot) {
      if (point >= LightGrid::kExtrapolated) continue;
      ASSERT_LT(point, grid.points.size());
      ++shown[point];
    }
    EXPECT_EQ(std::ranges::count(shown, 0), 0) << "points nobody reads";
    for (const LightPoint& point : grid.points) {
      EXPECT_GE(std::min({point.u, point.v, 1 - point.u - point.v}), -1e-5f);
    }
  }
}

TEST(LightShown, IsTheRectangleNearestToTheTrianglesMiddleOrNone) {
  const World world(test::Hall({.boxes = 0, .lights = 12}));
  const TriangleMesh& mesh = world.statics().mesh;
  constexpr int kSide = 40;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vector3f middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
    std::vector<float> distance;
    for (const AreaLight& light : world.lights()) {
      float least = 1e9f;
      for (int k = 0; k <= kSide * kSide; ++k) {
        const float u = 2.0f * static_cast<float>(k % (kSide + 1)) / kSide - 1;
        const float v = 2.0f * static_cast<float>(k / (kSide + 1)) / kSide - 1;
        least =
            std::min(least, (light.center + u * light.half_u + v * light.half_v - middle).norm());
      }
      distance.push_back(least);
    }
    const float nearest = std::ranges::min(distance);
    const auto shown = LightShown(world, i);
    EXPECT_LE(shown ? distance[*shown] : nearest, nearest + 0.03f) << i;
    EXPECT_TRUE(shown ? nearest < 0.33f : nearest > 0.27f) << i << ": " << nearest;
  }
}

}  // namespace
}  // namespace aisle::sim
