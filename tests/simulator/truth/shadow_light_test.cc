#include <gtest/gtest.h>

#include "simulator/shade/pass/beam_light.h"
#include "simulator/truth/moving_shadow.h"
#include "tests/simulator/truth/one_mover.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

/// A floor and a leaning wall under some beams, with a moving plate between.
struct Stage {
  bool turned_over = false;  ///< triangles of the floor and the wall wound the other way round
  std::vector<Beam> beams = {};
  bool has_plate = true;
};

World Build(const Stage& stage) {
  test::MeshBuilder surfaces, plate;
  const auto quad = [&](const Vector3f& corner, const Vector3f& u, const Vector3f& v) {
    surfaces.Quad(corner, stage.turned_over ? v : u, stage.turned_over ? u : v, 0, 1);
  };
  quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
  quad({-4, 1.6f, 0}, {8, 0, 0}, {0, 1, 2.5f});
  plate.Quad({-0.5f, -0.7f, 1.7f}, {1.1f, 0, 0}, {0, 1.2f, 0.2f}, 0, 2);
  // Without it: it is there, but far away.
  WorldParts parts =
      test::BeforeAWall({test::Rigid(plate.mesh, [far = stage.has_plate ? 0.0 : 500.0](double t) {
        return Eigen::Isometry3d(Eigen::Translation3d(far, t, 0));
      })});
  parts.statics = {surfaces.mesh, surfaces.instances};
  parts.has_beams = true;
  parts.at = [at = parts.at, beams = stage.beams](std::int64_t stamp_ns) {
    Snapshot snapshot = at(stamp_ns);
    snapshot.light_scale = {0};
    snapshot.beams = beams;
    return snapshot;
  };
  return World(std::move(parts));
}

/// Spots at several heights, and suns through windows with bars, all so that the plate shades some
/// of the floor from each.
std::vector<Beam> AnyBeams(cv::RNG* rng) {
  const auto in = [&](float low, float high) { return rng->uniform(low, high); };
  std::vector<Beam> beams(3);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    Beam& beam = beams[i];
    beam.power = in(0.3f, 1);
    if (i == 0 || rng->uniform(0, 2) == 0) {
      beam.origin = {in(-2, 2), in(-2, 0.5f), in(2.5f, 5)};
      beam.toward = (Vector3f(in(-0.5f, 0.5f), in(-0.5f, 0.5f), 0) - beam.origin).normalized();
      beam.power *= 10;
      beam.cos_outer = std::cos(in(0.4f, 0.9f));
      beam.cos_inner = std::cos(in(0.1f, 0.4f));
      continue;
    }
    beam.kind = Beam::Kind::kSun;
    beam.toward = Vector3f(in(-0.4f, 0.4f), in(-0.6f, 0.2f), 1).normalized();
    beam.origin = 4 * beam.toward / beam.toward.z() + Vector3f(in(-0.4f, 0.4f), in(-0.4f, 0.4f), 0);
    beam.half_u = {in(1, 2), in(-0.3f, 0.3f), 0};
    beam.half_v = {in(-0.3f, 0.3f), -in(1, 2), 0};
    beam.columns = rng->uniform(1, 5);
    beam.rows = rng->uniform(1, 4);
    beam.bar_u = in(0, 0.4f);
    beam.bar_v = in(0, 0.4f);
  }
  return beams;
}

struct Picture {
  cv::Mat1f light;
  cv::Mat1b mask;
};

/// Irradiance of each pixel as shading has it, and the mask of moving shadows.
Picture Look(const Stage& stage, const MovingShadowOptions& options) {
  const World world = Build(stage);
  const Tracer tracer(world, {});
  const StereoCamera camera{
      .width = 160, .height = 120, .fx = 70, .fy = 70, .cx = 79.5, .cy = 59.5};
  const PixelRays rays = MakePixelRays(camera);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // from above the lower edge
  pose.linear().col(0) = Eigen::Vector3d::UnitX();
  pose.linear().col(2) = Eigen::Vector3d(0, 3, -3.2).normalized();
  pose.linear().col(1) = pose.linear().col(2).cross(pose.linear().col(0));
  pose.translation() << 0, -3, 3.2;
  const CameraView view(rays, pose);
  const Instant instant = tracer.Pose(world.At(0));
  const HitImage hits = test::Trace(instant, view);
  Picture picture{cv::Mat1f(camera.height, camera.width, -1.0f),
                  FindMovingShadows(world, instant, view, hits,
                                    MovingNow(world, instant.snapshot(), {}), options)};
  const BeamLight light(instant);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const std::size_t i = hits.Index(x, y);
      if (hits.geometry[i] != 0) continue;
      const Vector3f point =
          view.origin + hits.t[i] * (view.rotation * rays.At(x, y).homogeneous());
      const Vector3f up =
          hits.primitive[i] < 2 ? Vector3f(0, 0, 1) : Vector3f(0, -2.5f, 1).normalized();
      picture.light(y, x) = light.At({Wide(point.x()), Wide(point.y()), Wide(point.z())},
                                     {Wide(up.x()), Wide(up.y()), Wide(up.z())}, WideInt(-1))[0];
    }
  }
  return picture;
}

/// Shading has its own words for the same beams: what a picture loses by the plate is what the mask
/// goes by.
TEST(MovingShadow, IsWhereThePictureLosesThatShareOfItsBeams) {
  cv::RNG rng(5);
  int shadows = 0, lit = 0, wrong = 0;
  for (std::size_t trial = 0; trial < 24; ++trial) {
    Stage stage{.turned_over = trial % 2 == 1, .beams = AnyBeams(&rng)};
    const MovingShadowOptions options{.share = std::array{0.05f, 0.2f, 0.4f}[trial % 3]};
    const Picture with = Look(stage, options);
    stage.has_plate = false;
    const Picture without = Look(stage, options);
    EXPECT_EQ(cv::countNonZero(without.mask), 0);
    for (int y = 0; y < with.light.rows; ++y) {
      for (int x = 0; x < with.light.cols; ++x) {
        const float now = with.light(y, x), free = without.light(y, x);
        if (now < 0 || free < 0) continue;  // the plate itself
        const float lost = free - now, bound = options.share * free;
        if (std::abs(lost - bound) < 0.01f * free || (free > 0 && free < 1e-3f)) continue;
        const bool is_shadow = lost > bound;
        (is_shadow ? shadows : lit) += 1;
        wrong += is_shadow != (with.mask(y, x) != 0);
      }
    }
  }
  EXPECT_GT(shadows, 5000);
  EXPECT_GT(lit, 50'000);
  EXPECT_LE(wrong, (shadows + lit) / 5000) << "edges of cones and bars, to a rounding";
}

}  // namespace
}  // namespace aisle::sim
