#include "simulator/shade/antialias.h"

#include <tbb/parallel_for.h>

#include <cstring>
#include <numbers>

namespace aisle::sim {
namespace {

constexpr float kContrast = 0.03f;  // below this an edge cannot be seen in the noise
constexpr int kSamples = 4;
constexpr int kRowsATask = 8;
// A square turned by atan(1/2): distinct rows and columns for every sample.
constexpr std::array<std::array<float, 2>, kSamples> kOffsets = {
    {{-0.125f, -0.375f}, {0.375f, -0.125f}, {0.125f, 0.375f}, {-0.375f, 0.125f}}};

struct PixelAt {
  int x, y;
};

class Edges {
 public:
  Edges(const HitImage& image, const SurfaceTables& tables, const cv::Mat1f& radiance)
      : image_(image), tables_(tables), radiance_(radiance) {}

  /// Pixels of a band of rows that differ from one of their four neighbours.
  std::vector<PixelAt> Find(int y0, int y1) const {
    std::vector<PixelAt> found;
    for (int y = y0; y < y1; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        if ((x > 0 && Differ(x, y, x - 1, y)) || (x + 1 < image_.width && Differ(x, y, x + 1, y)) ||
            (y > 0 && Differ(x, y, x, y - 1)) ||
            (y + 1 < image_.height && Differ(x, y, x, y + 1))) {
          found.push_back({x, y});
        }
      }
    }
    return found;
  }

 private:
  bool Differ(int x, int y, int nx, int ny) const {
    const std::size_t i = image_.Index(x, y), j = image_.Index(nx, ny);
    if (image_.primitive[i] == image_.primitive[j] && image_.geometry[i] == image_.geometry[j]) {
      return false;
    }
    const float a = radiance_(y, x), b = radiance_(ny, nx);
    if (std::abs(a - b) <= kContrast * std::max(a, b)) return false;
    if (image_.geometry[i] != image_.geometry[j] || image_.geometry[i] != 0) return true;
    // Two triangles of one flat, plain face are no edge.
    const SurfaceRecord& first = tables_.statics()[image_.primitive[i]];
    const SurfaceRecord& second = tables_.statics()[image_.primitive[j]];
    const Eigen::Map<const Eigen::Vector3f> n(first.normal), m(second.normal);
    return first.texture != second.texture || first.albedo != second.albedo || n.dot(m) < 0.99f ||
           std::abs(image_.t[i] - image_.t[j]) > 0.02f * image_.t[i];
  }

  const HitImage& image_;
  const SurfaceTables& tables_;
  const cv::Mat1f& radiance_;
};

/// The share of light that movers leave at a sample: that of the pixel around it whose surface is
/// nearest in depth.
float KeptNear(const HitImage& image, std::span<const float> kept, PixelAt pixel, float t) {
  float best = kInfinity, share = 1;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int x = pixel.x + dx, y = pixel.y + dy;
      if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;
      const std::size_t i = image.Index(x, y);
      const float distance = std::abs(image.t[i] - t);
      if (distance < best) {
        best = distance;
        share = kept[i];
      }
    }
  }
  return share;
}

}  // namespace

void AntialiasEdges(const Instant& instant, const EyeView& view, const HitImage& image,
                    const SurfaceTables& tables, const FrameLight& frame,
                    const TexturePool& textures, std::span<const float> kept, cv::Mat1f* radiance) {
  const int bands = (image.height + kRowsATask - 1) / kRowsATask;
  std::vector<std::vector<PixelAt>> edges(static_cast<std::size_t>(bands));
  // All edges are found before the first pixel changes.
  tbb::parallel_for(0, bands, [&](int band) {
    edges[static_cast<std::size_t>(band)] =
        Edges(image, tables, *radiance)
            .Find(band * kRowsATask, std::min(image.height, (band + 1) * kRowsATask));
  });
  const PixelRays& pixel_rays = *view.rays;
  // Half the spacing of the samples: what each stands for.
  const RayStep step{view.rotation.col(0) * pixel_rays.step_x * 0.5f,
                     view.rotation.col(1) * pixel_rays.step_y * 0.5f};
  tbb::parallel_for(0, bands, [&](int band) {
    const std::vector<PixelAt>& pixels = edges[static_cast<std::size_t>(band)];
    if (pixels.empty()) return;
    const int y0 = band * kRowsATask, y1 = std::min(image.height, y0 + kRowsATask);
    const GeometryMask geometries = GeometriesInWindow(instant, view, 0, y0, image.width, y1);
    constexpr std::size_t kPixels = kLanes / kSamples;
    for (std::size_t first = 0; first < pixels.size(); first += kPixels) {
      Rays8 rays;
      for (std::size_t k = 0; k < kLanes; ++k) {
        const PixelAt pixel = pixels[std::min(first + k / kSamples, pixels.size() - 1)];
        const auto i = static_cast<std::size_t>(pixel.y * pixel_rays.width + pixel.x);
        const auto& [ox, oy] = kOffsets[k % kSamples];
        const Eigen::Vector3f d =
            view.rotation * Eigen::Vector3f(pixel_rays.x[i] + ox * pixel_rays.step_x,
                                            pixel_rays.y[i] + oy * pixel_rays.step_y, 1);
        rays.ox[k] = view.origin.x();
        rays.oy[k] = view.origin.y();
        rays.oz[k] = view.origin.z();
        rays.dx[k] = d.x();
        rays.dy[k] = d.y();
        rays.dz[k] = d.z();
        rays.t_near[k] = 0;
        rays.t_far[k] = kInfinity;
        rays.valid[k] = -1;
      }
      Hits8 hits;
      instant.Intersect(rays, Coherence::kCoherent, geometries, &hits);
      const I8 geometry = LoadI(hits.geometry);
      const SurfaceLanes seen = LookUpHits(tables, frame, textures, geometry, LoadI(hits.primitive),
                                           {LoadF(hits.t), LoadF(hits.u), LoadF(hits.v),
                                            LoadF(rays.dx), LoadF(rays.dy), LoadF(rays.dz), I8{}},
                                           step);
      const F8 value = seen.reflectance * seen.irradiance * std::numbers::inv_pi_v<float>;
      for (std::size_t p = 0; p < kPixels && first + p < pixels.size(); ++p) {
        const PixelAt pixel = pixels[first + p];
        float sum = 0;
        for (std::size_t k = p * kSamples; k < (p + 1) * kSamples; ++k) {
          const float share = hits.geometry[k] == 0 ? KeptNear(image, kept, pixel, hits.t[k]) : 1;
          sum += value[static_cast<int>(k)] * share;
        }
        (*radiance)(pixel.y, pixel.x) = sum / kSamples;
      }
    }
  });
}

}  // namespace aisle::sim
