#include "simulator/truth/correspondence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kNear = 1e-3f;  // m in front of the camera

Eigen::Vector3d PointAt(const CameraView& view, const HitImage& hits, int x, int y) {
  const auto ray = static_cast<std::size_t>(y * view.rays->width + x);
  const double t = hits.t[hits.Index(x, y)];
  return view.T_world_camera * Eigen::Vector3d(t * view.rays->x[ray], t * view.rays->y[ray], t);
}

bool InImage(const StereoCamera& camera, const std::optional<Eigen::Vector2d>& pixel) {
  return pixel && pixel->x() >= -0.5 && pixel->y() >= -0.5 && pixel->x() < camera.width - 0.5 &&
         pixel->y() < camera.height - 0.5;
}

/// Where the surface point of a hit is on the mover's mesh as posed in `snapshot`.
Eigen::Vector3d FollowOnMover(const World& world, const HitImage& hits, std::size_t i,
                              const Snapshot& snapshot) {
  const std::size_t mover = hits.geometry[i] - 1;
  const auto& [a, b, c] = world.mover_meshes()[mover].triangles[hits.primitive[i]];
  const auto& positions = snapshot.movers[mover].positions;
  const double u = hits.u[i], v = hits.v[i];
  return (1 - u - v) * positions[a].cast<double>() + u * positions[b].cast<double>() +
         v * positions[c].cast<double>();
}

/// Whether the surface point of a hit has come round since, and so is gone.
bool HasComeRound(const World& world, const HitImage& hits, std::size_t i, const Snapshot& now,
                  const Snapshot& next) {
  if (hits.geometry[i] == 0) return false;
  const std::size_t mover = hits.geometry[i] - 1;
  const std::vector<int>& rounds = now.movers[mover].rounds;
  if (rounds.empty()) return false;
  // A triangle belongs to one box.
  const std::uint32_t vertex = world.mover_meshes()[mover].triangles[hits.primitive[i]][0];
  return rounds[vertex] != next.movers[mover].rounds[vertex];
}

/// Bits of the pixels of a packet row that something hides from a point.
unsigned Hidden(const Instant& instant, const std::array<Eigen::Vector3d, kLanes>& points,
                const Eigen::Vector3d& camera, unsigned valid) {
  // The ray ends just before the surface it starts from: 1e-4 of the way, or 1 mm at 10 m.
  constexpr float kMargin = 1e-4f;
  Rays8 rays;
  for (std::size_t k = 0; k < kLanes; ++k) {
    rays.valid[k] = valid >> k & 1 ? -1 : 0;
    const Eigen::Vector3f from = camera.cast<float>();
    const Eigen::Vector3f to =
        rays.valid[k] ? Eigen::Vector3f(points[k].cast<float>() - from) : Eigen::Vector3f::UnitX();
    rays.ox[k] = from.x();
    rays.oy[k] = from.y();
    rays.oz[k] = from.z();
    rays.dx[k] = to.x();
    rays.dy[k] = to.y();
    rays.dz[k] = to.z();
    rays.t_near[k] = 0;
    rays.t_far[k] = 1 - kMargin;
  }
  return instant.Occluded(rays, Coherence::kCoherent, kEverything);
}

/// 1 / z of a depth image at a place between pixels, which on a plane is linear in the image; 0
/// where the four pixels around do not lie on one smooth surface.
double InverseDepthAt(const cv::Mat1f& depth, double x, double y) {
  constexpr double kJump = 0.02;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  if (x0 < 0 || y0 < 0 || x0 + 1 >= depth.cols || y0 + 1 >= depth.rows) return 0;
  const double fx = x - x0, fy = y - y0;
  double value = 0, low = 1e30, high = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const double z = depth(y0 + corner / 2, x0 + corner % 2);
    if (!std::isfinite(z)) return 0;
    low = std::min(low, z);
    high = std::max(high, z);
    value += (corner % 2 ? fx : 1 - fx) * (corner / 2 ? fy : 1 - fy) / z;
  }
  return high - low > kJump * low ? 0 : value;
}

WarpCheck Summarize(std::vector<double> errors) {
  WarpCheck check{.compared = static_cast<int>(errors.size())};
  if (errors.empty()) return check;
  std::ranges::sort(errors);
  check.median_px = errors[errors.size() / 2];
  check.p95_px = errors[errors.size() * 95 / 100];
  return check;
}

}  // namespace

Correspondence FindCorrespondence(const World& world, const Instant& instant,
                                  const StereoCamera& camera, const CameraView& left,
                                  const HitImage& hits, const Snapshot& next,
                                  const Eigen::Isometry3d& T_world_rig_next) {
  const cv::Size size(hits.width, hits.height);
  Correspondence result{cv::Mat1f(size, 0.0f), cv::Mat1b(size, std::uint8_t{255}),
                        cv::Mat2f(size, cv::Vec2f(kNan, kNan)),
                        cv::Mat3f(size, cv::Vec3f(0, 0, 0))};
  const Eigen::Isometry3d T_world_right =
      CameraPose(camera, left.T_world_camera, StereoSide::kRight);
  const Eigen::Isometry3d T_right_world = T_world_right.inverse();
  const Eigen::Vector3d right_camera = T_world_right.translation();
  const Eigen::Isometry3d T_next_world = T_world_rig_next.inverse();
  const Projection project(camera);
  ParallelFor(0, hits.height, [&](int y) {
    for (int x0 = 0; x0 < hits.width; x0 += kLanes) {
      std::array<Eigen::Vector3d, kLanes> points;
      unsigned valid = 0;
      for (int k = 0; k < kLanes && x0 + k < hits.width; ++k) {
        const int x = x0 + k;
        const std::size_t i = hits.Index(x, y);
        if (hits.geometry[i] == kNoGeometry) continue;
        const Eigen::Vector3d point = PointAt(left, hits, x, y);
        points[static_cast<std::size_t>(k)] = point;
        result.disparity(y, x) = static_cast<float>(camera.fx * camera.baseline_m / hits.t[i]);
        if (InImage(camera, project(T_right_world * point))) valid |= 1u << k;
        if (HasComeRound(world, hits, i, instant.snapshot(), next)) {
          result.scene_flow(y, x) = cv::Vec3f(kNan, kNan, kNan);
          continue;
        }
        // The way from now to next is the mesh's; the hit itself stays where the ray found it.
        const Eigen::Vector3d way =
            hits.geometry[i] == 0
                ? Eigen::Vector3d::Zero()
                : Eigen::Vector3d(FollowOnMover(world, hits, i, next) -
                                  FollowOnMover(world, hits, i, instant.snapshot()));
        const Eigen::Vector3d then = T_next_world * Eigen::Vector3d(point + way);
        result.scene_flow(y, x) = cv::Vec3f(
            static_cast<float>(way.x()), static_cast<float>(way.y()), static_cast<float>(way.z()));
        if (then.z() < kNear) continue;
        const std::optional<Eigen::Vector2d> lands = project(then);
        if (!lands) continue;
        result.flow(y, x) =
            cv::Vec2f(static_cast<float>(lands->x() - x), static_cast<float>(lands->y() - y));
      }
      const unsigned hidden = Hidden(instant, points, right_camera, valid);
      for (int k = 0; k < kLanes && x0 + k < hits.width; ++k) {
        if ((valid & ~hidden) >> k & 1) result.occluded(y, x0 + k) = 0;
      }
    }
  });
  return result;
}

cv::Mat1f DepthInNextCamera(const CameraView& left, const HitImage& hits,
                            const Correspondence& correspondence,
                            const Eigen::Isometry3d& T_world_rig_next) {
  cv::Mat1f depth(hits.height, hits.width, kNan);
  const Eigen::Isometry3d T_next_world = T_world_rig_next.inverse();
  for (int y = 0; y < hits.height; ++y) {
    for (int x = 0; x < hits.width; ++x) {
      if (hits.geometry[hits.Index(x, y)] == kNoGeometry) continue;
      const cv::Vec3f& way = correspondence.scene_flow(y, x);
      const Eigen::Vector3d then =
          PointAt(left, hits, x, y) + Eigen::Vector3d(way[0], way[1], way[2]);
      depth(y, x) = static_cast<float>((T_next_world * then).z());
    }
  }
  return depth;
}

WarpCheck CheckStereo(const StereoCamera& camera, const PixelRays& rays,
                      const cv::Mat1f& depth_left, const cv::Mat1f& depth_right,
                      const Correspondence& correspondence) {
  std::vector<double> errors;
  const Projection project(camera);
  for (int y = 0; y + 1 < depth_left.rows; ++y) {
    for (int x = 0; x < depth_left.cols; ++x) {
      if (correspondence.occluded(y, x)) continue;
      const double disparity = correspondence.disparity(y, x);
      const double z = depth_left(y, x);
      const Eigen::Vector2d ray = rays.At(x, y).cast<double>();
      const auto lands = project({z * ray.x() - camera.baseline_m, z * ray.y(), z});
      if (!lands) continue;
      const double inverse = InverseDepthAt(depth_right, lands->x(), lands->y());
      if (inverse <= 0) continue;
      errors.push_back(std::abs(camera.fx * camera.baseline_m * inverse - disparity));
    }
  }
  return Summarize(std::move(errors));
}

WarpCheck CheckFlow(const StereoCamera& camera, const cv::Mat1f& z_next,
                    const cv::Mat1f& depth_next, const cv::Mat2f& flow) {
  constexpr double kHidden = 0.02;  // nearer by this share: something else stands there then
  std::vector<double> errors;
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec2f& f = flow(y, x);
      if (std::isnan(f[0])) continue;
      const double inverse = InverseDepthAt(depth_next, x + double{f[0]}, y + double{f[1]});
      const double expected = 1.0 / z_next(y, x);
      if (inverse <= 0 || inverse > expected * (1 + kHidden)) continue;
      errors.push_back(camera.fx * camera.baseline_m * std::abs(inverse - expected));
    }
  }
  return Summarize(std::move(errors));
}

}  // namespace aisle::sim
