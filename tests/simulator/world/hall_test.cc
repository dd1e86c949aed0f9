#include <gtest/gtest.h>

#include <random>

#include "simulator/world/goods.h"
#include "simulator/world/warehouse.h"
#include "tests/simulator/world/mesh_items.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using test::Box;

Palette PaletteWithSigns() {
  Palette palette;
  palette.wall_signs.resize(14);
  palette.lamps.assign(4, 7);
  palette.days.resize(4);
  palette.sky = 7;
  return palette;
}

Scene Hall(WallKind walls = WallKind::kPanels) {
  Scene scene;
  scene.hall.from = {-4, -7};
  scene.hall.to = {13, 6.5};
  scene.hall.height_m = 6;
  scene.hall.walls = walls;
  return scene;
}

struct Built {
  WorldParts parts;
  std::vector<std::size_t> Triangles(const std::string& name) const {
    return test::TrianglesOf(parts.instances, parts.statics, name);
  }
  Box Around(const std::string& name) const {
    Box box;
    for (const Box& item : test::ItemsOf(parts.statics.mesh, Triangles(name))) box.extend(item);
    return box;
  }
};

Built Build(const Scene& scene, std::uint64_t seed = 1) {
  Built built;
  WorldBuilder builder(&built.parts);
  const Palette palette = PaletteWithSigns();
  AddFloor(scene, palette, seed, &builder);
  AddMarkings(scene, palette, &builder);
  AddWalls(scene, palette, seed, &builder);
  AddDoors(scene, palette, &builder);
  AddColumns(scene, palette, &builder);
  AddMezzanines(scene, palette, seed, &builder);
  AddLights(scene, palette, &built.parts, &builder);
  return built;
}

/// Distance to the nearest triangle that looks towards the ray, by trying them all.
float Cast(const TriangleMesh& mesh, const Vector3f& origin, const Vector3f& way) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3f &p = mesh.positions[a], u = mesh.positions[b] - p, v = mesh.positions[c] - p;
    const Vector3f across = u.cross(v);
    const float facing = -across.dot(way);
    if (facing <= 0) continue;
    const Vector3f from = origin - p, turned = from.cross(way);
    const float s = v.dot(turned) / facing, t = -u.dot(turned) / facing;
    const float at = across.dot(from) / facing;
    if (at > 0 && s >= 0 && t >= 0 && s + t <= 1) nearest = std::min(nearest, at);
  }
  return nearest;
}

/// No ray that starts in the hall leaves it: a hole in the walls would show the void.
TEST(HallShell, IsClosed) {
  for (const WallKind walls :
       {WallKind::kPanels, WallKind::kBrick, WallKind::kPlain, WallKind::kSky}) {
    const Scene scene = Hall(walls);
    const Built built = Build(scene);
    Box hall(Vector3f(-4, -7, 0), Vector3f(13, 6.5f, 6));
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 2000; ++i) {
      const Vector3f share(unit(random), unit(random), unit(random));
      const Vector3f origin = hall.min() + hall.sizes().cwiseProduct(share);
      const Vector3f way = Vector3f(normal(random), normal(random), normal(random)).normalized();
      const Vector3f ends = way.unaryExpr([](float x) { return x > 0 ? 1.0f : 0.0f; });
      const Vector3f corner = hall.min() + hall.sizes().cwiseProduct(ends);
      const float leaves = (corner - origin).cwiseQuotient(way).minCoeff();
      ASSERT_LE(Cast(built.parts.statics.mesh, origin, way), leaves + 1e-3f)
          << "walls " << static_cast<int>(walls) << ", from " << origin.transpose() << " along "
          << way.transpose();
    }
  }
}

TEST(Floor, IsTiledWithoutGapsOrOverlapsAtOneScale) {
  const Built built = Build(Hall());
  const auto triangles = built.Triangles("floor");
  const TriangleMesh& mesh = built.parts.statics.mesh;
  EXPECT_NEAR(test::AreaOf(mesh, triangles), 17 * 13.5, 1e-3);
  for (const std::size_t i : triangles) {
    const auto& [a, b, c] = mesh.triangles[i];
    EXPECT_EQ(mesh.positions[a].z(), 0);
    EXPECT_NEAR((mesh.uvs[b] - mesh.uvs[a]).norm() * kFloorSheet_m,
                (mesh.positions[b] - mesh.positions[a]).norm(), 1e-4);
  }
  const Built other = Build(Hall(), 2);
  ASSERT_EQ(other.Triangles("floor"), triangles);
  for (const std::size_t i : triangles) {  // a seed turns the slabs and moves none
    for (const std::uint32_t v : mesh.triangles[i]) {
      EXPECT_EQ(other.parts.statics.mesh.positions[v], mesh.positions[v]);
    }
  }
}

MarkingSpec Marking(MarkingSpec::Kind kind) {
  MarkingSpec marking;
  marking.kind = kind;
  marking.from = {5, 2};
  marking.to = {1, -1};
  marking.width_m = 0.12;
  return marking;
}

Built Marked(MarkingSpec::Kind kind) {
  Scene scene = Hall();
  scene.markings = {Marking(kind)};
  return Build(scene);
}

TEST(Markings, LieJustOverTheFloorFaceUpAndWhereTheSceneSays) {
  const std::map<MarkingSpec::Kind, double> areas = {
      {MarkingSpec::Kind::kLine, 5 * 0.12},                   // 3-4-5
      {MarkingSpec::Kind::kBox, 4 * 3 + 2 * (4 + 3) * 0.12},  // its hatch and its frame
      {MarkingSpec::Kind::kCrossing, 4 * 0.35 * 5}};          // bars with gaps of their width
  for (const auto& [kind, area] : areas) {
    const Built built = Marked(kind);
    const TriangleMesh& mesh = built.parts.statics.mesh;
    const auto triangles = built.Triangles("markings");
    EXPECT_NEAR(test::AreaOf(mesh, triangles), area, 1e-3) << static_cast<int>(kind);
    for (const std::size_t i : triangles) {
      for (const std::uint32_t v : mesh.triangles[i]) {
        EXPECT_GT(mesh.positions[v].z(), 0.0005f);
        EXPECT_LT(mesh.positions[v].z(), 0.003f);
        EXPECT_NEAR(mesh.normals[v].z(), 1, 1e-5);
      }
    }
    const Box around = built.Around("markings");
    EXPECT_TRUE(around.min().head<2>().isApprox(Vector2f(1, -1), 0.08f));
    EXPECT_LE(around.max().x(), 5.1f);
    EXPECT_LE(around.max().y(), 2.2f);
  }
}

TEST(Markings, APavementIsRaisedByItsKerb) {
  const Box around = Marked(MarkingSpec::Kind::kPavement).Around("markings");
  EXPECT_TRUE(around.min().isApprox(Vector3f(1, -1, 0), 1e-5f));
  EXPECT_TRUE(around.max().isApprox(Vector3f(5, 2, 0.12f), 1e-5f));
}

TEST(Doors, StandOnTheFloorInTheirWallAtTheirPlace) {
  const std::map<WallSide, Vector3f> inwards = {{WallSide::kNorth, {0, -1, 0}},
                                                {WallSide::kSouth, {0, 1, 0}},
                                                {WallSide::kEast, {-1, 0, 0}},
                                                {WallSide::kWest, {1, 0, 0}}};
  for (const auto& [side, inward] : inwards) {
    Scene scene = Hall();
    DoorSpec door;
    door.wall = side;
    door.at_m = 2.5;
    scene.doors = {door};
    const Built built = Build(scene);
    // Its leaf is the widest thing: its middle is where the scene says.
    std::vector<Box> parts = test::ItemsOf(built.parts.statics.mesh, built.Triangles("door_0"));
    const Box hall(Vector3f(-4, -7, 0), Vector3f(13, 6.5f, 6));
    for (const Box& part : parts) EXPECT_TRUE(hall.contains(part)) << static_cast<int>(side);
    const int along = inward.x() == 0 ? 0 : 1;
    const auto leaf = std::ranges::find_if(
        parts, [&](const Box& part) { return part.sizes().z() > 3 && part.sizes()[along] > 2; });
    ASSERT_NE(leaf, parts.end());
    EXPECT_NEAR(leaf->center()[along], 2.5, 1e-4) << static_cast<int>(side);
    EXPECT_NEAR(leaf->sizes()[along], 3, 1e-4);
    EXPECT_NEAR(leaf->min().z(), 0, 1e-4);
    const Vector3f wall = inward.sum() > 0 ? hall.min() : hall.max();
    EXPECT_LT(std::abs((leaf->center() - wall).dot(inward)), 0.1f) << "at its wall";
  }
}

TEST(Columns, RiseFromFloorToRoofAtTheirPlace) {
  Scene scene = Hall();
  scene.columns.resize(2);
  scene.columns[0].at = {1, 2};
  scene.columns[1] = {.mark = {}, .at = {3, -4}, .size_m = 0.6, .striped = false};
  const Built built = Build(scene);
  for (std::size_t i = 0; i < 2; ++i) {
    const Box column = built.Around(fmt::format("column_{}", i));
    EXPECT_TRUE(column.center().head<2>().isApprox(scene.columns[i].at.cast<float>(), 1e-5f));
    EXPECT_NEAR(column.min().z(), 0, 1e-5);
    EXPECT_NEAR(column.max().z(), 6, 1e-5);
    EXPECT_NEAR(column.sizes().x(), scene.columns[i].size_m, 0.125) << "but for its plinth";
  }
}

/// What shines in the light's arithmetic must be what the camera sees shining.
TEST(Lights, EveryLightIsASeenSurfaceOfItsSizeAndPlace) {
  for (const WallKind walls : {WallKind::kPanels, WallKind::kSky}) {
    Scene scene = Hall(walls);
    scene.lights.resize(2);
    scene.lights[0].rows = 2;
    scene.lights[0].per_row = 3;
    scene.lights[1].from = Eigen::Vector2d(0, 0);
    scene.lights[1].to = Eigen::Vector2d(4, 2);
    scene.lights[1].off = {{1, 2}};
    const Built built = Build(scene);
    ASSERT_EQ(built.parts.lights.size(), 6u + 8u);
    double lit = 0, seen = 0;
    const TriangleMesh& mesh = built.parts.statics.mesh;
    for (const AreaLight& light : built.parts.lights) {
      lit += 4 * light.half_u.cross(light.half_v).norm();
      for (const auto& [u, v] : {std::pair{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}) {
        const Vector3f corner = light.center + static_cast<float>(u) * light.half_u +
                                static_cast<float>(v) * light.half_v;
        EXPECT_TRUE(std::ranges::any_of(mesh.positions, [&](const Vector3f& p) {
          return (p - corner).norm() < 1e-4f;
        })) << corner.transpose();
      }
    }
    for (const char* grid : {"lights_0", "lights_1"}) {
      for (const std::size_t i : built.Triangles(grid)) {
        if (mesh.materials[i] == 7) seen += test::AreaOf(mesh, {i});
      }
    }
    EXPECT_NEAR(seen, lit, 1e-3);
    EXPECT_EQ(LightScale(scene, 0.5), std::vector<float>(14, 1.0f));
    std::vector<float> dark(14, 0.0f);
    std::fill(dark.begin(), dark.begin() + 6, 1.0f);
    EXPECT_EQ(LightScale(scene, 1.5), dark) << "the second grid alone is off";
    for (std::size_t i = 6; i < 14; ++i) {
      const Vector3f& at = built.parts.lights[i].center;
      EXPECT_TRUE(at.x() > 0 && at.x() < 4 && at.y() > 0 && at.y() < 2) << at.transpose();
    }
  }
}

TEST(Mezzanine, CarriesItsGoodsOnItsDeckBehindItsRailing) {
  Scene scene = Hall();
  scene.mezzanines.resize(1);
  scene.mezzanines[0].from = {0, 0};
  scene.mezzanines[0].to = {9, 6};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Built built = Build(scene, seed);
    const Box goods = built.Around("mezzanine_0_goods"), frame = built.Around("mezzanine_0");
    EXPECT_NEAR(goods.min().z(), 2.8, 1e-4) << seed;
    EXPECT_NEAR(frame.min().z(), 0, 0.06) << seed;
    EXPECT_NEAR(frame.max().z(), 2.8 + 1.1, 0.05) << seed;
    EXPECT_GT(goods.min().x(), 0);
    EXPECT_GT(goods.min().y(), 0);
    EXPECT_LT(goods.max().x(), 9);
    EXPECT_LT(goods.max().y(), 6);
  }
}

/// How deep two triangles of the floor's plane lie in one another, by the separating axis; below 0
/// they do not meet.
float Depth(const std::array<Vector2f, 3>& one, const std::array<Vector2f, 3>& other) {
  float depth = std::numeric_limits<float>::infinity();
  for (const auto* triangle : {&one, &other}) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2f side = (*triangle)[(k + 1) % 3] - (*triangle)[k];
      const Vector2f across = Vector2f(-side.y(), side.x()).normalized();
      const auto reach = [&](const std::array<Vector2f, 3>& points) {
        const auto [low, high] =
            std::minmax({across.dot(points[0]), across.dot(points[1]), across.dot(points[2])});
        return std::pair(low, high);
      };
      const auto [a, b] = reach(one);
      const auto [c, d] = reach(other);
      depth = std::min(depth, std::min(b, d) - std::max(a, c));
    }
  }
  return depth;
}

/// Of the upper faces of the pallets' boards, none lies in another.
TEST(Mezzanine, NoTwoPalletsStandInOneAnother) {
  for (float width = 2; width <= 12; width += 0.5f) {
    for (const float deep : {2.0f, 2.4f, 3.1f, 4.6f, 6.0f}) {
      Scene scene = Hall();
      scene.mezzanines.resize(1);
      scene.mezzanines[0].to = {width, deep};
      std::size_t boards = 0;
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        WorldParts parts;
        WorldBuilder builder(&parts);
        AddMezzanines(scene, PaletteWithSigns(), seed, &builder);
        const TriangleMesh& mesh = parts.statics.mesh;
        std::vector<std::array<Vector2f, 3>> faces;
        for (const std::size_t i :
             test::TrianglesOf(parts.instances, parts.statics, "mezzanine_0_goods")) {
          std::array<Vector2f, 3> face;
          bool above = true;
          for (std::size_t k = 0; k < 3; ++k) {
            const Vector3f& corner = mesh.positions[mesh.triangles[i][k]];
            face[k] = corner.head<2>();
            above = above && std::abs(corner.z() - 2.8f - kPalletHeight_m) < 1e-3f;
          }
          if (above && test::AreaOf(mesh, {i}) > 0.05) faces.push_back(face);
        }
        boards += faces.size() / 2;
        int within = 0;
        for (std::size_t a = 0; a < faces.size(); ++a) {
          for (std::size_t b = 0; b < a; ++b) within += Depth(faces[a], faces[b]) > 0.002f;
        }
        EXPECT_EQ(within, 0) << width << " x " << deep << ", seed " << seed;
      }
      EXPECT_GT(boards, 0u) << width << " x " << deep;
    }
  }
}

}  // namespace
}  // namespace aisle::sim
