#include "simulator/raster/raster.h"

#include <GL/osmesa.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <stdexcept>
#include <vector>

namespace aisle::sim {
namespace {

struct ContextRelease {
  void operator()(osmesa_context* context) const { OSMesaDestroyContext(context); }
};

/// Corners of all triangles in world coordinates, each with its instance as a colour.
struct Soup {
  std::vector<Eigen::Vector3f> corners;
  std::vector<std::array<std::uint8_t, 4>> colors;

  void Add(const TriangleMesh& topology, std::span<const Eigen::Vector3f> positions,
           const auto& instance_of) {
    for (std::size_t i = 0; i < topology.triangles.size(); ++i) {
      const auto instance = static_cast<unsigned>(instance_of(i));
      const std::array<std::uint8_t, 4> color = {static_cast<std::uint8_t>(instance & 255),
                                                 static_cast<std::uint8_t>(instance >> 8), 0, 255};
      for (const std::uint32_t vertex : topology.triangles[i]) {
        corners.push_back(positions[vertex]);
        colors.push_back(color);
      }
    }
  }
};

Soup Collect(const World& world, const Snapshot& snapshot) {
  Soup soup;
  const StaticWorld& statics = world.statics();
  soup.Add(statics.mesh, statics.mesh.positions,
           [&](std::size_t triangle) { return statics.instances[triangle]; });
  for (std::size_t i = 0; i < snapshot.movers.size(); ++i) {
    soup.Add(world.mover_meshes()[i], snapshot.movers[i].positions,
             [&](std::size_t) { return snapshot.movers[i].instance; });
  }
  return soup;
}

/// Between these, along the optical axis, is what is drawn.
struct Depths {
  double near_m, far_m;
};

/// Up to what stands farthest from a camera.
Depths DepthsOf(const Soup& soup, const Eigen::Vector3d& camera, const RasterOptions& options) {
  constexpr double kBeyond = 1.01;  // what stands at the bound itself is not cut by rounding
  double squared = 0;
  for (const Eigen::Vector3f& corner : soup.corners) {
    squared = std::max(squared, (corner.cast<double>() - camera).squaredNorm());
  }
  const double near_m = options.near_m;
  return {near_m, std::max(kBeyond * std::sqrt(squared), 2 * near_m)};
}

/// OpenGL's clip coordinates from camera coordinates (x right, y down, z forward). A pixel's centre
/// (u, v) lies at window coordinates (u + 1/2, v + 1/2); row 0 of the buffer is image row 0.
Eigen::Matrix4d ClipFromCamera(const StereoCamera& camera, const Depths& depths) {
  const double w = camera.width, h = camera.height, n = depths.near_m, f = depths.far_m;
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m(0, 0) = 2 * camera.fx / w;
  m(0, 2) = (2 * camera.cx + 1) / w - 1;
  m(1, 1) = 2 * camera.fy / h;
  m(1, 2) = (2 * camera.cy + 1) / h - 1;
  m(2, 2) = (f + n) / (f - n);
  m(2, 3) = -2 * f * n / (f - n);
  m(3, 2) = 1;
  return m;
}

void Draw(const Soup& soup, const Eigen::Matrix4d& clip_from_world, int width, int height) {
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 0);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DITHER);
  glShadeModel(GL_FLAT);
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixd(clip_from_world.data());
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(3, GL_FLOAT, sizeof(Eigen::Vector3f), soup.corners.data());
  glColorPointer(4, GL_UNSIGNED_BYTE, 0, soup.colors.data());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(soup.corners.size()));
  glFinish();
}

RasterView ReadBack(const cv::Mat4b& color, const Depths& depths) {
  const cv::Size size = color.size();
  cv::Mat1f buffer(size);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.width, size.height, GL_DEPTH_COMPONENT, GL_FLOAT, buffer.data);
  RasterView view{cv::Mat1f(size), cv::Mat1w(size)};
  const double n = depths.near_m, f = depths.far_m;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const cv::Vec4b& c = color(y, x);
      view.instance(y, x) = static_cast<std::uint16_t>(c[0] | c[1] << 8);
      const double ndc = 2.0 * buffer(y, x) - 1;
      view.depth(y, x) = c[3] == 0 ? std::numeric_limits<float>::infinity()
                                   : static_cast<float>(2 * f * n / (f + n - ndc * (f - n)));
    }
  }
  return view;
}

bool IsInner(const cv::Mat1f& depth, const cv::Mat1w& instance, int x, int y) {
  constexpr float kJump = 0.02f;  // of the depth
  const float z = depth(y, x);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (instance(y + dy, x + dx) != instance(y, x)) return false;
      const float other = depth(y + dy, x + dx);
      if (other != z && !(std::abs(other - z) <= kJump * z)) return false;
    }
  }
  return true;
}

/// Whether the 3 × 3 neighbourhood lies in one plane, where 1/z is linear in a pinhole image: an
/// edge between two faces has a value of its own between the pixels.
bool IsPlane(const cv::Mat1f& depth, int x, int y) {
  constexpr float kBend = 2e-4f;  // of 1/z
  const float bound = kBend / depth(y, x);
  const auto inverse = [&](int dx, int dy) { return 1 / depth(y + dy, x + dx); };
  for (int k = -1; k <= 1; ++k) {
    const float across = inverse(-1, k) - 2 * inverse(0, k) + inverse(1, k);
    const float down = inverse(k, -1) - 2 * inverse(k, 0) + inverse(k, 1);
    if (std::max(std::abs(across), std::abs(down)) > bound) return false;
  }
  return true;
}

/// The ray (x, y, 1) of every pixel as OpenCV has it; NaN where its search, which knows nothing of
/// folds, does not come back to the pixel.
cv::Mat2d RaysByOpenCv(const StereoCamera& camera) {
  constexpr double kBack = 1e-3;  // pixels
  const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const cv::Vec4d bends(camera.lens.coefficients.data());
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-9);
  std::vector<cv::Point2d> pixels, rays, again;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) pixels.emplace_back(x, y);
  }
  if (camera.lens.model == LensModel::kEquidistant) {
    cv::fisheye::undistortPoints(pixels, rays, k, bends, cv::noArray(), cv::noArray(), until);
    cv::fisheye::distortPoints(rays, again, k, bends);
  } else {
    cv::undistortPoints(pixels, rays, k, bends, cv::noArray(), cv::noArray(), until);
    std::vector<cv::Point3d> points;
    for (const cv::Point2d& ray : rays) points.emplace_back(ray.x, ray.y, 1);
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), k, bends, again);
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  cv::Mat2d by_pixel(camera.height, camera.width);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool comes_back = cv::norm(again[i] - pixels[i]) < kBack;
    by_pixel(static_cast<int>(i)) =
        comes_back ? cv::Vec2d(rays[i].x, rays[i].y) : cv::Vec2d(kNone, kNone);
  }
  return by_pixel;
}

/// A pinhole camera that sees all of the rays, as fine as the lens is at its centre.
StereoCamera Enclosing(const StereoCamera& camera, const cv::Mat2d& rays) {
  constexpr int kMargin = 3;  // pixels
  Eigen::AlignedBox2d box;
  for (const cv::Vec2d& ray : rays) {
    if (!std::isnan(ray[0])) box.extend(Eigen::Vector2d(ray[0], ray[1]));
  }
  if (box.isEmpty()) throw std::runtime_error("OpenCV knows no ray of this lens");
  StereoCamera wide;
  wide.fx = camera.fx;
  wide.fy = camera.fy;
  wide.cx = kMargin - wide.fx * box.min().x();
  wide.cy = kMargin - wide.fy * box.min().y();
  wide.width = static_cast<int>(std::ceil(wide.fx * box.sizes().x())) + 2 * kMargin;
  wide.height = static_cast<int>(std::ceil(wide.fy * box.sizes().y())) + 2 * kMargin;
  return wide;
}

}  // namespace

RasterView RasterizeThroughLens(const World& world, const Snapshot& snapshot,
                                const StereoCamera& camera, const Eigen::Isometry3d& T_world_camera,
                                const RasterOptions& options) {
  const cv::Mat2d rays = RaysByOpenCv(camera);
  const StereoCamera wide = Enclosing(camera, rays);
  const RasterView drawn = Rasterize(world, snapshot, wide, T_world_camera, options);
  RasterView view{cv::Mat1f(rays.size(), std::numeric_limits<float>::quiet_NaN()),
                  cv::Mat1w(rays.size(), std::uint16_t{0})};
  for (int y = 0; y < rays.rows; ++y) {
    for (int x = 0; x < rays.cols; ++x) {
      const cv::Vec2d& ray = rays(y, x);
      if (std::isnan(ray[0])) continue;
      const double u = wide.fx * ray[0] + wide.cx, v = wide.fy * ray[1] + wide.cy;
      const int x0 = static_cast<int>(u), y0 = static_cast<int>(v);
      const int nearest_x = static_cast<int>(std::lround(u));
      const int nearest_y = static_cast<int>(std::lround(v));
      if (!IsInner(drawn.depth, drawn.instance, nearest_x, nearest_y)) continue;
      if (!IsPlane(drawn.depth, nearest_x, nearest_y)) continue;
      const double fx = u - x0, fy = v - y0;
      const auto inverse = [&](int dx, int dy) { return 1.0 / drawn.depth(y0 + dy, x0 + dx); };
      const double above = (1 - fx) * inverse(0, 0) + fx * inverse(1, 0);
      const double below = (1 - fx) * inverse(0, 1) + fx * inverse(1, 1);
      view.depth(y, x) = static_cast<float>(1 / ((1 - fy) * above + fy * below));
      view.instance(y, x) = drawn.instance(nearest_y, nearest_x);
    }
  }
  return view;
}

RasterView Rasterize(const World& world, const Snapshot& snapshot, const StereoCamera& camera,
                     const Eigen::Isometry3d& T_world_camera, const RasterOptions& options) {
  const std::unique_ptr<osmesa_context, ContextRelease> context(
      OSMesaCreateContextExt(OSMESA_RGBA, 32, 0, 0, nullptr));
  cv::Mat4b color(camera.height, camera.width);
  if (!context || !OSMesaMakeCurrent(context.get(), color.data, GL_UNSIGNED_BYTE, camera.width,
                                     camera.height)) {
    throw std::runtime_error("OSMesa does not start (package libosmesa6)");
  }
  OSMesaPixelStore(OSMESA_Y_UP, 1);
  const Soup soup = Collect(world, snapshot);
  const Depths depths = DepthsOf(soup, T_world_camera.translation(), options);
  const Eigen::Matrix4d clip_from_world =
      ClipFromCamera(camera, depths) * T_world_camera.inverse().matrix();
  Draw(soup, clip_from_world, camera.width, camera.height);
  return ReadBack(color, depths);
}

Agreement Compare(const RasterView& raster, const cv::Mat1f& depth, const cv::Mat1w& instance,
                  float tolerance) {
  Agreement agreement;
  for (int y = 1; y + 1 < depth.rows; ++y) {
    for (int x = 1; x + 1 < depth.cols; ++x) {
      if (!IsInner(depth, instance, x, y)) continue;
      if (!IsInner(raster.depth, raster.instance, x, y)) continue;
      ++agreement.compared;
      const float a = raster.depth(y, x), b = depth(y, x);
      agreement.agreeing +=
          raster.instance(y, x) == instance(y, x) && (a == b || std::abs(a - b) <= tolerance * b);
    }
  }
  return agreement;
}

}  // namespace aisle::sim
