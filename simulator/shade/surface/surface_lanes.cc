#include "simulator/shade/surface/surface_lanes.h"

#include <cstddef>

namespace aisle::sim {
namespace {

/// Reads one field of eight records; where all lanes are on one triangle, once.
class Reader {
 public:
  Reader(const SurfaceRecord* records, I8 index)
      : base_(reinterpret_cast<const float*>(records)),
        offset_(index * static_cast<int>(sizeof(SurfaceRecord) / sizeof(float))),
        uniform_(!Any(index != index[0])) {}

  F8 Float(std::size_t byte) const {
    const float* field = base_ + byte / sizeof(float);
    return uniform_ ? Wide(field[offset_[0]]) : Gather(field, offset_);
  }
  I8 Int(std::size_t byte) const { return reinterpret_cast<I8>(Float(byte)); }

 private:
  const float* base_;
  I8 offset_;
  bool uniform_;
};

#define AISLE_FIELD(name) offsetof(SurfaceRecord, name)

F8 ReadLight(const Reader& record, const float* light, F8 u, F8 v) {
  const auto coordinate = [&](std::size_t c0, std::size_t cu, std::size_t cv) {
    return Max(record.Float(c0) + record.Float(cu) * u + record.Float(cv) * v, Wide(0));
  };
  const F8 s = coordinate(AISLE_FIELD(light.s0), AISLE_FIELD(light.su), AISLE_FIELD(light.sv));
  const F8 t = coordinate(AISLE_FIELD(light.t0), AISLE_FIELD(light.tu), AISLE_FIELD(light.tv));
  const I8 pitch = record.Int(AISLE_FIELD(light.pitch));
  const F8 rows =
      Max(record.Float(AISLE_FIELD(light.t0)),
          Max(record.Float(AISLE_FIELD(light.tu)), record.Float(AISLE_FIELD(light.tv))));
  // A hit on the far edge belongs to the last cell.
  const F8 s_floor = Min(Floor(s), ToFloat(pitch - 2)), t_floor = Min(Floor(t), rows - 1);
  const F8 fs = s - s_floor, ft = t - t_floor;
  const I8 at = record.Int(AISLE_FIELD(light.slot)) + ToInt(t_floor) * pitch + ToInt(s_floor);
  const F8 a = Gather(light, at), b = Gather(light, at + 1);
  const F8 c = Gather(light, at + pitch), d = Gather(light, at + pitch + 1);
  const F8 top = a + (b - a) * fs, bottom = c + (d - c) * fs;
  return top + (bottom - top) * ft;
}

/// How the point under a pixel moves along the surface when the pixel does.
struct Step8 {
  F8 x, y, z;
};
Step8 SurfaceStep(const HitLanes& hit, F8 nx, F8 ny, F8 nz, const Eigen::Vector3f& step) {
  const F8 along = nx * hit.dx + ny * hit.dy + nz * hit.dz;
  // At grazing angles the footprint grows without bound; 1e-3 stands for the horizon.
  const F8 safe = Select(Abs(along) < 1e-3f, Wide(1e-3f), along);
  const F8 k = (nx * step.x() + ny * step.y() + nz * step.z()) / safe;
  return {hit.t * (step.x() - k * hit.dx), hit.t * (step.y() - k * hit.dy),
          hit.t * (step.z() - k * hit.dz)};
}

F8 ReadTexture(const Reader& record, const TexturePool& textures, I8 texture, const HitLanes& hit,
               const RayStep& step) {
  const F8 nx = record.Float(AISLE_FIELD(normal[0])), ny = record.Float(AISLE_FIELD(normal[1])),
           nz = record.Float(AISLE_FIELD(normal[2]));
  const F8 ux = record.Float(AISLE_FIELD(du[0])), uy = record.Float(AISLE_FIELD(du[1])),
           uz = record.Float(AISLE_FIELD(du[2]));
  const F8 vx = record.Float(AISLE_FIELD(dv[0])), vy = record.Float(AISLE_FIELD(dv[1])),
           vz = record.Float(AISLE_FIELD(dv[2]));
  const Step8 right = SurfaceStep(hit, nx, ny, nz, step.right);
  const Step8 down = SurfaceStep(hit, nx, ny, nz, step.down);
  const F8 tu = record.Float(AISLE_FIELD(uv0[0])) + record.Float(AISLE_FIELD(uv1[0])) * hit.u +
                record.Float(AISLE_FIELD(uv2[0])) * hit.v;
  const F8 tv = record.Float(AISLE_FIELD(uv0[1])) + record.Float(AISLE_FIELD(uv1[1])) * hit.u +
                record.Float(AISLE_FIELD(uv2[1])) * hit.v;
  return textures.Sample(texture, tu, tv, ux * right.x + uy * right.y + uz * right.z,
                         vx * right.x + vy * right.y + vz * right.z,
                         ux * down.x + uy * down.y + uz * down.z,
                         vx * down.x + vy * down.y + vz * down.z);
}

}  // namespace

SurfaceLanes LookUp(const Surfaces& surfaces, const TexturePool& textures, const HitLanes& hit,
                    const RayStep& step) {
  const Reader record(surfaces.records, hit.record);
  SurfaceLanes result;
  result.irradiance = ReadLight(record, surfaces.light, hit.u, hit.v);
  result.reflectance = record.Float(AISLE_FIELD(albedo));
  const I8 texture = record.Int(AISLE_FIELD(texture));
  if (Any(texture >= 0)) result.reflectance *= ReadTexture(record, textures, texture, hit, step);
  return result;
}

}  // namespace aisle::sim
