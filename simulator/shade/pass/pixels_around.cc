#include "simulator/shade/pass/pixels_around.h"

#include <algorithm>
#include <bit>

namespace aisle::sim {
namespace {

constexpr std::array<PixelAt, 9> kSteps = {
    {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

constexpr unsigned kAll = (1u << 9) - 1;

/// The triangle of the first pixel that is left; takes all away that show it. The middle's where
/// none is left.
std::uint32_t TakeFirst(std::span<const std::uint32_t, 9> triangles, unsigned* rest) {
  if (*rest == 0) return triangles[0];
  const std::uint32_t first = triangles[static_cast<std::size_t>(std::countr_zero(*rest))];
  unsigned same = 0;
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    same |= static_cast<unsigned>(triangles[n] == first) << n;
  }
  *rest &= ~same;
  return first;
}

}  // namespace

PixelsAround::PixelsAround(const HitImage& image, const cv::Mat1f& radiance,
                           std::span<const PixelAt> pixels) {
  const PixelAt first = pixels.front(), second = pixels.back();
  for (std::size_t n = 0; n < kPixels; ++n) {
    const auto moved = [&](const PixelAt& from) {
      return PixelAt{std::clamp(from.x + kSteps[n].x, 0, image.width - 1),
                     std::clamp(from.y + kSteps[n].y, 0, image.height - 1)};
    };
    const PixelAt a = moved(first), b = moved(second);
    const std::size_t at_a = image.Index(a.x, a.y), at_b = image.Index(b.x, b.y);
    seen_[n] = {.geometry = InTurn(image.geometry[at_a], image.geometry[at_b]),
                .primitive = InTurn(image.primitive[at_a], image.primitive[at_b]),
                .t = InTurn(image.t[at_a], image.t[at_b]),
                .radiance = InTurn(radiance(a.y, a.x), radiance(b.y, b.x))};
    others_ |= seen_[n].geometry;
    triangles_[0][n] = image.primitive[at_a];
    triangles_[1][n] = image.primitive[at_b];
  }
}

Hits8 PixelsAround::Meet(const Instant& instant, const Rays8& rays) const {
  // Each triangle once; `rest` are the pixels that show another than those met already.
  std::array<unsigned, 2> rest = {kAll, kAll};
  F8 t = Wide(kInfinity), u = Wide(0), v = Wide(0);
  I8 primitive{}, geometry = WideInt(-1);
  while (rest[0] | rest[1]) {
    const std::uint32_t a = TakeFirst(triangles_[0], &rest[0]);
    const std::uint32_t b = TakeFirst(triangles_[1], &rest[1]);
    const Meetings8 met = instant.MeetStatic(rays, a, b);
    const F8 distance = LoadF(met.t);
    const I8 nearer = (LoadI(met.on_rim) == 0) & (distance > 0) & (distance < t);
    t = Select(nearer, distance, t);
    u = Select(nearer, LoadF(met.u), u);
    v = Select(nearer, LoadF(met.v), v);
    primitive = nearer ? InTurn(a, b) : primitive;
    geometry = nearer ? I8{} : geometry;
  }
  Hits8 hits;
  Store(t, hits.t);
  Store(u, hits.u);
  Store(v, hits.v);
  StoreI(geometry, hits.geometry);
  StoreI(primitive, hits.primitive);
  return hits;
}

I8 PixelsAround::BehindSomething(const Rays8& rays, const Hits8& hits, const F8x3& normals,
                                 const Eigen::Vector3f& right, const Eigen::Vector3f& down) const {
  constexpr float kBefore =
      1 - 3e-4f;  // of the plane's distance; nearer by less is the plane's own
  const auto along = [&](const Eigen::Vector3f& way) {
    return normals.x * way.x() + normals.y * way.y() + normals.z * way.z();
  };
  // A ray meets the plane at a distance that goes with one over its product with the normal, which
  // is linear along the image.
  const F8 here = Dot(normals, F8x3{LoadF(rays.dx), LoadF(rays.dy), LoadF(rays.dz)});
  const F8 to_right = along(right) / here, to_below = along(down) / here;
  const F8 bound = kBefore * LoadF(hits.t);
  const I8 primitive = LoadI(hits.primitive);
  I8 behind{};
  for (std::size_t n = 0; n < kPixels; ++n) {
    const F8 there = 1 + (static_cast<float>(kSteps[n].x) - kSampleX) * to_right +
                     (static_cast<float>(kSteps[n].y) - kSampleY) * to_below;
    // Where it is not positive, the plane is not met at all.
    behind |= (seen_[n].t * there < bound) & (seen_[n].primitive != primitive);
  }
  return behind;
}

F8 PixelsAround::RadianceOf(const Hits8& hits) const {
  constexpr float kSameDepth = 0.01f;
  const I8 geometry = LoadI(hits.geometry), primitive = LoadI(hits.primitive);
  const F8 t = LoadF(hits.t);
  F8 nearest = Wide(kInfinity), found = Wide(-1);
  for (std::size_t n = 0; n < kPixels; ++n) {
    const Seen& seen = seen_[n];
    // Movers' triangles are small: there the same body at the same depth will do, the nearer the
    // better, as a limb may be before another.
    const F8 apart = Abs(seen.t - t);
    const I8 same_surface = geometry == 0  ? seen.primitive == primitive
                            : geometry > 0 ? apart <= kSameDepth * t
                                           : WideInt(-1);
    const F8 x = kSampleX - static_cast<float>(kSteps[n].x);
    const F8 y = kSampleY - static_cast<float>(kSteps[n].y);
    const F8 away = Select(geometry > 0, apart, x * x + y * y);
    const I8 nearer = (seen.geometry == geometry) & same_surface & (away < nearest);
    nearest = Select(nearer, away, nearest);
    found = Select(nearer, seen.radiance, found);
  }
  return found;
}

}  // namespace aisle::sim
