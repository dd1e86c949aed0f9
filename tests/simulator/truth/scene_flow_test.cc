#include <gtest/gtest.h>

#include "simulator/truth/correspondence.h"
#include "tests/simulator/truth/one_mover.h"

namespace aisle::sim {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Vector3d;

constexpr double kFrame_s = 0.05;

/// Where a surface point of a mover is a frame later.
using Follow = std::function<Vector3d(const Vector3d& point, std::uint32_t primitive)>;

/// Holds scene flow and flow at each pixel of the mover to where `follow` sees its point go; the
/// camera itself moves and turns meanwhile. The point is the depth image's.
void ExpectFollowed(const test::OneMover& mover, const Follow& follow) {
  const World world(test::BeforeAWall({mover}));
  const Tracer tracer(world, {});
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  const CameraView view(rays, test::LookAlong({0, 0, 0}, 0));
  const Isometry3d then = test::LookAlong({0.06, 0.01, 0.02}, 0.03);
  const Instant instant = tracer.Pose(world.At(0));
  const HitImage hits = test::Trace(instant, view);
  const Correspondence found = FindCorrespondence(world, instant, camera, view, hits,
                                                  world.At(std::llround(1e9 * kFrame_s)), then);
  int seen = 0;
  double farthest_m = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const std::size_t i = hits.Index(x, y);
      if (hits.geometry[i] != 1) continue;
      const double z = hits.t[i];
      const Vector3d point = view.T_world_camera * Vector3d(z * (x - camera.cx) / camera.fx,
                                                            z * (y - camera.cy) / camera.fy, z);
      const Vector3d after = follow(point, hits.primitive[i]);
      const cv::Vec3f& way = found.scene_flow(y, x);
      ASSERT_NEAR((Vector3d(way[0], way[1], way[2]) - (after - point)).norm(), 0, 1e-4)
          << x << ", " << y;
      const Vector3d lands = then.inverse() * after;
      ASSERT_NEAR(found.flow(y, x)[0], camera.fx * lands.x() / lands.z() + camera.cx - x, 0.02);
      ASSERT_NEAR(found.flow(y, x)[1], camera.fy * lands.y() / lands.z() + camera.cy - y, 0.02);
      farthest_m = std::max(farthest_m, (after - point).norm());
      ++seen;
    }
  }
  EXPECT_GT(seen, 3000);
  EXPECT_GT(farthest_m, 0.05);
}

Isometry3d Turned(const Vector3d& about, const Vector3d& axis, double angle_rad) {
  return Eigen::Translation3d(about) * AngleAxisd(angle_rad, axis.normalized()) *
         Eigen::Translation3d(-about);
}

TEST(Correspondence, OfATurningThingEachPointGoesItsOwnWay) {
  test::MeshBuilder box;
  box.Box({-0.5f, -0.7f, -0.4f}, {0.5f, 0.7f, 0.4f}, 0, 2);
  const auto pose = [](double t) {
    return Isometry3d(Eigen::Translation3d(4 + 0.3 * t, 0.2, 0) *
                      AngleAxisd(0.5 + 2.5 * t, Vector3d(0.3, -0.2, 1).normalized()));
  };
  const Isometry3d way = pose(kFrame_s) * pose(0).inverse();
  ExpectFollowed(test::Rigid(box.mesh, pose),
                 [&](const Vector3d& point, std::uint32_t) { return Vector3d(way * point); });
}

/// An upper arm that turns about a shoulder, and a forearm that turns about the elbow on it.
TEST(Correspondence, OfAnArmEachPartFollowsItsBone) {
  const Vector3d shoulder(3, 0.6, 0.3), elbow(3, 0, 0.3);
  test::MeshBuilder arm;
  arm.Box({2.9f, 0.05f, 0.2f}, {3.1f, 0.6f, 0.4f}, 0, 2);
  const std::size_t forearm = arm.mesh.triangles.size();
  arm.Box({2.9f, -0.7f, 0.2f}, {3.1f, -0.05f, 0.4f}, 0, 2);
  const auto bone = [&](bool is_forearm, double t) {
    const Isometry3d upper = Turned(shoulder, {1, 0.2, 0}, 0.2 + 1.5 * t);
    return is_forearm ? Isometry3d(upper * Turned(elbow, {0.8, 0, 1}, 0.4 - 3 * t)) : upper;
  };
  ExpectFollowed(
      {.mesh = arm.mesh,
       .at = [&](const Vector3d& point,
                 double t) { return Vector3d(bone(point.y() < 0, t) * point); }},
      [&](const Vector3d& point, std::uint32_t primitive) {
        const bool is_forearm = primitive >= forearm;
        return Vector3d(bone(is_forearm, kFrame_s) * bone(is_forearm, 0).inverse() * point);
      });
}

/// A ball that swells, shears and twists, as skin does: a point keeps the shares of its triangle's
/// area that it cuts off.
TEST(Correspondence, OfSkinThatStretchesAPointKeepsItsPlaceInItsTriangle) {
  test::MeshBuilder ball;
  ball.Sphere({0, 0, 0}, {0.6f, 0.6f, 0.6f}, 8, 0, 2);
  const auto at = [](const Vector3d& p, double t) {
    const Vector3d twisted = AngleAxisd(2 * t * (1 + p.z()), Vector3d::UnitZ()) * p;
    return Vector3d(Vector3d(3, 0, 0) + (1 + 1.5 * t * p.y()) * twisted +
                    t * Vector3d(0, std::sin(4 * p.z()), 0.5 * p.x()));
  };
  ExpectFollowed({.mesh = ball.mesh, .at = at}, [&](const Vector3d& point,
                                                    std::uint32_t primitive) {
    std::array<Vector3d, 3> now, then;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d corner = ball.mesh.positions[ball.mesh.triangles[primitive][k]].cast<double>();
      now[k] = at(corner, 0);
      then[k] = at(corner, kFrame_s);
    }
    const Vector3d normal = (now[1] - now[0]).cross(now[2] - now[0]);
    Vector3d after = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d &b = now[(k + 1) % 3], &c = now[(k + 2) % 3];
      after += (b - point).cross(c - point).dot(normal) / normal.squaredNorm() * then[k];
    }
    return after;
  });
}

}  // namespace
}  // namespace aisle::sim
