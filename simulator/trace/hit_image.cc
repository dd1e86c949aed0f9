#include "simulator/trace/hit_image.h"

#include <immintrin.h>

#include <array>
#include <cstring>

#include "simulator/common/parallel.h"
#include "simulator/trace/tile_grid.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 32, kTileHeight = 16;    // pixels
constexpr int kPacketWidth = 4, kPacketHeight = 2;  // pixels

struct TileOfView {
  std::size_t view;
  Tile tile;
};

std::vector<TileOfView> MakeTiles(std::span<const CameraView> views, std::uint64_t shuffle) {
  std::vector<TileOfView> tiles;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const TileGrid grid{views[i].rays->width, views[i].rays->height, kTileWidth, kTileHeight};
    for (std::size_t k = 0; k < grid.size(); ++k) tiles.push_back({i, grid.At(k)});
  }
  for (std::size_t i = tiles.size(); shuffle != 0 && i > 1; --i) {
    shuffle = shuffle * 6364136223846793005u + 1442695040888963407u;
    std::swap(tiles[i - 1], tiles[(shuffle >> 33) % i]);
  }
  return tiles;
}

void Store(const Hits8& hits, int x, int y, HitImage* image) {
  for (int row = 0; row < kPacketHeight && y + row < image->height; ++row) {
    const std::size_t to = image->Index(x, y + row);
    const auto from = static_cast<std::size_t>(row * kPacketWidth);
    const auto copy = [&](const auto* source, auto* target) {
      std::memcpy(target + to, source + from, kPacketWidth * sizeof(*source));
    };
    copy(hits.t, image->t.data());
    copy(hits.geometry, image->geometry.data());
    copy(hits.primitive, image->primitive.data());
    copy(hits.u, image->u.data());
    copy(hits.v, image->v.data());
  }
}

/// Neighbours that may meet the same movers are asked together.
void TraceTile(const Instant& instant, const CameraView& view, const Tile& tile, std::size_t most,
               HitImage* image) {
  std::array<Rays8, Instant::kMostPackets> rays;
  std::array<Hits8, Instant::kMostPackets> hits;
  for (int y = tile.y0; y < tile.y1; y += kPacketHeight) {
    GeometryMask asked = 0;
    std::size_t count = 0;
    int first = tile.x0;
    const auto trace = [&] {
      instant.Intersect(std::span(rays).first(count), Coherence::kCoherent, asked, hits);
      for (std::size_t i = 0; i < count; ++i, first += kPacketWidth)
        Store(hits[i], first, y, image);
      count = 0;
    };
    for (int x = tile.x0; x < tile.x1; x += kPacketWidth) {
      const GeometryMask may = image->movers.In(x, y, x + kPacketWidth, y + kPacketHeight);
      if (count == most || (count > 0 && may != asked)) trace();
      asked = may;
      rays[count++] = PixelPacket(view, x, y);
    }
    trace();
  }
}

/// A row of four floats, and another below.
__m256 TwoRows(const float* upper, const float* lower) {
  return _mm256_set_m128(_mm_loadu_ps(lower), _mm_loadu_ps(upper));
}

}  // namespace

CameraView::CameraView(const PixelRays& pixel_rays, const Eigen::Isometry3d& pose)
    : rays(&pixel_rays),
      T_world_camera(pose),
      rotation(pose.linear().cast<float>()),
      origin(pose.translation().cast<float>()) {}

void HitImage::Resize(int new_width, int new_height) {
  if (width == new_width && height == new_height) return;
  width = new_width;
  height = new_height;
  stride = (width + kLanes - 1) / kLanes * kLanes;
  const auto count = static_cast<std::size_t>(stride) * static_cast<std::size_t>(height);
  t.assign(count, kInfinity);
  geometry.assign(count, kNoGeometry);
  primitive.assign(count, 0);
  u.assign(count, 0);
  v.assign(count, 0);
}

Rays8 PixelPacket(const CameraView& view, int x, int y) {
  const PixelRays& rays = *view.rays;
  const Eigen::Matrix3f& r = view.rotation;
  const bool has_lower = y + 1 < rays.height;
  const auto upper = static_cast<std::size_t>(y * rays.width + x);
  const std::size_t lower = has_lower ? upper + static_cast<std::size_t>(rays.width) : upper;
  // A packet that reaches beyond its row reads into the next one, or into the padding.
  const __m256 cx = TwoRows(&rays.x[upper], &rays.x[lower]);
  const __m256 cy = TwoRows(&rays.y[upper], &rays.y[lower]);
  Rays8 packet;
  const auto fill = [](float value, float* row) { _mm256_store_ps(row, _mm256_set1_ps(value)); };
  fill(view.origin.x(), packet.ox);
  fill(view.origin.y(), packet.oy);
  fill(view.origin.z(), packet.oz);
  _mm256_store_ps(packet.dx, r(0, 0) * cx + r(0, 1) * cy + r(0, 2));
  _mm256_store_ps(packet.dy, r(1, 0) * cx + r(1, 1) * cy + r(1, 2));
  _mm256_store_ps(packet.dz, r(2, 0) * cx + r(2, 1) * cy + r(2, 2));
  fill(0, packet.t_near);
  fill(kInfinity, packet.t_far);
  const __m256i column = _mm256_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3);
  const int rows = has_lower ? -1 : 0;
  const __m256i in_rows = _mm256_setr_epi32(-1, -1, -1, -1, rows, rows, rows, rows);
  const __m256i in_columns = _mm256_cmpgt_epi32(_mm256_set1_epi32(rays.width - x), column);
  _mm256_store_si256(reinterpret_cast<__m256i*>(packet.valid),
                     _mm256_and_si256(in_rows, in_columns));
  return packet;
}

void TraceViews(const Instant& instant, std::span<const CameraView> views, const TraceOrder& order,
                std::vector<HitImage>* images) {
  images->resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    (*images)[i].Resize(views[i].rays->width, views[i].rays->height);
    (*images)[i].movers = MoverWindows(instant, views[i]);
  }
  const std::vector<TileOfView> tiles = MakeTiles(views, order.shuffle);
  ParallelFor(std::size_t{0}, tiles.size(), [&](std::size_t i) {
    const auto& [view, tile] = tiles[i];
    TraceTile(instant, views[view], tile, order.single_packets ? 1 : Instant::kMostPackets,
              &(*images)[view]);
  });
}

}  // namespace aisle::sim
