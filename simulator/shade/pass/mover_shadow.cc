#include "simulator/shade/pass/mover_shadow.h"

#include <array>
#include <cstddef>
#include <optional>

#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/lanes/ray_packets.h"
#include "simulator/shade/pass/mover_blockers.h"
#include "simulator/shade/pass/other_camera.h"
#include "simulator/shade/pass/pattern_filter.h"
#include "simulator/trace/tile_grid.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 16, kTileHeight = 8;
constexpr float kLift = 2e-3f;            // m, along the normal
constexpr float kReach = 1.2f;            // m: how far a mover darkens indirect light
constexpr float kMoverReflection = 0.3f;  // what blocking parts of a mover send on in turn

constexpr int kAmbientRays = 2;  // a pixel
// Lights that together give less than this share of a tile's light are let through.
constexpr float kUntracedShare = 0.02f;
// A light that gives less than such a share of a tile's light is asked in every second, every
// fourth row of the pattern only.
constexpr float kHalfShare = 0.2f, kQuarterShare = 0.08f;

const F8 kAlmostThere = Wide(0.998f);  // of the way to a light

F8x3 Wide3(const Eigen::Vector3f& v) { return {Wide(v.x()), Wide(v.y()), Wide(v.z())}; }

/// Sample positions of the 4 × 4 pattern for eight pixels of a row: neighbours differ much, and
/// each 4 × 4 block has all sixteen.
struct Pattern {
  struct Row {
    F8 a, b;                                       ///< on a light, in [-1, 1]
    std::array<F8x3, kAmbientRays> local_ambient;  ///< cosine-distributed, z = normal
  };
  std::array<Row, 4> rows;

  Pattern() {
    const std::vector<Eigen::Vector3f> ambient = CosineDirections(kPatternSize * kAmbientRays);
    for (std::size_t y = 0; y < 4; ++y) {
      for (int k = 0; k < kLanes; ++k) {
        const int index = PatternIndex(k, static_cast<int>(y));
        const Eigen::Vector2f s = SpreadPoint(index);
        rows[y].a[k] = 2 * s.x() - 1;
        rows[y].b[k] = 2 * s.y() - 1;
        for (std::size_t ray = 0; ray < kAmbientRays; ++ray) {
          const Eigen::Vector3f& d = ambient[static_cast<std::size_t>(index) + ray * kPatternSize];
          rows[y].local_ambient[ray].x[k] = d.x();
          rows[y].local_ambient[ray].y[k] = d.y();
          rows[y].local_ambient[ray].z[k] = d.z();
        }
      }
    }
  }
};

/// Eight pixels of a row: where their static surfaces are and which way these face.
struct Pixels8 {
  F8x3 position, normal;
  I8 active;  ///< lanes that show the static world
};

/// One light and the movers that may stand between it and a tile.
struct Blocker {
  std::size_t light;
  GeometryMask movers;
  float most;            ///< irradiance that it can give any point of the tile
  std::size_t row_step;  ///< traced in every row_step-th row of the pattern, and counted as often
};

struct TileWork {
  std::vector<Blocker> blockers;
  GeometryMask near = 0;  ///< movers that may darken indirect light
  bool empty() const { return blockers.empty() && near == 0; }
};

class Pass {
 public:
  Pass(const Instant& instant, const CameraView& view, const HitImage& image, const World& world,
       const SurfaceTables& tables, const FrameLight& frame, std::span<const float> irradiance,
       const SeenShadows* seen)
      : instant_(instant),
        view_(view),
        image_(image),
        world_(world),
        tables_(tables),
        frame_(frame),
        irradiance_(irradiance) {
    if (seen) {
      other_.emplace(seen->view, seen->image);
      other_raw_ = seen->raw;
    }
  }

  /// Unfiltered share per pixel of one tile; whether any pixel lost light.
  bool TraceTile(const Tile& tile, std::vector<float>* raw) const {
    bool lost = false;
    std::array<I8, kTileWidth * kTileHeight / kLanes> open;
    std::size_t packet = 0;
    bool any_open = false;
    ForRows(tile, kLanes, [&](int x, int y) {
      open[packet] = TakeSeen(x, y, raw, &lost);
      any_open |= Any(open[packet++]);
    });
    if (!any_open) return lost;
    const TileWork work = Plan(tile);
    if (work.empty()) return lost;
    packet = 0;
    ForRows(tile, kLanes, [&](int x, int y) {
      const I8 lanes = open[packet++];
      if (Any(lanes)) lost |= TracePacket(x, y, lanes, work, raw);
    });
    return lost;
  }

 private:
  F8x3 PositionsOf(int x, int y, I8 active) const {
    const std::size_t i = image_.Index(x, y);
    const auto ray = static_cast<std::size_t>(y * view_.rays->width + x);
    const F8 cx = LoadF(&view_.rays->x[ray]), cy = LoadF(&view_.rays->y[ray]);
    const F8 t = Select(active, LoadF(&image_.t[i]), Wide(0));
    const Eigen::Matrix3f& r = view_.rotation;
    const Eigen::Vector3f& o = view_.origin;
    return {o.x() + t * (r(0, 0) * cx + r(0, 1) * cy + r(0, 2)),
            o.y() + t * (r(1, 0) * cx + r(1, 1) * cy + r(1, 2)),
            o.z() + t * (r(2, 0) * cx + r(2, 1) * cy + r(2, 2))};
  }

  I8 StaticLanes(int x, int y) const { return LoadI(&image_.geometry[image_.Index(x, y)]) == 0; }

  /// Takes over what the other camera found for the points that both see; what lanes are left.
  I8 TakeSeen(int x, int y, std::vector<float>* raw, bool* lost) const {
    const I8 active = StaticLanes(x, y);
    if (!other_ || !Any(active)) return active;
    const std::size_t i = image_.Index(x, y);
    I8 pixels{};
    const I8 found =
        other_->Find(PositionsOf(x, y, active), LoadI(&image_.primitive[i]), active, &pixels);
    if (!Any(found)) return active;
    const F8 kept = Select(found, Gather(other_raw_.data(), pixels), Wide(1));
    *lost |= Any(kept < 1);
    Store(kept, &(*raw)[i]);
    return active & ~found;
  }

  Pixels8 Locate(int x, int y, I8 lanes) const {
    Pixels8 p;
    p.active = lanes;
    const I8 record = p.active ? LoadI(&image_.primitive[image_.Index(x, y)]) : I8{};
    const I8 offset = record * static_cast<int>(sizeof(SurfaceRecord) / sizeof(float));
    const auto* base = tables_.statics().data()->normal;
    p.normal = {Gather(base, offset), Gather(base, offset + 1), Gather(base, offset + 2)};
    p.position = PositionsOf(x, y, p.active);
    p.position.x += kLift * p.normal.x;
    p.position.y += kLift * p.normal.y;
    p.position.z += kLift * p.normal.z;
    return p;
  }

  Eigen::AlignedBox3f BoxOf(const Tile& tile) const {
    const F8 infinity = Wide(kInfinity);
    F8x3 lo = {infinity, infinity, infinity}, hi = {-infinity, -infinity, -infinity};
    ForRows(tile, kLanes, [&](int x, int y) {
      const I8 active = StaticLanes(x, y);
      const F8x3 p = PositionsOf(x, y, active);
      const auto extend = [&](F8 value, F8* low, F8* high) {
        *low = Min(*low, Select(active, value, infinity));
        *high = Max(*high, Select(active, value, -infinity));
      };
      extend(p.x, &lo.x, &hi.x);
      extend(p.y, &lo.y, &hi.y);
      extend(p.z, &lo.z, &hi.z);
    });
    Eigen::AlignedBox3f box;
    for (int k = 0; k < kLanes; ++k) {
      if (lo.x[k] > hi.x[k]) continue;
      box.extend(Eigen::Vector3f(lo.x[k], lo.y[k], lo.z[k]));
      box.extend(Eigen::Vector3f(hi.x[k], hi.y[k], hi.z[k]));
    }
    return box;
  }

  /// Which lights and movers can matter for a tile.
  TileWork Plan(const Tile& tile) const {
    TileWork work;
    const Eigen::AlignedBox3f box = BoxOf(tile);
    if (box.isEmpty()) return work;
    const auto& movers = instant_.mover_boxes();
    for (std::size_t m = 0; m < movers.size(); ++m) {
      if (Grown(movers[m], Eigen::Vector3f::Constant(kReach)).intersects(box)) {
        work.near |= MoverBit(m);
      }
    }
    for (std::size_t l = 0; l < world_.lights().size(); ++l) {
      const AreaLight& light = world_.lights()[l];
      if (instant_.snapshot().light_scale[l] <= 0) continue;
      const GeometryMask mask =
          MoversBetween(instant_, box, light.center, light.half_u, light.half_v);
      if (mask) work.blockers.push_back({l, mask, MostLight(light, l, box), 1});
    }
    Thin(MeanLight(tile), &work.blockers);
    return work;
  }

  /// Bound of what a light can give to any point of a box, whichever way it faces.
  float MostLight(const AreaLight& light, std::size_t index, const Eigen::AlignedBox3f& box) const {
    const float power = 4 * light.half_u.cross(light.half_v).norm() * light.radiance *
                        instant_.snapshot().light_scale[index];
    const Eigen::Vector3f normal = light.half_u.cross(light.half_v).normalized();
    float below = 0;  // how far the box reaches to the side the light shines to
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3f p = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner));
      below = std::max(below, (p - light.center).dot(normal));
    }
    const float squared = std::max(box.squaredExteriorDistance(light.center), 0.01f);
    return power * std::min(1.0f, below / std::sqrt(squared)) / squared;
  }

  float MeanLight(const Tile& tile) const {
    float sum = 0, count = 0;
    for (int y = tile.y0; y < tile.y1; y += 2) {
      for (int x = tile.x0; x < tile.x1; x += 2) {
        const std::size_t i = image_.Index(x, y);
        if (image_.geometry[i] != 0) continue;
        sum += irradiance_[i];
        count += 1;
      }
    }
    return count > 0 ? sum / count : 0;
  }

  /// Drops the lights that hardly count, and thins the rays to the weak ones.
  static void Thin(float mean, std::vector<Blocker>* blockers) {
    std::ranges::sort(*blockers, [](const Blocker& a, const Blocker& b) {
      return a.most != b.most ? a.most < b.most : a.light < b.light;
    });
    float dropped = 0;
    std::erase_if(*blockers, [&](const Blocker& blocker) {
      dropped += blocker.most;
      return dropped < kUntracedShare * mean;
    });
    for (Blocker& blocker : *blockers) {
      blocker.row_step = blocker.most < kQuarterShare * mean ? 4
                         : blocker.most < kHalfShare * mean  ? 2
                                                             : 1;
    }
  }

  /// Lanes whose segment meets the box of any of the movers.
  I8 MayMeet(GeometryMask movers, const F8x3& from, const F8x3& to) const {
    I8 may{};
    for (std::size_t m = 0; m < instant_.mover_boxes().size(); ++m) {
      if (movers & MoverBit(m)) may |= MeetBox(instant_.mover_boxes()[m], from, to);
    }
    return may;
  }

  bool TracePacket(int x, int y, I8 lanes, const TileWork& work, std::vector<float>* raw) const {
    const Pixels8 pixels = Locate(x, y, lanes);
    const Pattern::Row& pattern = pattern_.rows[static_cast<std::size_t>(y & 3)];
    F8 lost = Wide(0);
    for (const Blocker& blocker : work.blockers) {
      // Which rows differs from light to light, so that the work of the rows is alike.
      if ((static_cast<std::size_t>(y) + blocker.light) % blocker.row_step != 0) continue;
      lost += LostDirect(blocker, pixels, pattern) * static_cast<float>(blocker.row_step);
    }
    if (work.near) lost += LostIndirect(work.near, pixels, pattern, x, y);
    if (!Any(lost > 0)) return false;
    const std::size_t i = image_.Index(x, y);
    const F8 kept = 1 - lost / Max(LoadF(&irradiance_[i]), Wide(1e-9f));
    Store(Select(lanes & ~OnLuminaires(i, lanes), kept, LoadF(&(*raw)[i])), &(*raw)[i]);
    return true;
  }

  /// Nothing darkens a luminaire, whose own radiance outshines what it reflects by far.
  I8 OnLuminaires(std::size_t pixel, I8 lanes) const {
    constexpr int kStride = sizeof(SurfaceRecord) / sizeof(float);
    const I8 record = lanes ? LoadI(&image_.primitive[pixel]) : I8{};
    return Gather(&tables_.statics()[0].f0, record * kStride) < 0;
  }

  /// Irradiance that movers keep from one light, by one shadow ray a pixel.
  F8 LostDirect(const Blocker& blocker, const Pixels8& pixels, const Pattern::Row& at) const {
    const AreaLight& light = world_.lights()[blocker.light];
    const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
    const F8x3 on_light = {light.center.x() + at.a * light.half_u.x() + at.b * light.half_v.x(),
                           light.center.y() + at.a * light.half_u.y() + at.b * light.half_v.y(),
                           light.center.z() + at.a * light.half_u.z() + at.b * light.half_v.z()};
    const F8x3 to = Minus(on_light, pixels.position);
    const F8 here = Dot(to, pixels.normal), there = -Dot(to, Wide3(cross));
    const I8 valid = pixels.active & (here > 0) & (there > 0);
    if (!Any(valid)) return Wide(0);
    const unsigned blocked =
        BlockedByMovers(instant_, blocker.movers, pixels.position, to, kAlmostThere, valid);
    if (!blocked) return Wide(0);
    // What the static world keeps away anyway is not the mover's to take.
    const unsigned dark =
        instant_.Occluded(MakeRays(pixels.position, to, kAlmostThere, LanesOf(blocked)),
                          Coherence::kCoherent, kStaticOnly);
    const F8 squared = Dot(to, to);
    const float power = 4 * light.radiance * instant_.snapshot().light_scale[blocker.light];
    return Select(LanesOf(blocked & ~dark), power * here * there / (squared * squared), Wide(0));
  }

  /// Indirect irradiance that movers keep away, by a few short rays a pixel.
  F8 LostIndirect(GeometryMask movers, const Pixels8& pixels, const Pattern::Row& at, int x,
                  int y) const {
    const F8x3& n = pixels.normal;
    // Duff et al. 2017, as BasisAround.
    const F8 sign = Select(n.z < 0, Wide(-1), Wide(1));
    const F8 a = -1 / (sign + n.z), b = n.x * n.y * a;
    F8 blocked = Wide(0);
    for (const F8x3& d : at.local_ambient) {
      const F8x3 to = {kReach * (d.x * (1 + sign * n.x * n.x * a) + d.y * b + d.z * n.x),
                       kReach * (d.x * sign * b + d.y * (sign + n.y * n.y * a) + d.z * n.y),
                       kReach * (-d.x * sign * n.x - d.y * n.y + d.z * n.z)};
      const I8 valid = pixels.active & MayMeet(movers, pixels.position, to);
      if (!Any(valid)) continue;
      const unsigned hit = instant_.Occluded(MakeRays(pixels.position, to, Wide(1), valid),
                                             Coherence::kIncoherent, movers);
      blocked += Select(LanesOf(hit), Wide(1), Wide(0));
    }
    if (!Any(blocked > 0)) return Wide(0);
    F8 lost = Wide(0);
    for (int k = 0; k < kLanes; ++k) {
      if (blocked[k] == 0) continue;
      const std::size_t i = image_.Index(x + k, y);
      const LightPatch& patch = tables_.statics()[image_.primitive[i]].light;
      const float direct = ReadLight(patch, frame_.statics->direct, image_.u[i], image_.v[i]);
      lost[k] = std::max(0.0f, irradiance_[i] - direct);
    }
    return lost * blocked * ((1 - kMoverReflection) / kAmbientRays);
  }

  const Instant& instant_;
  const CameraView& view_;
  const HitImage& image_;
  const World& world_;
  const SurfaceTables& tables_;
  const FrameLight& frame_;
  std::span<const float> irradiance_;
  std::optional<OtherCamera> other_;
  std::span<const float> other_raw_;
  Pattern pattern_;
};

}  // namespace

void TraceMoverShadows(const Instant& instant, const CameraView& view, const HitImage& image,
                       const World& world, const SurfaceTables& tables, const FrameLight& frame,
                       std::span<const float> irradiance, const SeenShadows* seen,
                       std::vector<float>* raw, std::vector<float>* kept) {
  kept->assign(irradiance.size(), 1);
  raw->assign(irradiance.size(), 1);
  if (instant.snapshot().movers.empty() || tables.statics().empty()) return;
  const Pass pass(instant, view, image, world, tables, frame, irradiance, seen);
  const TileGrid grid{image.width, image.height, kTileWidth, kTileHeight};
  std::vector<std::uint8_t> lost(grid.size());
  grid.ForEach([&](std::size_t i, const Tile& tile) { lost[i] = pass.TraceTile(tile, raw); });
  const PatternFilter filter(image, tables.statics(), *raw);
  const int columns = grid.columns(), rows = grid.rows();
  const auto is_lost = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < columns && row < rows &&
           lost[static_cast<std::size_t>(row * columns + column)];
  };
  grid.ForEach([&](std::size_t i, const Tile& tile) {
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    bool near = false;
    for (int d = 0; d < 9; ++d) near |= is_lost(column + d % 3 - 1, row + d / 3 - 1);
    if (!near) return;
    ForRows(tile, kLanes, [&](int x, int y) {
      const I8 is_static = LoadI(&image.geometry[image.Index(x, y)]) == 0;
      if (Any(is_static)) filter.Packet(x, y, is_static, kept);
    });
  });
}

}  // namespace aisle::sim
