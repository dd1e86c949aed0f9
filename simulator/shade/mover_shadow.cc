#include "simulator/shade/mover_shadow.h"

#include <tbb/parallel_for.h>

#include <cstring>

#include "simulator/shade/hemisphere.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 16, kTileHeight = 8;
constexpr float kLift = 2e-3f;            // m, along the normal
constexpr float kReach = 1.5f;            // m: how far a mover darkens indirect light
constexpr float kMoverReflection = 0.3f;  // what blocking parts of a mover send on in turn
constexpr int kPattern = 16;              // pixels of the 4 × 4 pattern
constexpr int kAmbientRays = 2;           // a pixel

/// One light and the movers that may stand between it and a tile.
struct Blocker {
  std::size_t light;
  GeometryMask movers;
};

struct TileWork {
  std::vector<Blocker> blockers;
  GeometryMask near = 0;  ///< movers that may darken indirect light
  bool empty() const { return blockers.empty() && near == 0; }
};

struct Pixel {
  Eigen::Vector3f position, normal;
};

class Pass {
 public:
  Pass(const Instant& instant, const EyeView& view, const HitImage& image, const World& world,
       const SurfaceTables& tables, const FrameLight& frame, std::span<const float> irradiance)
      : instant_(instant),
        view_(view),
        image_(image),
        world_(world),
        tables_(tables),
        frame_(frame),
        irradiance_(irradiance),
        ambient_(CosineDirections(kPattern * kAmbientRays)) {}

  /// Unfiltered share per pixel of one tile, and whether any differs from 1.
  bool TraceTile(int x0, int y0, std::vector<float>* raw) const {
    const int x1 = std::min(x0 + kTileWidth, image_.width);
    const int y1 = std::min(y0 + kTileHeight, image_.height);
    const TileWork work = Plan(x0, y0, x1, y1);
    if (work.empty()) return false;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; x += kLanes) TracePacket(x, y, x1, work, raw);
    }
    return true;
  }

 private:
  bool IsStatic(std::size_t i) const { return image_.geometry[i] == 0; }

  Pixel Locate(int x, int y) const {
    const std::size_t i = image_.Index(x, y);
    const auto ray = static_cast<std::size_t>(y * view_.rays->width + x);
    const Eigen::Vector3f direction =
        view_.rotation * Eigen::Vector3f(view_.rays->x[ray], view_.rays->y[ray], 1);
    Pixel pixel;
    pixel.normal = Eigen::Map<const Eigen::Vector3f>(tables_.statics()[image_.primitive[i]].normal);
    pixel.position = view_.origin + image_.t[i] * direction + kLift * pixel.normal;
    return pixel;
  }

  /// Which lights and movers can matter for a tile: the segment from the middle of the tile's box
  /// to the light's centre, thickened by whichever is larger, must meet the mover's box.
  TileWork Plan(int x0, int y0, int x1, int y1) const {
    Eigen::AlignedBox3f box;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        if (IsStatic(image_.Index(x, y))) box.extend(Locate(x, y).position);
      }
    }
    TileWork work;
    if (box.isEmpty()) return work;
    const auto& movers = instant_.mover_boxes();
    for (std::size_t m = 0; m < movers.size(); ++m) {
      const Eigen::AlignedBox3f reach(movers[m].min() - Eigen::Vector3f::Constant(kReach),
                                      movers[m].max() + Eigen::Vector3f::Constant(kReach));
      if (reach.intersects(box)) work.near |= MoverBit(m);
    }
    for (std::size_t l = 0; l < world_.lights().size(); ++l) {
      const AreaLight& light = world_.lights()[l];
      const float scale = instant_.snapshot().light_scale[l];
      if (scale <= 0) continue;
      const Eigen::Vector3f light_half = light.half_u.cwiseAbs() + light.half_v.cwiseAbs();
      const Eigen::Vector3f thick = light_half.cwiseMax(box.sizes() / 2);
      GeometryMask mask = 0;
      for (std::size_t m = 0; m < movers.size(); ++m) {
        if (SegmentMeets({movers[m].min() - thick, movers[m].max() + thick}, box.center(),
                         light.center)) {
          mask |= MoverBit(m);
        }
      }
      if (mask) work.blockers.push_back({l, mask});
    }
    return work;
  }

  static bool SegmentMeets(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& from,
                           const Eigen::Vector3f& to) {
    float near = 0, far = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const float d = to[axis] - from[axis];
      const float safe = std::abs(d) < 1e-9f ? std::copysign(1e-9f, d) : d;
      const float a = (box.min()[axis] - from[axis]) / safe;
      const float b = (box.max()[axis] - from[axis]) / safe;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far;
  }

  void TracePacket(int x, int y, int x1, const TileWork& work, std::vector<float>* raw) const {
    std::array<Pixel, kLanes> pixels;
    std::array<bool, kLanes> active{};
    bool any = false;
    for (int k = 0; k < kLanes && x + k < x1; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      active[lane] = IsStatic(image_.Index(x + k, y));
      if (active[lane]) pixels[lane] = Locate(x + k, y);
      any |= active[lane];
    }
    if (!any) return;
    std::array<float, kLanes> lost{};
    for (const Blocker& blocker : work.blockers) {
      LoseDirect(blocker, pixels, active, x, y, &lost);
    }
    if (work.near) LoseIndirect(work.near, pixels, active, x, y, &lost);
    for (int k = 0; k < kLanes && x + k < x1; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      const std::size_t i = image_.Index(x + k, y);
      if (active[lane] && lost[lane] > 0) {
        (*raw)[i] = std::max(0.0f, 1 - lost[lane] / std::max(irradiance_[i], 1e-9f));
      }
    }
  }

  /// Which of the sixteen sample positions a pixel uses: each 4 × 4 block has all of them.
  static int PatternIndex(int x, int y) {
    // Bit-reversed order, so that neighbours differ much.
    constexpr std::array<int, kPattern> kOrder = {0, 8,  2, 10, 12, 4, 14, 6,
                                                  3, 11, 1, 9,  15, 7, 13, 5};
    return kOrder[static_cast<std::size_t>((y & 3) * 4 + (x & 3))];
  }

  void LoseDirect(const Blocker& blocker, const std::array<Pixel, kLanes>& pixels,
                  const std::array<bool, kLanes>& active, int x, int y,
                  std::array<float, kLanes>* lost) const {
    const AreaLight& light = world_.lights()[blocker.light];
    const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
    const float power =
        4 * light.radiance * instant_.snapshot().light_scale[blocker.light];  // times |cross|
    Rays8 rays;
    std::array<float, kLanes> weight{};
    for (int k = 0; k < kLanes; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      rays.valid[k] = 0;
      if (!active[lane]) continue;
      const Eigen::Vector2f s = SpreadPoint(PatternIndex(x + k, y));
      const Eigen::Vector3f to = light.center + (2 * s.x() - 1) * light.half_u +
                                 (2 * s.y() - 1) * light.half_v - pixels[lane].position;
      const float here = to.dot(pixels[lane].normal), there = -to.dot(cross);
      if (here <= 0 || there <= 0) continue;
      const float squared = to.squaredNorm();
      weight[lane] = power * here * there / (squared * squared);
      SetRay(pixels[lane].position, to, 0.998f, k, &rays);
    }
    const unsigned blocked = instant_.Occluded(rays, Coherence::kCoherent, blocker.movers);
    if (!blocked) return;
    for (int k = 0; k < kLanes; ++k) rays.valid[k] = blocked >> k & 1 ? -1 : 0;
    // What the static world keeps away anyway is not the mover's to take.
    const unsigned dark = instant_.Occluded(rays, Coherence::kCoherent, kStaticOnly);
    for (unsigned k = 0; k < kLanes; ++k) {
      if ((blocked & ~dark) >> k & 1) (*lost)[k] += weight[k];
    }
  }

  void LoseIndirect(GeometryMask movers, const std::array<Pixel, kLanes>& pixels,
                    const std::array<bool, kLanes>& active, int x, int y,
                    std::array<float, kLanes>* lost) const {
    std::array<int, kLanes> blocked{};
    for (int ray = 0; ray < kAmbientRays; ++ray) {
      Rays8 rays;
      for (int k = 0; k < kLanes; ++k) {
        const auto lane = static_cast<std::size_t>(k);
        rays.valid[k] = 0;
        if (!active[lane]) continue;
        const auto d = static_cast<std::size_t>(PatternIndex(x + k, y) + ray * kPattern);
        SetRay(pixels[lane].position, BasisAround(pixels[lane].normal) * ambient_[d], kReach, k,
               &rays);
      }
      const unsigned hit = instant_.Occluded(rays, Coherence::kIncoherent, movers);
      for (unsigned k = 0; k < kLanes; ++k) blocked[k] += hit >> k & 1;
    }
    for (int k = 0; k < kLanes; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      if (!active[lane] || blocked[lane] == 0) continue;
      const std::size_t i = image_.Index(x + k, y);
      const SurfaceRecord& record = tables_.statics()[image_.primitive[i]];
      const float direct =
          ReadLight(record.light, frame_.statics->direct, image_.u[i], image_.v[i]);
      (*lost)[lane] += std::max(0.0f, irradiance_[i] - direct) * (1 - kMoverReflection) *
                       static_cast<float>(blocked[lane]) / kAmbientRays;
    }
  }

  const Instant& instant_;
  const EyeView& view_;
  const HitImage& image_;
  const World& world_;
  const SurfaceTables& tables_;
  const FrameLight& frame_;
  std::span<const float> irradiance_;
  std::vector<Eigen::Vector3f> ambient_;
};

/// Mean over the 4 × 4 pattern around each pixel, of pixels on the same plane only.
void FilterTile(const HitImage& image, const SurfaceTables& tables, std::span<const float> raw,
                int x0, int y0, std::vector<float>* kept) {
  // Half weights at the ends: each of the sixteen pattern positions then counts the same.
  constexpr std::array<float, 5> kWeights = {0.5f, 1, 1, 1, 0.5f};
  for (int y = y0; y < std::min(y0 + kTileHeight, image.height); ++y) {
    for (int x = x0; x < std::min(x0 + kTileWidth, image.width); ++x) {
      const std::size_t i = image.Index(x, y);
      if (image.geometry[i] != 0) continue;
      const Eigen::Map<const Eigen::Vector3f> normal(tables.statics()[image.primitive[i]].normal);
      float sum = 0, weights = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          const int px = x + dx, py = y + dy;
          if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
          const std::size_t j = image.Index(px, py);
          if (image.geometry[j] != 0 || std::abs(image.t[j] - image.t[i]) > 0.05f * image.t[i]) {
            continue;
          }
          const Eigen::Map<const Eigen::Vector3f> other(
              tables.statics()[image.primitive[j]].normal);
          if (image.primitive[j] != image.primitive[i] && normal.dot(other) < 0.9f) continue;
          const float w = kWeights[static_cast<std::size_t>(dx + 2)] *
                          kWeights[static_cast<std::size_t>(dy + 2)];
          sum += w * raw[j];
          weights += w;
        }
      }
      (*kept)[i] = sum / weights;
    }
  }
}

}  // namespace

void TraceMoverShadows(const Instant& instant, const EyeView& view, const HitImage& image,
                       const World& world, const SurfaceTables& tables, const FrameLight& frame,
                       std::span<const float> irradiance, std::vector<float>* kept) {
  kept->assign(irradiance.size(), 1);
  if (instant.snapshot().movers.empty()) return;
  std::vector<float> raw(irradiance.size(), 1);
  const Pass pass(instant, view, image, world, tables, frame, irradiance);
  const int columns = (image.width + kTileWidth - 1) / kTileWidth;
  const int rows = (image.height + kTileHeight - 1) / kTileHeight;
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(columns * rows));
  tbb::parallel_for(0, columns * rows, [&](int i) {
    touched[static_cast<std::size_t>(i)] =
        pass.TraceTile(i % columns * kTileWidth, i / columns * kTileHeight, &raw);
  });
  const auto is_touched = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < columns && row < rows &&
           touched[static_cast<std::size_t>(row * columns + column)];
  };
  tbb::parallel_for(0, columns * rows, [&](int i) {
    const int column = i % columns, row = i / columns;
    bool near = false;
    for (int d = 0; d < 9; ++d) near |= is_touched(column + d % 3 - 1, row + d / 3 - 1);
    if (near) FilterTile(image, tables, raw, column * kTileWidth, row * kTileHeight, kept);
  });
}

}  // namespace aisle::sim
