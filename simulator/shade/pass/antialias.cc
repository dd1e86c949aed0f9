#include "simulator/shade/pass/antialias.h"

#include <bit>
#include <cstring>

#include "simulator/trace/tile_grid.h"

namespace aisle::sim {
namespace {

constexpr float kContrast = 0.04f;  // below this an edge cannot be seen in the noise
constexpr float kFaint = 0.1f;      // below this an edge is not worth a ray
constexpr float kFineRate = 0.25f;  // barycentrics a pixel: the triangle is four pixels wide
constexpr int kSamples = 4;
constexpr int kTileWidth = 64, kTileHeight = 16;
// A square turned by atan(1/2): distinct rows and columns for every sample.
constexpr std::array<std::array<float, 2>, kSamples> kOffsets = {
    {{-0.125f, -0.375f}, {0.375f, -0.125f}, {0.125f, 0.375f}, {-0.375f, 0.125f}}};

struct PixelAt {
  int x, y;
};
struct Mixed {
  PixelAt pixel;
  float radiance;
};

/// What is found in a tile.
struct Found {
  std::vector<Mixed> mixed;      ///< pixels whose new value is known
  std::vector<PixelAt> unknown;  ///< pixels that need rays
};

class Edges {
 public:
  Edges(const World& world, const CameraView& view, const HitImage& image,
        const SurfaceTables& tables, const cv::Mat1f& radiance)
      : mesh_(world.statics().mesh),
        view_(view),
        image_(image),
        tables_(tables),
        radiance_(radiance) {}

  /// The tile begins at a multiple of eight. Goes down columns of eight pixels, because most edges
  /// of a hall stand upright and the rays of neighbours share a packet.
  Found Find(const Tile& tile) const {
    Found found;
    for (int x = tile.x0; x < tile.x1; x += kLanes) {
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (unsigned left = Candidates(x, y); left; left &= left - 1) {
          Classify({x + std::countr_zero(left), y}, &found);
        }
      }
    }
    return found;
  }

 private:
  /// Which of eight pixels of a row may differ from a neighbour: few do, and eight at a time are
  /// quickly asked. At the image's border all may.
  unsigned Candidates(int x, int y) const {
    if (x == 0 || y == 0 || y + 1 == image_.height || x + kLanes >= image_.width) {
      return (1u << std::min(kLanes, image_.width - x)) - 1;
    }
    const std::size_t i = image_.Index(x, y);
    const auto stride = static_cast<std::size_t>(image_.stride);
    const I8 geometry = LoadI(&image_.geometry[i]), primitive = LoadI(&image_.primitive[i]);
    const F8 mine = LoadF(&radiance_(y, x));
    const auto differs = [&](std::size_t j, const float* radiance) {
      const F8 other = LoadF(radiance);
      return ((LoadI(&image_.geometry[j]) != geometry) |
              (LoadI(&image_.primitive[j]) != primitive)) &
             (Abs(mine - other) > kContrast * Max(mine, other));
    };
    const I8 any = differs(i - 1, &radiance_(y, x - 1)) | differs(i + 1, &radiance_(y, x + 1)) |
                   differs(i - stride, &radiance_(y - 1, x)) |
                   differs(i + stride, &radiance_(y + 1, x));
    return Bits(any);
  }

  void Classify(PixelAt p, Found* found) const {
    constexpr std::array<PixelAt, 4> kSteps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    std::array<bool, 4> differs{};
    bool any = false;
    for (std::size_t i = 0; i < 4; ++i) {
      const PixelAt q = {p.x + kSteps[i].x, p.y + kSteps[i].y};
      differs[i] =
          q.x >= 0 && q.y >= 0 && q.x < image_.width && q.y < image_.height && Differ(p, q);
      any |= differs[i];
    }
    if (!any) return;
    if (MixFaint(p, kSteps, differs, found)) return;
    if ((differs[0] && differs[1]) || (differs[2] && differs[3])) {  // a thing one pixel wide
      found->unknown.push_back(p);
      return;
    }
    float share = 0;  // of the pixel that the neighbour's surface covers
    PixelAt other = p;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!differs[i]) continue;
      const PixelAt q = {p.x + kSteps[i].x, p.y + kSteps[i].y};
      const bool p_is_near = image_.t[Index(p)] <= image_.t[Index(q)];
      const float crossing = p_is_near ? Crossing(p, q) : 1 - Crossing(q, p);
      if (!(crossing >= 0 && crossing <= 1)) {
        found->unknown.push_back(p);
        return;
      }
      if (0.5f - crossing > share) {
        share = 0.5f - crossing;
        other = q;
      }
    }
    if (share <= 0) return;
    const float mine = radiance_(p.y, p.x);
    found->mixed.push_back({p, mine + share * (radiance_(other.y, other.x) - mine)});
  }

  /// Where all sides are nearly as bright, the edge is given the place it has on average: the other
  /// side covers a quarter of the pixel.
  bool MixFaint(PixelAt p, std::span<const PixelAt> steps, std::span<const bool> differs,
                Found* found) const {
    const float mine = radiance_(p.y, p.x);
    float sum = 0, count = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (!differs[i]) continue;
      const float other = radiance_(p.y + steps[i].y, p.x + steps[i].x);
      if (std::abs(other - mine) > kFaint * std::max(other, mine)) return false;
      sum += other;
      count += 1;
    }
    found->mixed.push_back({p, mine + 0.25f * (sum / count - mine)});
    return true;
  }

  std::size_t Index(PixelAt p) const { return image_.Index(p.x, p.y); }

  bool Differ(PixelAt p, PixelAt q) const {
    const std::size_t i = Index(p), j = Index(q);
    if (image_.primitive[i] == image_.primitive[j] && image_.geometry[i] == image_.geometry[j]) {
      return false;
    }
    const float a = radiance_(p.y, p.x), b = radiance_(q.y, q.x);
    if (std::abs(a - b) <= kContrast * std::max(a, b)) return false;
    if (image_.geometry[i] != image_.geometry[j]) return true;
    if (image_.geometry[i] != 0) return std::abs(image_.t[i] - image_.t[j]) > 0.02f * image_.t[i];
    // Two triangles of one flat, plain face are no edge.
    const SurfaceRecord& first = tables_.statics()[image_.primitive[i]];
    const SurfaceRecord& second = tables_.statics()[image_.primitive[j]];
    const Eigen::Map<const Eigen::Vector3f> n(first.normal), m(second.normal);
    return first.texture != second.texture || first.albedo != second.albedo || n.dot(m) < 0.99f ||
           std::abs(image_.t[i] - image_.t[j]) > 0.02f * image_.t[i];
  }

  /// Where on the way from pixel p to its neighbour q (0 to 1) the ray leaves the triangle seen at
  /// p; beyond 1, or -1 where the triangle says little about the outline.
  float Crossing(PixelAt p, PixelAt q) const {
    const std::size_t i = Index(p);
    if (image_.geometry[i] != 0) return -1;
    const PixelRays& rays = *view_.rays;
    const Eigen::Vector2f here_xy = rays.At(p.x, p.y), there_xy = rays.At(q.x, q.y);
    const Eigen::Vector3f d = view_.rotation * here_xy.homogeneous();
    const Eigen::Vector2f turn = there_xy - here_xy;
    const Eigen::Vector3f step = view_.rotation * Eigen::Vector3f(turn.x(), turn.y(), 0);
    const auto& [ia, ib, ic] = mesh_.triangles[image_.primitive[i]];
    const Eigen::Vector3f a = mesh_.positions[ia] - view_.origin;
    const Eigen::Vector3f b = mesh_.positions[ib] - view_.origin;
    const Eigen::Vector3f c = mesh_.positions[ic] - view_.origin;
    // A ray is inside while its products with the three side planes have one sign; they are linear
    // along the image.
    const std::array<Eigen::Vector3f, 3> planes = {b.cross(c), c.cross(a), a.cross(b)};
    std::array<float, 3> here, rate;
    float total = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      here[k] = planes[k].dot(d);
      rate[k] = planes[k].dot(step);
      total += here[k];
    }
    float first = 2;
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(rate[k]) > kFineRate * std::abs(total)) return -1;
      const float leaves = -here[k] / rate[k];
      // Negative: it moves away from this side.
      if (rate[k] * total < 0 && leaves < first) first = std::max(0.0f, leaves);
    }
    return first;
  }

  const TriangleMesh& mesh_;
  const CameraView& view_;
  const HitImage& image_;
  const SurfaceTables& tables_;
  const cv::Mat1f& radiance_;
};

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

/// Shades pixels by four rays each.
class Sampler {
 public:
  static constexpr std::size_t kPixels = kLanes / kSamples;  ///< a packet

  Sampler(const Instant& instant, const CameraView& view, const HitImage& image,
          const SurfaceTables& tables, const FrameLight& frame, const TexturePool& textures,
          std::span<const float> kept, const cv::Mat1f& radiance)
      : instant_(instant),
        view_(view),
        image_(image),
        tables_(tables),
        frame_(frame),
        textures_(textures),
        kept_(kept),
        radiance_(radiance),
        // Half a pixel: the spacing of the samples.
        step_{view.rotation.col(0) * view.rays->step_x * 0.5f,
              view.rotation.col(1) * view.rays->step_y * 0.5f} {}

  /// Up to kPixels pixels.
  void Sample(std::span<const PixelAt> pixels, GeometryMask geometries,
              std::vector<Mixed>* mixed) const {
    const Rays8 rays = SampleRays(view_, pixels);
    Hits8 hits;
    instant_.Intersect(rays, Coherence::kCoherent, geometries, &hits);
    const std::size_t samples = pixels.size() * kSamples;
    std::array<float, kLanes> value;
    bool all_found = true;
    for (std::size_t k = 0; k < samples; ++k) {
      value[k] = RadianceAround(image_, radiance_, pixels[k / kSamples], hits, k);
      all_found &= value[k] >= 0;
    }
    if (!all_found) {
      const F8 light = LightOf(rays, hits);
      for (std::size_t k = 0; k < samples; ++k) {
        if (value[k] >= 0) continue;
        value[k] = light[static_cast<int>(k)];
        if (hits.geometry[k] == 0) {
          value[k] *= KeptNear(image_, kept_, pixels[k / kSamples], hits.t[k]);
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
    return RadianceOfHits(tables_, frame_, textures_, directions, hits, step_);
  }

  const Instant& instant_;
  const CameraView& view_;
  const HitImage& image_;
  const SurfaceTables& tables_;
  const FrameLight& frame_;
  const TexturePool& textures_;
  std::span<const float> kept_;
  const cv::Mat1f& radiance_;
  RayStep step_;
};

}  // namespace

void AntialiasEdges(const World& world, const Instant& instant, const CameraView& view,
                    const HitImage& image, const SurfaceTables& tables, const FrameLight& frame,
                    const TexturePool& textures, std::span<const float> kept, cv::Mat1f* radiance) {
  const TileGrid grid{image.width, image.height, kTileWidth, kTileHeight};
  std::vector<Found> tiles(grid.size());
  const Edges edges(world, view, image, tables, *radiance);
  const Sampler sampler(instant, view, image, tables, frame, textures, kept, *radiance);
  grid.ForEach([&](std::size_t i, const Tile& tile) {
    Found& found = tiles[i];
    found = edges.Find(tile);
    if (found.unknown.empty()) return;
    const GeometryMask geometries =
        GeometriesInWindow(instant, view, tile.x0, tile.y0, tile.x1, tile.y1);
    const std::span<const PixelAt> unknown = found.unknown;
    for (std::size_t first = 0; first < unknown.size(); first += Sampler::kPixels) {
      sampler.Sample(unknown.subspan(first, std::min(Sampler::kPixels, unknown.size() - first)),
                     geometries, &found.mixed);
    }
  });
  // All new values are known before the first pixel changes.
  for (const Found& found : tiles) {
    for (const Mixed& mixed : found.mixed) {
      (*radiance)(mixed.pixel.y, mixed.pixel.x) = mixed.radiance;
    }
  }
}

}  // namespace aisle::sim
