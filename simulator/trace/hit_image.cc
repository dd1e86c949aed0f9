#include "simulator/trace/hit_image.h"

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

void TraceTile(const Instant& instant, const CameraView& view, const Tile& tile, HitImage* image) {
  const GeometryMask geometries =
      GeometriesInWindow(instant, view, tile.x0, tile.y0, tile.x1, tile.y1);
  Hits8 hits;
  for (int y = tile.y0; y < tile.y1; y += kPacketHeight) {
    for (int x = tile.x0; x < tile.x1; x += kPacketWidth) {
      instant.Intersect(PixelPacket(view, x, y), Coherence::kCoherent, geometries, &hits);
      Store(hits, x, y, image);
    }
  }
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
  Rays8 packet;
  for (int k = 0; k < kLanes; ++k) {
    const int px = x + k % kPacketWidth, py = y + k / kPacketWidth;
    const bool inside = px < rays.width && py < rays.height;
    const auto i = static_cast<std::size_t>(inside ? py * rays.width + px : 0);
    const float cx = rays.x[i], cy = rays.y[i];
    packet.ox[k] = view.origin.x();
    packet.oy[k] = view.origin.y();
    packet.oz[k] = view.origin.z();
    packet.dx[k] = r(0, 0) * cx + r(0, 1) * cy + r(0, 2);
    packet.dy[k] = r(1, 0) * cx + r(1, 1) * cy + r(1, 2);
    packet.dz[k] = r(2, 0) * cx + r(2, 1) * cy + r(2, 2);
    packet.t_near[k] = 0;
    packet.t_far[k] = kInfinity;
    packet.valid[k] = inside ? -1 : 0;
  }
  return packet;
}

GeometryMask GeometriesInWindow(const Instant& instant, const CameraView& view, int x0, int y0,
                                int x1, int y1) {
  // A box can show in the window only if no side plane of the window's pyramid has all of it
  // outside. The planes enclose the rays of the window's border (of its corners, for a pinhole),
  // widened by one pixel.
  const PixelRays& rays = *view.rays;
  Eigen::AlignedBox2f window;
  for (const int y : {y0, y1 - 1}) {
    for (const int x : {x0, x1 - 1}) window.extend(rays.At(x, y));
  }
  if (!rays.straight) {
    for (int x = x0; x < x1; ++x) window.extend(rays.At(x, y0)).extend(rays.At(x, y1 - 1));
    for (int y = y0; y < y1; ++y) window.extend(rays.At(x0, y)).extend(rays.At(x1 - 1, y));
  }
  const Eigen::Vector2f lo = window.min() - Eigen::Vector2f(rays.step_x, rays.step_y);
  const Eigen::Vector2f hi = window.max() + Eigen::Vector2f(rays.step_x, rays.step_y);
  const Eigen::Isometry3f T_camera_world = view.T_world_camera.inverse().cast<float>();
  GeometryMask mask = kStaticOnly;
  for (std::size_t i = 0; i < instant.mover_boxes().size(); ++i) {
    int left = 0, right = 0, above = 0, below = 0, behind = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3f p =
          T_camera_world *
          instant.mover_boxes()[i].corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner));
      left += p.x() < lo.x() * p.z();
      right += p.x() > hi.x() * p.z();
      above += p.y() < lo.y() * p.z();
      below += p.y() > hi.y() * p.z();
      behind += p.z() < 0;
    }
    if (std::max({left, right, above, below, behind}) < 8) mask |= MoverBit(i);
  }
  return mask;
}

void TraceViews(const Instant& instant, std::span<const CameraView> views, const TraceOrder& order,
                std::vector<HitImage>* images) {
  images->resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    (*images)[i].Resize(views[i].rays->width, views[i].rays->height);
  }
  const std::vector<TileOfView> tiles = MakeTiles(views, order.shuffle);
  ParallelFor(std::size_t{0}, tiles.size(), [&](std::size_t i) {
    const auto& [view, tile] = tiles[i];
    TraceTile(instant, views[view], tile, &(*images)[view]);
  });
}

}  // namespace aisle::sim
