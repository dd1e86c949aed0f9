#include <gtest/gtest.h>

#include "simulator/truth/truth.h"
#include "tests/simulator/truth/one_mover.h"

namespace aisle::sim {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Vector3d;

struct Seen {
  cv::Mat1b mask;  ///< of the mover, without what hides it
  std::vector<ObjectTruth> objects;
};

Seen Look(const WorldParts& parts, double time_s) {
  const World world(parts);
  const Tracer tracer(world, {});
  const PixelRays rays = MakePixelRays(StereoCamera());
  const CameraView view(rays, test::LookAlong({0, 0, 0}, 0));
  const Instant instant = tracer.Pose(world.At(std::llround(1e9 * time_s)));
  const CameraTruth truth = LabelHits(world, instant, test::Trace(instant, view),
                                      MovingNow(world, instant.snapshot(), {}));
  return {cv::Mat1b(truth.instance == 2), DescribeMovers(instant, view, truth)};
}

/// A vehicle of two meshes, neither of them about its origin, that drives a bend.
Isometry3d Driven(double time_s) {
  const double heading_rad = 0.6 + 0.8 * time_s;
  return Isometry3d(
      Eigen::Translation3d(5 + 1.5 * std::sin(heading_rad), -1.5 * std::cos(heading_rad), -0.4) *
      AngleAxisd(heading_rad, Vector3d::UnitZ()));
}

TEST(Boxes, AreInTheFrameOfWhatTheyEncloseHoweverItIsTurned) {
  test::MeshBuilder body, mast;
  body.Box({-0.2f, -0.5f, 0}, {0.8f, 0.5f, 0.9f}, 0, 2);
  mast.Box({0.8f, -0.3f, 0.1f}, {1, 0.3f, 1.3f}, 0, 2);
  const WorldParts parts =
      test::BeforeAWall({test::Rigid(body.mesh, Driven), test::Rigid(mast.mesh, Driven)});
  for (const double t : {0.0, 0.7}) {
    const std::vector<ObjectTruth> objects = Look(parts, t).objects;
    ASSERT_EQ(objects.size(), 1u);
    const ObjectTruth& object = objects[0];
    EXPECT_TRUE(object.T_world_object.isApprox(Driven(t), 1e-9));
    EXPECT_LT((object.extent_m - Vector3d(1.2, 1, 1.3)).norm(), 1e-5);
    EXPECT_LT((object.center_m - Driven(t) * Vector3d(0.4, 0, 0.65)).norm(), 1e-5);
    const double heading_rad = 0.6 + 0.8 * t;
    const Vector3d velocity = 0.8 * 1.5 * Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0);
    EXPECT_LT((object.velocity_mps - velocity).norm(), 1e-6);
  }
}

TEST(Boxes, OfWhatGoesStraightMoveAtItsVelocity) {
  test::MeshBuilder body;
  body.Box({-0.2f, -0.5f, 0}, {0.8f, 0.5f, 0.9f}, 0, 2);
  const WorldParts parts = test::BeforeAWall({test::Rigid(body.mesh, [](double t) {
    return Isometry3d(Eigen::Translation3d(4 + 0.9 * t, 0.4 - 1.2 * t, -0.3) *
                      AngleAxisd(-0.9, Vector3d::UnitZ()));
  })});
  constexpr double kHalf_s = 0.05;
  const Vector3d way = Look(parts, 0.4 + kHalf_s).objects[0].center_m -
                       Look(parts, 0.4 - kHalf_s).objects[0].center_m;
  EXPECT_LT((way / (2 * kHalf_s) - Look(parts, 0.4).objects[0].velocity_mps).norm(), 1e-4);
}

/// The pixels of a mask, which reach half a pixel to each side of their centres.
cv::Rect2d Enclosing(const cv::Mat1b& mask) {
  int x0 = mask.cols, y0 = mask.rows, x1 = -1, y1 = -1;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (!mask(y, x)) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x);
      y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  }
  return {x0 - 0.5, y0 - 0.5, x1 - x0 + 1.0, y1 - y0 + 1.0};
}

/// A wall on wheels, from behind the camera to ahead of it.
TEST(Boxes, OfWhatReachesBehindTheCameraHoldAllOfItThatIsInView) {
  test::MeshBuilder beside, screened;
  beside.Box({-1, 0.6f, -0.3f}, {3, 0.7f, 0.4f}, 0, 2);
  WorldParts parts =
      test::BeforeAWall({test::Rigid(beside.mesh, [](double) { return Isometry3d::Identity(); })});
  const Seen alone = Look(parts, 0);
  ASSERT_EQ(alone.objects.size(), 1u);
  const cv::Rect2d box = Enclosing(alone.mask);
  EXPECT_EQ(box.x, -0.5) << "it goes out of the picture";
  EXPECT_EQ(alone.objects[0].box_full, box);
  EXPECT_EQ(alone.objects[0].box_visible, box);

  // What is nearest of it is hidden.
  screened.Quad({10, 50, -50}, {0, -100, 0}, {0, 0, 100}, 0, 1);
  screened.Quad({0.6f, 0.3f, -1}, {0, 1, 0}, {0, 0, 2}, 0, 1);
  parts.statics = {screened.mesh, screened.instances};
  const Seen hidden = Look(parts, 0);
  ASSERT_EQ(hidden.objects.size(), 1u);
  EXPECT_EQ(hidden.objects[0].box_full, box);
  EXPECT_EQ(hidden.objects[0].box_visible, Enclosing(hidden.mask));
  const double share = 1.0 * cv::countNonZero(hidden.mask) / cv::countNonZero(alone.mask);
  EXPECT_LT(share, 0.8);
  EXPECT_EQ(hidden.objects[0].visible_fraction, share);
}

}  // namespace
}  // namespace aisle::sim
