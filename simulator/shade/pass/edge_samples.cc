#include "simulator/shade/pass/edge_samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>

#include "simulator/shade/lanes/ray_packets.h"
#include "simulator/shade/pass/beam_light.h"
#include "simulator/shade/pass/pixels_around.h"

namespace aisle::sim {
namespace {

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

/// The samples of up to two pixels.
struct Packet {
  std::span<const PixelAt> pixels;
  GeometryMask geometries;  ///< that may be met
  Rays8 rays;
  PixelsAround around;
  Hits8 hits;
};

/// A sample whose hit has to be asked for, or confirmed.
struct Question {
  Packet* packet;
  std::size_t lane;
};

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

  /// What the samples of up to kPixels pixels meet, as far as what is seen around tells: the rest
  /// is added to `questions`.
  void Begin(std::span<const PixelAt> pixels, const MoverWindows& movers,
             std::vector<Packet>* packets, std::vector<Question>* questions) const {
    GeometryMask geometries = 0;
    for (const auto& [x, y] : pixels) geometries |= movers.In(x, y, x + 1, y + 1);
    packets->push_back({pixels,
                        geometries,
                        SampleRays(shading_.view, pixels),
                        PixelsAround(shading_.image, radiance_, pixels),
                        {}});
    Packet& packet = packets->back();
    I8 asked = WideInt(-1);
    if (packet.around.all_static()) {
      packet.hits = packet.around.Meet(shading_.instant, packet.rays);
      if (geometries == kStaticOnly) {
        asked = (LoadI(packet.hits.geometry) != 0) | BehindSomething(packet);
      }
    } else {
      Store(Wide(kInfinity), packet.hits.t);
      StoreI(WideInt(-1), packet.hits.geometry);
    }
    unsigned left = Bits(asked) & ((1u << pixels.size() * kSamples) - 1);
    for (; left; left &= left - 1) {
      questions->push_back({&packet, static_cast<std::size_t>(std::countr_zero(left))});
    }
  }

  /// Sends the rays of up to kLanes · kMostPackets questions, each up to the hit that is known.
  void Ask(std::span<const Question> questions) const {
    std::array<Rays8, Instant::kMostPackets> rays;
    std::array<Hits8, Instant::kMostPackets> found;
    std::size_t packets = 0;
    GeometryMask geometries = 0;
    for (std::size_t q = 0; q < questions.size(); q += kLanes) {
      const std::size_t count = std::min<std::size_t>(kLanes, questions.size() - q);
      rays[packets++] = RaysOf(questions.subspan(q, count));
    }
    for (const Question& question : questions) geometries |= question.packet->geometries;
    shading_.instant.Intersect(std::span(rays).first(packets), Coherence::kCoherent, geometries,
                               found);
    for (std::size_t q = 0; q < questions.size(); ++q) {
      const Hits8& from = found[q / kLanes];
      const std::size_t k = q % kLanes;
      if (from.geometry[k] == kNoGeometry) continue;
      const auto& [packet, lane] = questions[q];
      packet->hits.t[lane] = from.t[k];
      packet->hits.u[lane] = from.u[k];
      packet->hits.v[lane] = from.v[k];
      packet->hits.geometry[lane] = from.geometry[k];
      packet->hits.primitive[lane] = from.primitive[k];
    }
  }

  void Mix(const Packet& packet, std::vector<MixedPixel>* mixed) const {
    const auto& [pixels, geometries, rays, around, hits] = packet;
    F8 value = around.RadianceOf(hits);
    if (Any(value < 0)) {
      const F8 light = LightOf(rays, hits);
      for (std::size_t k = 0; k < pixels.size() * kSamples; ++k) {
        if (value[k] >= 0) continue;
        value[k] = light[k];
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
  I8 BehindSomething(const Packet& packet) const {
    constexpr int kStride = sizeof(SurfaceRecord) / sizeof(float);
    const float* normal = shading_.tables.statics()[0].normal;
    const I8 at = LoadI(packet.hits.primitive) * kStride;
    const F8x3 normals = {Gather(normal, at), Gather(normal + 1, at), Gather(normal + 2, at)};
    const PixelAt& pixel = packet.pixels.front();
    const PixelRays::Step step = shading_.view.rays->StepAt(pixel.x, pixel.y);
    const auto turned = [&](const Eigen::Vector2f& way) {
      return Eigen::Vector3f(shading_.view.rotation.leftCols<2>() * way);
    };
    return packet.around.BehindSomething(packet.rays, packet.hits, normals, turned(step.right),
                                         turned(step.down));
  }

  Rays8 RaysOf(std::span<const Question> questions) const {
    constexpr float kAlmostThere = 1 - 1e-4f;  // short of the triangle that is known to be met
    F8x3 way = {Wide(0), Wide(0), Wide(1)};
    F8 t_far = Wide(kInfinity);
    for (std::size_t k = 0; k < questions.size(); ++k) {
      const auto& [packet, lane] = questions[k];
      way.x[k] = packet->rays.dx[lane];
      way.y[k] = packet->rays.dy[lane];
      way.z[k] = packet->rays.dz[lane];
      t_far[k] = kAlmostThere * packet->hits.t[lane];
    }
    const Eigen::Vector3f& o = shading_.view.origin;
    return MakeRays({Wide(o.x()), Wide(o.y()), Wide(o.z())}, way, t_far,
                    LanesOf((1u << questions.size()) - 1));
  }

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
    return seen.reflectance * (seen.irradiance + beams) * std::numbers::inv_pi_v<float> +
           GlowOfHits(shading_.tables, LoadI(hits.geometry), LoadI(hits.primitive));
  }

  const ShadingView& shading_;
  std::span<const float> kept_;
  const cv::Mat1f& radiance_;
  RayStep step_;
};

}  // namespace

Rays8 SampleRays(const CameraView& view, std::span<const PixelAt> pixels) {
  static_assert(kLanes == 2 * kSamples);
  const PixelRays& rays = *view.rays;
  const PixelAt first = pixels.front(), last = pixels.back();
  const auto two = [](float a, float b) { return F8{a, a, a, a, b, b, b, b}; };
  const Eigen::Vector2f at = rays.At(first.x, first.y), then = rays.At(last.x, last.y);
  const PixelRays::Step step = rays.StepAt(first.x, first.y);
  const PixelRays::Step other = rays.straight ? step : rays.StepAt(last.x, last.y);
  const F8 x = two(at.x(), then.x()) + kSampleX * two(step.right.x(), other.right.x()) +
               kSampleY * two(step.down.x(), other.down.x());
  const F8 y = two(at.y(), then.y()) + kSampleX * two(step.right.y(), other.right.y()) +
               kSampleY * two(step.down.y(), other.down.y());
  const Eigen::Matrix3f& r = view.rotation;
  const auto row = [&](int i) { return r(i, 0) * x + r(i, 1) * y + r(i, 2); };
  const Eigen::Vector3f& o = view.origin;
  return MakeRays({Wide(o.x()), Wide(o.y()), Wide(o.z())}, {row(0), row(1), row(2)},
                  Wide(kInfinity), WideInt(-1));
}

std::vector<MixedPixel> SamplePixels(const ShadingView& shading, std::span<const float> kept,
                                     const cv::Mat1f& radiance, std::span<const PixelAt> pixels,
                                     const MoverWindows& movers) {
  // Packets whose questions are asked together, so that rays fill their packets.
  constexpr std::size_t kBatch = Instant::kMostPackets;
  const Sampler sampler(shading, kept, radiance);
  std::vector<MixedPixel> mixed;
  mixed.reserve(pixels.size());
  std::vector<Packet> packets;
  packets.reserve(kBatch);  // questions point to them
  std::vector<Question> questions;
  for (std::size_t first = 0; first < pixels.size();) {
    packets.clear();
    questions.clear();
    for (; packets.size() < kBatch && first < pixels.size(); first += Sampler::kPixels) {
      const std::size_t count = std::min(Sampler::kPixels, pixels.size() - first);
      sampler.Begin(pixels.subspan(first, count), movers, &packets, &questions);
    }
    if (!questions.empty()) sampler.Ask(questions);
    for (const Packet& packet : packets) sampler.Mix(packet, &mixed);
  }
  return mixed;
}

}  // namespace aisle::sim
