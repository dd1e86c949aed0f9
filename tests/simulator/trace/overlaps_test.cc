#include "simulator/trace/overlaps.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "simulator/trace/tracer.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// Triangles by number: Box makes its lower face first, two triangles a face.
constexpr std::size_t kBox = 12;

test::MeshBuilder CartonOn(const Eigen::Vector3f& corner) {
  test::MeshBuilder mesh;
  mesh.Box(corner, corner + Eigen::Vector3f(0.4f, 0.3f, 0.2f), 0, 1);
  mesh.Quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, 0, 1);
  return mesh;
}

std::size_t Count(const std::vector<std::uint8_t>& marks) {
  return static_cast<std::size_t>(std::ranges::count(marks, 1));
}

TEST(FindOverlapped, MarksTheUndersideOfACartonAndNothingElse) {
  const std::vector<std::uint8_t> marks = FindOverlapped(CartonOn({1, 2, 0}).mesh);
  ASSERT_EQ(marks.size(), kBox + 2);
  EXPECT_EQ(Count(marks), 2u);
  const TriangleMesh mesh = CartonOn({1, 2, 0}).mesh;
  for (std::size_t i = 0; i < kBox; ++i) {
    const bool low = std::ranges::all_of(mesh.triangles[i],
                                         [&](auto at) { return mesh.positions[at].z() == 0; });
    EXPECT_EQ(marks[i], low);
  }
  EXPECT_EQ(Count(FindOverlapped(CartonOn({1, 2, 0.001f}).mesh)), 0u);
}

TEST(FindOverlapped, NeighboursThatShareAnEdgeDoNotOverlap) {
  test::MeshBuilder tiles;
  for (int i = 0; i < 9; ++i) {
    tiles.Quad({static_cast<float>(i % 3), static_cast<float>(i / 3), 1}, {1, 0, 0}, {0, 1, 0}, 0,
               1);
  }
  EXPECT_EQ(Count(FindOverlapped(tiles.mesh)), 0u);
}

/// Triangles of any size in a few planes, each through the origin's neighbourhood.
TriangleMesh TrianglesInPlanes(int triangles, int planes) {
  cv::RNG rng(5);
  TriangleMesh mesh;
  std::vector<std::array<Eigen::Vector3f, 2>> axes;
  for (int k = 0; k < planes; ++k) {
    const Eigen::Vector3f normal =
        Eigen::Vector3f(rng.uniform(-1.f, 1.f), rng.uniform(-1.f, 1.f), rng.uniform(-1.f, 1.f))
            .normalized();
    const Eigen::Vector3f along = normal.unitOrthogonal();
    axes.push_back({along, normal.cross(along)});
  }
  for (int i = 0; i < triangles; ++i) {
    const auto& [u, v] = axes[static_cast<std::size_t>(i % planes)];
    const float size = rng.uniform(0.05f, 0.6f), s = rng.uniform(-2.f, 2.f),
                t = rng.uniform(-2.f, 2.f);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 3; ++k) {
      mesh.positions.push_back((s + size * rng.uniform(-1.f, 1.f)) * u +
                               (t + size * rng.uniform(-1.f, 1.f)) * v);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// What OpenCV says two triangles of one plane have in common, square metres.
float CommonArea(const TriangleMesh& mesh, std::size_t one, std::size_t other) {
  const auto at = [&](std::size_t triangle, std::size_t corner) {
    return mesh.positions[mesh.triangles[triangle][corner]];
  };
  const Eigen::Vector3f u = (at(one, 1) - at(one, 0)).normalized();
  const Eigen::Vector3f v = u.cross(at(one, 2) - at(one, 0)).cross(u).normalized();
  const auto flat = [&](std::size_t triangle) {
    std::vector<cv::Point2f> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f from = at(triangle, k) - at(one, 0);
      corners.emplace_back(from.dot(u), from.dot(v));
    }
    return corners;
  };
  std::vector<cv::Point2f> common;
  return cv::intersectConvexConvex(flat(one), flat(other), common);
}

TEST(FindOverlapped, SaysOfManyTrianglesWhatOpenCVSaysOfEachPair) {
  constexpr int kPlanes = 5;
  const TriangleMesh mesh = TrianglesInPlanes(500, kPlanes);
  const std::vector<std::uint8_t> marks = FindOverlapped(mesh);
  const auto area = [&](std::size_t i) { return CommonArea(mesh, i, i); };
  int in_doubt = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    float most = 0;  // that a larger one has in common with it
    for (std::size_t j = i % kPlanes; j < marks.size(); j += kPlanes) {
      if (i != j && area(j) > area(i)) most = std::max(most, CommonArea(mesh, i, j));
    }
    constexpr float kTouch = 1e-5f;
    in_doubt += most > 0 && most < kTouch ? 1 : 0;
    if (most > 0 && most < kTouch) continue;
    EXPECT_EQ(marks[i] != 0, most > 0) << i;
  }
  EXPECT_LT(in_doubt, 20);
  EXPECT_GT(Count(marks), 100u);
  EXPECT_LT(Count(marks), 480u);
}

TEST(Instant, OfTwoSurfacesInOnePlaneTheLargerIsHitWhicheverWasBuiltFirst) {
  for (const bool floor_first : {false, true}) {
    test::MeshBuilder both;
    const auto floor = [&] { both.Quad({-3, -3.3f, 0}, {7, 0, 0}, {0, 7, 0}, 0, 1); };
    if (floor_first) floor();
    for (int i = 0; i < 40; ++i) {
      both.Quad({-2 + 0.1f * static_cast<float>(i), -2, 0}, {0.09f, 0, 0}, {0, 4, 0}, 0, 1);
    }
    if (!floor_first) floor();
    WorldParts parts;
    parts.materials.resize(1);
    parts.lights.push_back({{0, 0, 5}, {1, 0, 0}, {0, -1, 0}, 1});
    parts.instances.push_back({"thing", ObjectClass::kFurniture, false});
    parts.statics = {both.mesh, both.instances};
    const World world(std::move(parts));
    const Tracer tracer(world, {});
    const Instant instant = tracer.Pose(world.At(0));
    cv::RNG rng(7);
    for (int i = 0; i < 300; ++i) {
      Rays8 rays;
      for (int k = 0; k < kLanes; ++k) {
        rays.ox[k] = rays.oy[k] = 0.3f;
        rays.oz[k] = 1.7f;
        rays.dx[k] = rng.uniform(-1.f, 1.f);
        rays.dy[k] = rng.uniform(-1.f, 1.f);
        rays.dz[k] = -1;
        rays.t_near[k] = 0;
        rays.t_far[k] = kInfinity;
        rays.valid[k] = -1;
      }
      Hits8 hits;
      instant.Intersect(rays, Coherence::kIncoherent, kEverything, &hits);
      for (int k = 0; k < kLanes; ++k) {
        EXPECT_EQ(hits.primitive[k] / 2, floor_first ? 0u : 40u);
      }
    }
  }
}

}  // namespace
}  // namespace aisle::sim
