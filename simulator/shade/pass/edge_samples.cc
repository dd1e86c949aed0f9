#include "simulator/shade/pass/edge_samples.h"

#include <array>
#include <numbers>

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/pass/beam_light.h"

namespace aisle::sim {
namespace {

constexpr int kSamples = 4;
// A square turned by atan(1/2): distinct rows and columns for every sample.
constexpr std::array<std::array<float, 2>, kSamples> kOffsets = {
    {{-0.125f, -0.375f}, {0.375f, -0.125f}, {0.125f, 0.375f}, {-0.375f, 0.125f}}};

/// Radiance of the pixel around that shows the same surface as a sample, or -1: most samples then
/// cost a ray, but no look-up.
float RadianceAround(const HitImage& image, const cv::Mat1f& radiance, PixelAt pixel,
                     const Hits8& hits, std::size_t lane) {
  constexpr float kSameDepth = 0.01f;
  float best = kInfinity, found = -1;
  for (int y = std::max(0, pixel.y - 1); y <= std::min(image.height - 1, pixel.y + 1); ++y) {
    for (int x = std::max(0, pixel.x - 1); x <= std::min(image.width - 1, pixel.x + 1); ++x) {
      const std::size_t i = image.Index(x, y);
      if (image.geometry[i] != hits.geometry[lane]) continue;
      if (image.geometry[i] == kNoGeometry) return 0;
      // Movers' triangles are small: there the same body at the same depth will do.
      const float away = std::abs(image.t[i] - hits.t[lane]);
      const bool same = image.geometry[i] == 0 ? image.primitive[i] == hits.primitive[lane]
                                               : away <= kSameDepth * hits.t[lane];
      if (same && away < best) {
        best = away;
        found = radiance(y, x);
      }
    }
  }
  return found;
}

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

class Sampler {
 public:
  static constexpr std::size_t kPixels = kLanes / kSamples;  ///< a packet

  Sampler(const ShadingView& shading, std::span<const float> kept, const cv::Mat1f& radiance)
      : shading_(shading),
        kept_(kept),
        radiance_(radiance),
        // Half a pixel: the spacing of the samples.
        step_{shading_.view.rotation.col(0) * shading_.view.rays->step_x * 0.5f,
              shading_.view.rotation.col(1) * shading_.view.rays->step_y * 0.5f} {}

  /// Up to kPixels pixels.
  void Sample(std::span<const PixelAt> pixels, GeometryMask geometries,
              std::vector<MixedPixel>* mixed) const {
    const Rays8 rays = SampleRays(shading_.view, pixels);
    Hits8 hits;
    shading_.instant.Intersect(rays, Coherence::kCoherent, geometries, &hits);
    const std::size_t samples = pixels.size() * kSamples;
    std::array<float, kLanes> value;
    bool all_found = true;
    for (std::size_t k = 0; k < samples; ++k) {
      value[k] = RadianceAround(shading_.image, radiance_, pixels[k / kSamples], hits, k);
      all_found &= value[k] >= 0;
    }
    if (!all_found) {
      const F8 light = LightOf(rays, hits);
      for (std::size_t k = 0; k < samples; ++k) {
        if (value[k] >= 0) continue;
        value[k] = light[static_cast<int>(k)];
        if (hits.geometry[k] == 0) {
          value[k] *= KeptNear(shading_.image, kept_, pixels[k / kSamples], hits.t[k]);
        }
      }
    }
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      float sum = 0;
      for (std::size_t k = p * kSamples; k < (p + 1) * kSamples; ++k) sum += value[k];
      mixed->push_back({pixels[p], sum / kSamples});
    }
  }

 private:
  F8 LightOf(const Rays8& rays, const Hits8& hits) const {
    const F8x3 directions = {LoadF(rays.dx), LoadF(rays.dy), LoadF(rays.dz)};
    if (!shading_.world().has_beams()) {
      return RadianceOfHits(shading_.tables, shading_.frame, shading_.textures, directions, hits,
                            step_);
    }
    const SurfaceLanes seen = LookUpHits(shading_.tables, shading_.frame, shading_.textures,
                                         LoadI(hits.geometry), LoadI(hits.primitive),
                                         {LoadF(hits.t), LoadF(hits.u), LoadF(hits.v), directions.x,
                                          directions.y, directions.z, I8{}},
                                         step_);
    const F8 beams = BeamsAtHits(shading_, BeamLight(shading_.instant), rays, hits);
    return seen.reflectance * (seen.irradiance + beams) * std::numbers::inv_pi_v<float>;
  }

  const ShadingView& shading_;
  std::span<const float> kept_;
  const cv::Mat1f& radiance_;
  RayStep step_;
};

}  // namespace

Rays8 SampleRays(const CameraView& view, std::span<const PixelAt> pixels) {
  const PixelRays& rays = *view.rays;
  Rays8 packet;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const PixelAt pixel = pixels[std::min(k / kSamples, pixels.size() - 1)];
    const auto& [ox, oy] = kOffsets[k % kSamples];
    const PixelRays::Step step = rays.StepAt(pixel.x, pixel.y);
    const Eigen::Vector2f ray = rays.At(pixel.x, pixel.y) + ox * step.right + oy * step.down;
    const Eigen::Vector3f d = view.rotation * ray.homogeneous();
    packet.ox[k] = view.origin.x();
    packet.oy[k] = view.origin.y();
    packet.oz[k] = view.origin.z();
    packet.dx[k] = d.x();
    packet.dy[k] = d.y();
    packet.dz[k] = d.z();
    packet.t_near[k] = 0;
    packet.t_far[k] = kInfinity;
    packet.valid[k] = -1;
  }
  return packet;
}

std::vector<MixedPixel> SamplePixels(const ShadingView& shading, std::span<const float> kept,
                                     const cv::Mat1f& radiance, std::span<const PixelAt> pixels,
                                     GeometryMask geometries) {
  const Sampler sampler(shading, kept, radiance);
  std::vector<MixedPixel> mixed;
  mixed.reserve(pixels.size());
  for (std::size_t first = 0; first < pixels.size(); first += Sampler::kPixels) {
    sampler.Sample(pixels.subspan(first, std::min(Sampler::kPixels, pixels.size() - first)),
                   geometries, &mixed);
  }
  return mixed;
}

}  // namespace aisle::sim
