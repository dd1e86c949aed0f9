// What the right camera does not see, held against two opinions that share nothing with the tracer:
// the rasteriser's depth of the right camera, four times as fine, and every triangle in turn.
#include <gtest/gtest.h>

#include "simulator/camera/pixel_rays.h"
#include "simulator/raster/raster.h"
#include "simulator/scene/load.h"
#include "simulator/trace/hit_image.h"
#include "simulator/truth/correspondence.h"
#include "simulator/world/build.h"

namespace aisle::sim {
namespace {

constexpr int kFiner = 4;

struct View {
  const char* scene;
  double time_s;
};

StereoCamera CameraOf(const CameraSpec& spec) {
  return {.width = spec.size_px[0],
          .height = spec.size_px[1],
          .fx = spec.focal_px.x(),
          .fy = spec.focal_px.y(),
          .cx = spec.center_px.x(),
          .cy = spec.center_px.y(),
          .baseline_m = spec.baseline_m};
}

StereoCamera Finer(const StereoCamera& camera) {
  StereoCamera finer = camera;
  finer.width *= kFiner, finer.height *= kFiner;
  finer.fx *= kFiner, finer.fy *= kFiner;
  finer.cx = kFiner * (camera.cx + 0.5) - 0.5;
  finer.cy = kFiner * (camera.cy + 0.5) - 0.5;
  return finer;
}

/// Whether the way from one point to another meets the triangle before it is 9999 / 10000 done.
bool Blocks(const Eigen::Vector3d& from, const Eigen::Vector3d& way, const Eigen::Vector3d& a,
            const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  constexpr double kEdge = 1e-5;  // of the triangle: what rounding leaves open
  const Eigen::Vector3d ab = b - a, ac = c - a, p = way.cross(ac), s = from - a;
  const double determinant = ab.dot(p);
  if (determinant == 0) return false;
  const double u = s.dot(p) / determinant;
  const Eigen::Vector3d q = s.cross(ab);
  const double v = way.dot(q) / determinant, t = ac.dot(q) / determinant;
  return u >= -kEdge && v >= -kEdge && u + v <= 1 + kEdge && t > 0 && t < 1 - 0.9e-4;
}

bool BlockedByAnyTriangle(const World& world, const Snapshot& snapshot, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& to) {
  const auto any = [&](const TriangleMesh& mesh, const std::vector<Eigen::Vector3f>& positions) {
    return std::ranges::any_of(mesh.triangles, [&](const auto& triangle) {
      return Blocks(from, to - from, positions[triangle[0]].template cast<double>(),
                    positions[triangle[1]].template cast<double>(),
                    positions[triangle[2]].template cast<double>());
    });
  };
  for (std::size_t i = 0; i < snapshot.movers.size(); ++i) {
    if (any(world.mover_meshes()[i], snapshot.movers[i].positions)) return true;
  }
  return any(world.statics().mesh, world.statics().mesh.positions);
}

struct Found {
  int hidden = 0, hidden_in_the_open = 0;  ///< the latter by the rasteriser
  int seen = 0, seen_though_covered = 0;
  /// Hidden pixels between two that are seen, as deep as they are: the first hundred of them.
  int alone = 0, alone_and_blocked = 0;
};

/// Nearest and farthest that the rasteriser draws within a finer pixel and a half of a place, or
/// nothing at the border.
std::optional<std::pair<float, float>> DepthsAround(const cv::Mat1f& depth,
                                                    const Eigen::Vector2d& place) {
  const cv::Rect window(static_cast<int>(std::lround(place.x())) - 1,
                        static_cast<int>(std::lround(place.y())) - 1, 3, 3);
  if ((window & cv::Rect(0, 0, depth.cols, depth.rows)) != window) return std::nullopt;
  const auto [least, most] = std::ranges::minmax(cv::Mat1f(depth(window).clone()));
  return std::pair(least, most);
}

Found Judge(const View& view) {
  constexpr int kMostAlone = 100;
  const Scene scene = LoadScene(AISLE_SOURCE_DIR "/scenes/" + std::string(view.scene) + ".yaml");
  const World world = BuildWorld(scene, AISLE_SOURCE_DIR "/assets", 1);
  const Tracer tracer(world, {});
  const StereoCamera camera = CameraOf(scene.camera), finer = Finer(camera);
  const PixelRays rays = MakePixelRays(camera);
  const std::int64_t stamp_ns = std::llround(1e9 * view.time_s);
  const Eigen::Isometry3d rig = world.PlannedRigPose(stamp_ns);
  const Eigen::Isometry3d right = CameraPose(camera, rig, StereoSide::kRight);
  const Instant instant = tracer.Pose(world.At(stamp_ns));
  const CameraView left(rays, rig);
  std::vector<HitImage> hits;
  TraceViews(instant, std::span(&left, 1), {}, &hits);
  const cv::Mat1b hidden =
      FindCorrespondence(world, instant, camera, left, hits[0], instant.snapshot(), rig).occluded;
  const cv::Mat1f drawn = Rasterize(world, instant.snapshot(), finer, right).depth;
  Found found;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 1; x + 1 < camera.width; ++x) {
      const std::size_t i = hits[0].Index(x, y);
      const double z = hits[0].t[i];
      if (!std::isfinite(z)) continue;
      const Eigen::Vector2d ray = rays.At(x, y).cast<double>();
      const Eigen::Vector3d in_right(z * ray.x() - camera.baseline_m, z * ray.y(), z);
      const auto around = DepthsAround(drawn, Projection(finer)(in_right).value());
      if (!around) continue;
      if (!hidden(y, x)) {
        ++found.seen;
        found.seen_though_covered += around->second < 0.99 * z;
        continue;
      }
      ++found.hidden;
      found.hidden_in_the_open += around->first > 0.999 * z;
      const bool smooth =
          std::abs(hits[0].t[i - 1] - z) < 0.02 * z && std::abs(hits[0].t[i + 1] - z) < 0.02 * z;
      if (!smooth || hidden(y, x - 1) || hidden(y, x + 1) || found.alone == kMostAlone) continue;
      ++found.alone;
      found.alone_and_blocked +=
          BlockedByAnyTriangle(world, instant.snapshot(), right.translation(), right * in_right);
    }
  }
  return found;
}

TEST(Occlusion, IsWhatTheRasteriserAndEveryTriangleSay) {
  for (const View& view :
       {View{"paper/scene1", 4.5}, View{"paper/scene3", 5.5}, View{"weakness/bump", 6},
        View{"weakness/forklift_pallet", 7.5}, View{"street/town", 5}, View{"smoke/short", 0.5}}) {
    const Found found = Judge(view);
    SCOPED_TRACE(
        fmt::format("{}: {} hidden, {} of them open; {} seen, {} of them covered; {} "
                    "alone, {} of them blocked",
                    view.scene, found.hidden, found.hidden_in_the_open, found.seen,
                    found.seen_though_covered, found.alone, found.alone_and_blocked));
    EXPECT_GT(found.hidden, 5'000);
    // Leaves and mesh guards are all outline, where a pixel of the rasteriser decides either way.
    EXPECT_LE(found.hidden_in_the_open, 2e-3 * found.hidden);
    EXPECT_LE(found.seen_though_covered, 1e-3 * found.seen);
    EXPECT_GT(found.alone, 20);
    EXPECT_EQ(found.alone_and_blocked, found.alone);
  }
}

}  // namespace
}  // namespace aisle::sim
