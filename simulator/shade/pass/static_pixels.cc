#include "simulator/shade/pass/static_pixels.h"

namespace aisle::sim {
namespace {

constexpr float kLift = 2e-3f;  // m, along the normal

StaticPoints8 LiftOff(std::span<const SurfaceRecord> statics, const F8x3& position, I8 primitive,
                      F8 u, F8 v, I8 lanes) {
  if (!Any(lanes)) return StaticPoints8{};
  const I8 offset =
      (lanes ? primitive : I8{}) * static_cast<int>(sizeof(SurfaceRecord) / sizeof(float));
  const SurfaceRecord& first = statics.front();
  const F8x3 normal = {Gather(first.normal, offset), Gather(first.normal, offset + 1),
                       Gather(first.normal, offset + 2)};
  const I8 is_luminaire = Gather(&first.f0, offset) < 0;
  return {.position = {position.x + kLift * normal.x, position.y + kLift * normal.y,
                       position.z + kLift * normal.z},
          .normal = normal,
          .primitive = primitive,
          .u = u,
          .v = v,
          .active = lanes & ~is_luminaire};
}

}  // namespace

F8x3 StaticPixels::PositionsOf(int x, int y, I8 active) const {
  const std::size_t i = shading_.image.Index(x, y);
  const auto ray = static_cast<std::size_t>(y * shading_.view.rays->width + x);
  const F8 cx = LoadF(&shading_.view.rays->x[ray]), cy = LoadF(&shading_.view.rays->y[ray]);
  const F8 t = Select(active, LoadF(&shading_.image.t[i]), Wide(0));
  const Eigen::Matrix3f& r = shading_.view.rotation;
  const Eigen::Vector3f& o = shading_.view.origin;
  return {o.x() + t * (r(0, 0) * cx + r(0, 1) * cy + r(0, 2)),
          o.y() + t * (r(1, 0) * cx + r(1, 1) * cy + r(1, 2)),
          o.z() + t * (r(2, 0) * cx + r(2, 1) * cy + r(2, 2))};
}

StaticPoints8 StaticPixels::Locate(int x, int y, I8 active) const {
  const std::size_t i = shading_.image.Index(x, y);
  return LiftOff(shading_.tables.statics(), PositionsOf(x, y, active),
                 LoadI(&shading_.image.primitive[i]), LoadF(&shading_.image.u[i]),
                 LoadF(&shading_.image.v[i]), active);
}

StaticPoints8 LocateHits(const SurfaceTables& tables, const Rays8& rays, const Hits8& hits) {
  const I8 active = LoadI(rays.valid) & (LoadI(hits.geometry) == 0);
  const F8 t = Select(active, LoadF(hits.t), Wide(0));
  const F8x3 position = {LoadF(rays.ox) + t * LoadF(rays.dx), LoadF(rays.oy) + t * LoadF(rays.dy),
                         LoadF(rays.oz) + t * LoadF(rays.dz)};
  return LiftOff(tables.statics(), position, LoadI(hits.primitive), LoadF(hits.u), LoadF(hits.v),
                 active);
}

}  // namespace aisle::sim
