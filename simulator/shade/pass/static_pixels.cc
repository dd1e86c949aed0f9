#include "simulator/shade/pass/static_pixels.h"

namespace aisle::sim {
namespace {

constexpr float kLift = 2e-3f;  // m, along the normal

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

Pixels8 StaticPixels::Locate(int x, int y, I8 active) const {
  Pixels8 p;
  p.active = active;
  const I8 record = p.active ? LoadI(&shading_.image.primitive[shading_.image.Index(x, y)]) : I8{};
  const I8 offset = record * static_cast<int>(sizeof(SurfaceRecord) / sizeof(float));
  const auto* base = shading_.tables.statics().data()->normal;
  p.normal = {Gather(base, offset), Gather(base, offset + 1), Gather(base, offset + 2)};
  p.position = PositionsOf(x, y, p.active);
  p.position.x += kLift * p.normal.x;
  p.position.y += kLift * p.normal.y;
  p.position.z += kLift * p.normal.z;
  return p;
}

}  // namespace aisle::sim
