#include "simulator/shade/pass/edge_samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>

#include "simulator/shade/lanes/ray_packets.h"
#include "simulator/shade/pass/beam_light.h"
#include "simulator/shade/pass/mover_blockers.h"
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
  Rays8 rays;
  PixelsAround around;
  Hits8 hits;
};

/// A sample whose hit has to be asked for, or confirmed, and of what.
struct Question {
  Packet* packet;
  std::size_t lane;
  GeometryMask geometries;
};

/// What is asked together: samples of which little is known, and those that only a mover may still
/// be before, as the static world's triangle is known.
struct Questions {
  std::vector<Question> of_all, of_movers;

  void Clear() {
    of_all.clear();
    of_movers.clear();
  }
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
  void Begin(std::span<const PixelAt> pixels, std::vector<Packet>* packets,
             Questions* questions) const {
    packets->push_back({pixels,
                        SampleRays(shading_.view, pixels),
                        PixelsAround(shading_.image, radiance_, pixels),
                        {}});
    Packet& packet = packets->back();
    GeometryMask geometries = 0;
    for (const auto& [x, y] : pixels) {
      geometries |= shading_.image.movers.In(x, y, x + 1, y + 1);
    }
    const I8 lanes = LanesOf((1u << pixels.size() * kSamples) - 1);
    if (!packet.around.all_static()) {
      Store(Wide(kInfinity), packet.hits.t);
      StoreI(WideInt(-1), packet.hits.geometry);
      AddQuestions(lanes, geometries, &packet, &questions->of_all);
      return;
    }
    packet.hits = packet.around.Meet(shading_.instant, packet.rays);
    const I8 doubtful = (LoadI(packet.hits.geometry) != 0) | BehindSomething(packet);
    AddQuestions(lanes & doubtful, geometries, &packet, &questions->of_all);
    const I8 known = lanes & ~doubtful;
    const GeometryMask before =
        MayMeet(shading_.instant, geometries & kMoversOnly, WaysOf(packet, known));
    if (before) AddQuestions(known, before, &packet, &questions->of_movers);
  }

  /// Sends the rays of up to kLanes · kMostPackets questions, each up to the hit that is known.
  void Ask(std::span<const Question> questions) const {
    if (questions.empty()) return;
    std::array<Rays8, Instant::kMostPackets> rays;
    std::array<Hits8, Instant::kMostPackets> found;
    std::size_t packets = 0;
    GeometryMask geometries = 0;
    for (std::size_t q = 0; q < questions.size(); q += kLanes) {
      const std::size_t count = std::min<std::size_t>(kLanes, questions.size() - q);
      rays[packets++] = RaysOf(questions.subspan(q, count));
    }
    for (const Question& question : questions) geometries |= question.geometries;
    shading_.instant.Intersect(std::span(rays).first(packets), Coherence::kCoherent, geometries,
                               found);
    for (std::size_t q = 0; q < questions.size(); ++q) {
      const Hits8& from = found[q / kLanes];
      const std::size_t k = q % kLanes;
      if (from.geometry[k] == kNoGeometry) continue;
      const auto& [packet, lane, asked] = questions[q];
      packet->hits.t[lane] = from.t[k];
      packet->hits.u[lane] = from.u[k];
      packet->hits.v[lane] = from.v[k];
      packet->hits.geometry[lane] = from.geometry[k];
      packet->hits.primitive[lane] = from.primitive[k];
    }
  }

  void Mix(const Packet& packet, std::vector<MixedPixel>* mixed) const {
    const auto& [pixels, rays, around, hits] = packet;
    F8 value = around.RadianceOf(hits);
    if (Any(value < 0)) {
      F8 kept = Wide(1);
      for (std::size_t k = 0; k < pixels.size() * kSamples; ++k) {
        if (value[k] >= 0 || hits.geometry[k] != 0) continue;
        kept[k] = KeptNear(shading_.image, kept_, pixels[k / kSamples], hits.t[k]);
      }
      value = Select(value < 0, LightOf(rays, hits, kept), value);
    }
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      float sum = 0;
      for (std::size_t k = p * kSamples; k < (p + 1) * kSamples; ++k) sum += value[k];
      mixed->push_back({pixels[p], sum / kSamples});
    }
  }

 private:
  static void AddQuestions(I8 lanes, GeometryMask geometries, Packet* packet,
                           std::vector<Question>* questions) {
    for (unsigned left = Bits(lanes); left; left &= left - 1) {
      questions->push_back({packet, static_cast<std::size_t>(std::countr_zero(left)), geometries});
    }
  }

  /// The lanes' ways to what is known to be met.
  static Segments8 WaysOf(const Packet& packet, I8 lanes) {
    const Rays8& rays = packet.rays;
    return {{LoadF(rays.ox), LoadF(rays.oy), LoadF(rays.oz)},
            {LoadF(rays.dx), LoadF(rays.dy), LoadF(rays.dz)},
            LoadF(packet.hits.t),
            lanes};
  }

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
      const auto& [packet, lane, asked] = questions[k];
      way.x[k] = packet->rays.dx[lane];
      way.y[k] = packet->rays.dy[lane];
      way.z[k] = packet->rays.dz[lane];
      t_far[k] = kAlmostThere * packet->hits.t[lane];
    }
    const Eigen::Vector3f& o = shading_.view.origin;
    return MakeRays({Wide(o.x()), Wide(o.y()), Wide(o.z())}, way, t_far,
                    LanesOf((1u << questions.size()) - 1));
  }

  /// `kept`: what movers leave of the irradiance. Beams know that by shadow rays of their own.
  F8 LightOf(const Rays8& rays, const Hits8& hits, F8 kept) const {
    const F8x3 directions = {LoadF(rays.dx), LoadF(rays.dy), LoadF(rays.dz)};
    if (!shading_.world().has_beams()) {
      return kept * RadianceOfHits(shading_.tables, shading_.frame, shading_.textures, directions,
                                   hits, step_);
    }
    const SurfaceLanes seen = LookUpHits(shading_.tables, shading_.frame, shading_.textures,
                                         LoadI(hits.geometry), LoadI(hits.primitive),
                                         {LoadF(hits.t), LoadF(hits.u), LoadF(hits.v), directions.x,
                                          directions.y, directions.z, I8{}},
                                         step_);
    const F8 beams = BeamsAtHits(shading_, BeamLight(shading_.instant), rays, hits);
    return seen.reflectance * (seen.irradiance * kept + beams) * std::numbers::inv_pi_v<float> +
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
                                     const cv::Mat1f& radiance, std::span<const PixelAt> pixels) {
  // Packets whose questions are asked together, so that rays fill their packets.
  constexpr std::size_t kBatch = Instant::kMostPackets;
  const Sampler sampler(shading, kept, radiance);
  std::vector<MixedPixel> mixed;
  mixed.reserve(pixels.size());
  std::vector<Packet> packets;
  packets.reserve(kBatch);  // questions point to them
  Questions questions;
  for (std::size_t first = 0; first < pixels.size();) {
    packets.clear();
    questions.Clear();
    for (; packets.size() < kBatch && first < pixels.size(); first += Sampler::kPixels) {
      const std::size_t count = std::min(Sampler::kPixels, pixels.size() - first);
      sampler.Begin(pixels.subspan(first, count), &packets, &questions);
    }
    sampler.Ask(questions.of_all);
    sampler.Ask(questions.of_movers);
    for (const Packet& packet : packets) sampler.Mix(packet, &mixed);
  }
  return mixed;
}

}  // namespace aisle::sim
