#include "simulator/shade/pass/gloss_pass.h"

#include <numbers>

#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/lanes/ray_packets.h"
#include "simulator/shade/pass/lobe_lamps.h"
#include "simulator/shade/pass/mover_blockers.h"
#include "simulator/shade/pass/pattern_filter.h"
#include "simulator/shade/surface/gloss.h"
#include "simulator/trace/tile_grid.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 16, kTileHeight = 8;
constexpr float kLift = 2e-3f;      // m, along the normal
constexpr float kFootprint = 3.0f;  // pixels: how wide mirrored textures are averaged
// Sixteen rays cannot find a lamp evenly in a broad lobe: beyond this roughness lamps are aimed at.
constexpr float kBroad = 0.2f;
constexpr float kGrazing = 0.02f;  // cosines below this are raised to it

/// Samples for eight pixels of each row of the pattern.
struct LobePattern {
  struct Row {
    F8 radius, cos_phi, sin_phi;  ///< of the unit disk
    LampChoice8 lamp;
  };
  std::array<Row, 4> rows;

  LobePattern() {
    for (int y = 0; y < 4; ++y) {
      Row& row = rows[static_cast<std::size_t>(y)];
      for (int k = 0; k < kLanes; ++k) {
        const int index = PatternIndex(k, y);
        const Eigen::Vector2f s = SpreadPoint(index);
        const float phi = 2 * std::numbers::pi_v<float> * s.y();
        row.radius[k] = std::sqrt(s.x());
        row.cos_phi[k] = std::cos(phi);
        row.sin_phi[k] = std::sin(phi);
        // The R3 sequence (Roberts 2018), as SpreadPoint is R2.
        const Eigen::Array3f place =
            0.5f + (static_cast<float>(index) + 1) *
                       Eigen::Array3f(0.8191725134f, 0.6710436067f, 0.5497004779f);
        const Eigen::Array3f fraction = place - place.floor();
        row.lamp.which[k] = fraction.x();
        row.lamp.a[k] = fraction.y();
        row.lamp.b[k] = fraction.z();
      }
    }
  }
};

/// Eight pixels of a row, and what of them is glossy.
struct Glossy8 {
  I8 lanes;
  I8 geometry, primitive;
  F8 f0, roughness;
};

class Pass {
 public:
  explicit Pass(const ShadingView& shading)
      : shading_(shading),
        solid_(SolidOf(shading.instant)),
        lamps_(shading.instant, shading.world().lights()) {}

  Glossy8 Find(int x, int y) const {
    const std::size_t i = shading_.image.Index(x, y);
    Glossy8 found{.lanes = {},
                  .geometry = LoadI(&shading_.image.geometry[i]),
                  .primitive = LoadI(&shading_.image.primitive[i]),
                  .f0 = Wide(0),
                  .roughness = Wide(1)};
    const auto read = [&](I8 lanes, I8 record, const std::vector<SurfaceRecord>& records) {
      if (!Any(lanes)) return;
      constexpr int kStride = sizeof(SurfaceRecord) / sizeof(float);
      const I8 offset = (lanes ? record : I8{}) * kStride;
      found.f0 = Select(lanes, Gather(&records[0].f0, offset), found.f0);
      found.roughness = Select(lanes, Gather(&records[0].roughness, offset), found.roughness);
    };
    read(found.geometry == 0, found.primitive, shading_.tables.statics());
    const I8 is_mover = found.geometry > 0;  // "nothing" is -1
    if (Any(is_mover)) {
      const I8 base =
          GatherInt(shading_.tables.mover_bases().data(), is_mover ? found.geometry - 1 : I8{});
      read(is_mover, found.primitive + base, shading_.tables.mover_records());
    }
    found.lanes = found.f0 > 0;
    return found;
  }

  Reflection8 Trace(int x, int y, const Glossy8& glossy) const {
    const std::size_t i = shading_.image.Index(x, y);
    const Eigen::Matrix3f& r = shading_.view.rotation;
    const auto pixel = static_cast<std::size_t>(y * shading_.view.rays->width + x);
    const F8 cx = LoadF(&shading_.view.rays->x[pixel]), cy = LoadF(&shading_.view.rays->y[pixel]);
    const F8x3 d = {r(0, 0) * cx + r(0, 1) * cy + r(0, 2), r(1, 0) * cx + r(1, 1) * cy + r(1, 2),
                    r(2, 0) * cx + r(2, 1) * cy + r(2, 2)};
    const F8 inverse = -1 / Sqrt(Dot(d, d));
    const F8x3 to_camera = {d.x * inverse, d.y * inverse, d.z * inverse};
    const Frame8 basis(Normal(glossy, i, to_camera));
    F8x3 out = basis.ToLocal(to_camera);
    out.z = Max(out.z, Wide(kGrazing));
    const F8 t = Select(glossy.lanes, LoadF(&shading_.image.t[i]), Wide(0));
    const LobePoints8 points{.position = {shading_.view.origin.x() + t * d.x + kLift * basis.z.x,
                                          shading_.view.origin.y() + t * d.y + kLift * basis.z.y,
                                          shading_.view.origin.z() + t * d.z + kLift * basis.z.z},
                             .basis = basis,
                             .out = out,
                             .f0 = glossy.f0,
                             .roughness = glossy.roughness};
    const LobePattern::Row& row = pattern_.rows[static_cast<std::size_t>(y & 3)];
    const I8 broad = glossy.lanes & (glossy.roughness > kBroad);
    Reflection8 reflection{.x = x, .y = y, .lanes = glossy.lanes};
    // Without its lamps a broad lobe sees little that is bright: it is asked in every second row of
    // the pattern, and counted twice.
    const I8 asked = glossy.lanes & (y % 2 ? ~broad : WideInt(-1));
    SendRay(points, row, broad, asked, &reflection);
    reflection.weight *= Select(broad, Wide(2), Wide(1));
    if (Any(broad)) {
      reflection.lamps = lamps_.Mirrored(points, row.lamp, broad);
    }
    reflection.base = 1 - GlossShare(glossy.f0, glossy.roughness, out.z);
    return reflection;
  }

 private:
  /// To what a facet of the lobe mirrors; lamps do not count for broad lobes.
  void SendRay(const LobePoints8& points, const LobePattern::Row& row, I8 broad, I8 asked,
               Reflection8* reflection) const {
    StoreI(WideInt(-1), reflection->hits.geometry);
    const F8x3 facet = SampleFacet(points.out, points.roughness * points.roughness, row.radius,
                                   row.cos_phi, row.sin_phi);
    const F8 across = Dot(points.out, facet);
    const F8x3 in = {2 * across * facet.x - points.out.x, 2 * across * facet.y - points.out.y,
                     2 * across * facet.z - points.out.z};
    const I8 up = asked & (in.z > 0);
    if (!Any(up)) return;
    reflection->to = points.basis.ToWorld(in);
    const Segments8 ways{points.position, reflection->to, Wide(kInfinity), up};
    shading_.instant.Intersect(MakeRays(ways.from, ways.to, ways.t_far, ways.valid),
                               Coherence::kIncoherent, MayMeet(shading_.instant, solid_, ways),
                               &reflection->hits);
    const F8 alpha = points.roughness * points.roughness;
    const F8 weight = Fresnel(points.f0, across) * SmithMasking(in.z, alpha);
    reflection->weight = Select(up & ~(broad & OnLamps(reflection->hits)), weight, Wide(0));
  }

  I8 OnLamps(const Hits8& hits) const {
    I8 lamps{};
    for (int k = 0; k < kLanes; ++k) {
      if (hits.geometry[k] == 0 && shading_.tables.statics()[hits.primitive[k]].f0 < 0)
        lamps[k] = -1;
    }
    return lamps;
  }

  /// The surfaces' normals, on the camera's side.
  F8x3 Normal(const Glossy8& glossy, std::size_t pixel, const F8x3& to_camera) const {
    F8x3 n = {Wide(0), Wide(0), Wide(1)};
    for (int k = 0; k < kLanes; ++k) {
      if (!glossy.lanes[k]) continue;
      const std::size_t i = pixel + static_cast<std::size_t>(k);
      const MeshPlace place = shading_.tables.PlaceOf(shading_.instant, shading_.image, i);
      const Material& material =
          shading_.tables.world().materials()[place.topology.materials[place.triangle]];
      const Eigen::Vector3f normal = MappedNormal(place, material, shading_.textures,
                                                  shading_.image.t[i] * shading_.view.rays->step_x);
      n.x[k] = normal.x();
      n.y[k] = normal.y();
      n.z[k] = normal.z();
    }
    const F8 side = Select(Dot(n, to_camera) < 0, Wide(-1), Wide(1));
    return {n.x * side, n.y * side, n.z * side};
  }

  const ShadingView& shading_;
  GeometryMask solid_;
  LobeLamps lamps_;
  LobePattern pattern_;
};

}  // namespace

void TraceGloss(const ShadingView& shading, Reflections* reflections) {
  const HitImage& image = shading.image;
  if (!shading.tables.glossy()) return reflections->clear();
  const Pass pass(shading);
  const TileGrid grid{image.width, image.height, kTileWidth, kTileHeight};
  reflections->resize(grid.size());
  grid.ForEach([&](std::size_t i, const Tile& tile) {
    std::vector<Reflection8>& of_tile = (*reflections)[i];
    of_tile.clear();
    ForRows(tile, kLanes, [&](int x, int y) {
      const Glossy8 found = pass.Find(x, y);
      if (!Any(found.lanes)) return;
      if (of_tile.empty()) of_tile.reserve(kTileWidth * kTileHeight / kLanes);
      of_tile.push_back(pass.Trace(x, y, found));
    });
  });
}

void AddMirroredMovers(const Reflections& tiles, std::vector<Hits8>* beyond) {
  for (const std::vector<Reflection8>& tile : tiles) {
    for (const Reflection8& reflection : tile) {
      if (Any(LoadI(reflection.hits.geometry) > 0)) beyond->push_back(reflection.hits);
    }
  }
}

bool ShadeGloss(const ShadingView& shading, const Reflections& tiles,
                std::vector<float>* reflectance, std::vector<float>* raw,
                std::vector<float>* mirrored) {
  const auto is_glossy = [](const std::vector<Reflection8>& tile) { return !tile.empty(); };
  if (std::ranges::none_of(tiles, is_glossy)) return false;
  const CameraView& view = shading.view;
  const RayStep step{view.rotation.col(0) * view.rays->step_x * kFootprint,
                     view.rotation.col(1) * view.rays->step_y * kFootprint};
  const HitImage& image = shading.image;
  raw->assign(image.t.size(), 0);
  ParallelFor(std::size_t{0}, tiles.size(), [&](std::size_t tile) {
    for (const Reflection8& reflection : tiles[tile]) {
      const std::size_t i = image.Index(reflection.x, reflection.y);
      const F8 seen = RadianceOfHits(shading.tables, shading.frame, shading.textures, reflection.to,
                                     reflection.hits, step);
      const F8 light = Select(reflection.weight > 0, reflection.weight * seen, Wide(0));
      Store(Select(reflection.lanes, light + reflection.lamps, Wide(0)), &(*raw)[i]);
      const F8 old = LoadF(&(*reflectance)[i]);
      Store(Select(reflection.lanes, old * reflection.base, old), &(*reflectance)[i]);
    }
  });
  mirrored->assign(image.t.size(), 0);
  const PatternFilter filter(image, shading.tables.statics(), *raw);
  ParallelFor(std::size_t{0}, tiles.size(), [&](std::size_t tile) {
    for (const Reflection8& reflection : tiles[tile]) {
      filter.Packet(reflection.x, reflection.y, reflection.lanes, mirrored);
    }
  });
  return true;
}

}  // namespace aisle::sim
