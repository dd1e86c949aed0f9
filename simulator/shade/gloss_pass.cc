#include "simulator/shade/gloss_pass.h"

#include <tbb/parallel_for.h>

#include <numbers>

#include "simulator/shade/gloss.h"
#include "simulator/shade/hemisphere.h"
#include "simulator/shade/pattern_filter.h"
#include "simulator/shade/ray_packets.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 16, kTileHeight = 8;
constexpr float kLift = 2e-3f;      // m, along the normal
constexpr float kFootprint = 3.0f;  // pixels: how wide mirrored textures are averaged
// Sixteen rays cannot find a lamp evenly in a broad lobe: beyond this roughness what a ray meets
// counts no more than so many times the light on the surface itself.
constexpr float kBroad = 0.2f, kBrightest = 3.0f;
constexpr float kGrazing = 0.02f;  // cosines below this are raised to it

/// Points of the unit disk for eight pixels of each row of the 4 × 4 pattern.
struct DiskPattern {
  struct Row {
    F8 radius, cos_phi, sin_phi;
  };
  std::array<Row, 4> rows;

  DiskPattern() {
    constexpr std::array<int, 16> kOrder = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    for (std::size_t y = 0; y < 4; ++y) {
      for (int k = 0; k < kLanes; ++k) {
        const Eigen::Vector2f s = SpreadPoint(kOrder[y * 4 + static_cast<std::size_t>(k & 3)]);
        const float phi = 2 * std::numbers::pi_v<float> * s.y();
        rows[y].radius[k] = std::sqrt(s.x());
        rows[y].cos_phi[k] = std::cos(phi);
        rows[y].sin_phi[k] = std::sin(phi);
      }
    }
  }
};

/// Tangents of a normal; Duff et al. 2017, as BasisAround.
struct Frame8 {
  F8x3 x, y, z;

  explicit Frame8(const F8x3& n) : z(n) {
    const F8 sign = Select(n.z < 0, Wide(-1), Wide(1));
    const F8 a = -1 / (sign + n.z), b = n.x * n.y * a;
    x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }
  F8x3 ToLocal(const F8x3& d) const { return {Dot(x, d), Dot(y, d), Dot(z, d)}; }
  F8x3 ToWorld(const F8x3& d) const {
    return {x.x * d.x + y.x * d.y + z.x * d.z, x.y * d.x + y.y * d.y + z.y * d.z,
            x.z * d.x + y.z * d.y + z.z * d.z};
  }
};

class Pass {
 public:
  Pass(const Instant& instant, const EyeView& view, const HitImage& image,
       const SurfaceTables& tables, const FrameLight& frame, const TexturePool& textures)
      : instant_(instant),
        view_(view),
        image_(image),
        tables_(tables),
        frame_(frame),
        textures_(textures),
        step_{view.rotation.col(0) * view.rays->step_x * kFootprint,
              view.rotation.col(1) * view.rays->step_y * kFootprint} {}

  /// The glossy ones of eight pixels of a row.
  I8 Glossy(int x, int y) const {
    const std::size_t i = image_.Index(x, y);
    const I8 is_static = LoadI(&image_.geometry[i]) == 0;
    if (!Any(is_static)) return is_static;
    const I8 triangle = is_static ? LoadI(&image_.primitive[i]) : I8{};
    return is_static & (Gather(&tables_.finishes()[0].f0, triangle * 2) > 0);
  }

  /// Unfiltered radiance of eight pixels, and the diffuse base's share of their reflectance.
  void Trace(int x, int y, I8 glossy, const float* irradiance, float* reflectance,
             float* raw) const {
    const std::size_t i = image_.Index(x, y);
    const I8 triangle = glossy ? LoadI(&image_.primitive[i]) : I8{};
    const float* finish = &tables_.finishes()[0].f0;
    const F8 f0 = Gather(finish, triangle * 2), roughness = Gather(finish + 1, triangle * 2);
    const F8 alpha = roughness * roughness;

    const Eigen::Matrix3f& r = view_.rotation;
    const auto pixel = static_cast<std::size_t>(y * view_.rays->width + x);
    const F8 cx = LoadF(&view_.rays->x[pixel]), cy = LoadF(&view_.rays->y[pixel]);
    const F8x3 d = {r(0, 0) * cx + r(0, 1) * cy + r(0, 2), r(1, 0) * cx + r(1, 1) * cy + r(1, 2),
                    r(2, 0) * cx + r(2, 1) * cy + r(2, 2)};
    const F8 inverse = -1 / Sqrt(Dot(d, d));
    const F8x3 to_eye = {d.x * inverse, d.y * inverse, d.z * inverse};
    const Frame8 basis(Normal(triangle, to_eye));
    F8x3 out = basis.ToLocal(to_eye);
    out.z = Max(out.z, Wide(kGrazing));

    const DiskPattern::Row& disk = pattern_.rows[static_cast<std::size_t>(y & 3)];
    const F8x3 facet = SampleFacet(out, alpha, disk.radius, disk.cos_phi, disk.sin_phi);
    const F8 across = Dot(out, facet);
    const F8x3 in = {2 * across * facet.x - out.x, 2 * across * facet.y - out.y,
                     2 * across * facet.z - out.z};
    // Broad lobes are asked in every second row of the pattern, and counted twice.
    const I8 broad = roughness > kBroad;
    const I8 up = glossy & (in.z > 0) & (y % 2 ? ~broad : WideInt(-1));
    const F8 weight =
        Fresnel(f0, across) * SmithMasking(in.z, alpha) * Select(broad, Wide(2), Wide(1));
    const F8 t = Select(glossy, LoadF(&image_.t[i]), Wide(0));
    const F8x3 from = {view_.origin.x() + t * d.x + kLift * basis.z.x,
                       view_.origin.y() + t * d.y + kLift * basis.z.y,
                       view_.origin.z() + t * d.z + kLift * basis.z.z};
    F8 seen = Seen(from, basis.ToWorld(in), up);
    const F8 most = LoadF(irradiance + i) * (kBrightest * std::numbers::inv_pi_v<float>);
    seen = Select(broad, Min(seen, most), seen);
    Store(Select(up, weight * seen, Wide(0)), raw + i);
    const F8 base = 1 - GlossShare(f0, roughness, out.z);
    Store(Select(glossy, LoadF(reflectance + i) * base, LoadF(reflectance + i)), reflectance + i);
  }

 private:
  /// On the eye's side.
  F8x3 Normal(I8 triangle, const F8x3& to_eye) const {
    const I8 offset = triangle * static_cast<int>(sizeof(SurfaceRecord) / sizeof(float));
    const float* base = tables_.statics().data()->normal;
    F8x3 n = {Gather(base, offset), Gather(base, offset + 1), Gather(base, offset + 2)};
    const F8 side = Select(Dot(n, to_eye) < 0, Wide(-1), Wide(1));
    return {n.x * side, n.y * side, n.z * side};
  }

  F8 Seen(const F8x3& from, const F8x3& to, I8 valid) const {
    if (!Any(valid)) return Wide(0);
    Hits8 hits;
    instant_.Intersect(MakeRays(from, to, Wide(kInfinity), valid), Coherence::kIncoherent,
                       kEverything, &hits);
    const SurfaceLanes seen =
        LookUpHits(tables_, frame_, textures_, LoadI(hits.geometry), LoadI(hits.primitive),
                   {LoadF(hits.t), LoadF(hits.u), LoadF(hits.v), to.x, to.y, to.z, I8{}}, step_);
    return seen.reflectance * seen.irradiance * std::numbers::inv_pi_v<float>;
  }

  const Instant& instant_;
  const EyeView& view_;
  const HitImage& image_;
  const SurfaceTables& tables_;
  const FrameLight& frame_;
  const TexturePool& textures_;
  RayStep step_;
  DiskPattern pattern_;
};

}  // namespace

bool TraceGloss(const Instant& instant, const EyeView& view, const HitImage& image,
                const SurfaceTables& tables, const FrameLight& frame, const TexturePool& textures,
                std::span<const float> irradiance, std::vector<float>* reflectance,
                std::vector<float>* mirrored) {
  if (tables.finishes().empty()) return false;
  const Pass pass(instant, view, image, tables, frame, textures);
  const int columns = (image.width + kTileWidth - 1) / kTileWidth;
  const int rows = (image.height + kTileHeight - 1) / kTileHeight;
  std::vector<std::uint8_t> glossy(static_cast<std::size_t>(columns * rows));
  std::vector<float> raw(image.t.size());
  const auto for_packets = [&](int tile, const auto& work) {
    const int x0 = tile % columns * kTileWidth, y0 = tile / columns * kTileHeight;
    for (int y = y0; y < std::min(y0 + kTileHeight, image.height); ++y) {
      for (int x = x0; x < std::min(x0 + kTileWidth, image.width); x += kLanes) work(x, y);
    }
  };
  tbb::parallel_for(0, columns * rows, [&](int tile) {
    for_packets(tile, [&](int x, int y) {
      const I8 lanes = pass.Glossy(x, y);
      if (!Any(lanes)) return;
      glossy[static_cast<std::size_t>(tile)] = 1;
      pass.Trace(x, y, lanes, irradiance.data(), reflectance->data(), raw.data());
    });
  });
  if (std::ranges::find(glossy, 1) == glossy.end()) return false;
  mirrored->assign(image.t.size(), 0);
  const PatternFilter filter(image, tables.statics(), raw);
  tbb::parallel_for(0, columns * rows, [&](int tile) {
    if (!glossy[static_cast<std::size_t>(tile)]) return;
    for_packets(tile, [&](int x, int y) {
      if (Any(pass.Glossy(x, y))) filter.Packet(x, y, mirrored);
    });
  });
  return true;
}

}  // namespace aisle::sim
