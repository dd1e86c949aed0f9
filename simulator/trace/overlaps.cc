#include "simulator/trace/overlaps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace aisle::sim {
namespace {

constexpr double kSamePlane = 1e-4;     // m, across the plane
constexpr double kSlab = 1e-2;          // m; planes are looked up by slabs of this thickness
constexpr double kNormalStep = 1e-2;    // of a normal's coordinates, for looking up
constexpr double kLeastOverlap = 1e-5;  // m: less is a shared edge

/// A triangle in its plane, seen along the axis that the plane faces most.
struct Flat {
  std::uint32_t triangle = 0;
  double area = 0, offset = 0;
  std::array<Eigen::Vector2d, 3> corners;
  Eigen::AlignedBox2d box;
};

/// Whether a side of `a` has all of `b` beyond it.
bool SideParts(const Flat& a, const Flat& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d side = a.corners[(i + 1) % 3] - a.corners[i];
    Eigen::Vector2d out(side.y(), -side.x());
    if (out.dot(a.corners[(i + 2) % 3] - a.corners[i]) > 0) out = -out;
    out.normalize();
    const auto beyond = [&](const Eigen::Vector2d& corner) {
      return out.dot(corner - a.corners[i]) >= -kLeastOverlap;
    };
    if (std::ranges::all_of(b.corners, beyond)) return true;
  }
  return false;
}

bool Overlap(const Flat& a, const Flat& b) {
  return std::abs(a.offset - b.offset) <= kSamePlane && a.box.intersects(b.box) &&
         !SideParts(a, b) && !SideParts(b, a);
}

/// Marks the lesser of each pair in one slab.
void MarkSlab(std::vector<Flat>* slab, std::vector<std::uint8_t>* overlapped) {
  std::ranges::sort(*slab, {},
                    [](const Flat& flat) { return std::tuple(flat.box.min().x(), flat.triangle); });
  for (std::size_t i = 0; i < slab->size(); ++i) {
    const Flat& a = (*slab)[i];
    for (std::size_t j = i + 1; j < slab->size(); ++j) {
      const Flat& b = (*slab)[j];
      if (b.box.min().x() > a.box.max().x()) break;
      const bool a_is_less = std::tuple(-a.area, a.triangle) > std::tuple(-b.area, b.triangle);
      std::uint8_t& less = (*overlapped)[a_is_less ? a.triangle : b.triangle];
      if (less == 0 && Overlap(a, b)) less = 1;
    }
  }
}

}  // namespace

std::vector<std::uint8_t> FindOverlapped(const TriangleMesh& mesh) {
  std::map<std::array<std::int64_t, 4>, std::vector<Flat>> slabs;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const std::array<Eigen::Vector3d, 3> at = {mesh.positions[a].cast<double>(),
                                               mesh.positions[b].cast<double>(),
                                               mesh.positions[c].cast<double>()};
    Eigen::Vector3d normal = (at[1] - at[0]).cross(at[2] - at[0]);
    Flat flat{.triangle = i, .area = normal.norm(), .offset = 0, .corners = {}, .box = {}};
    if (flat.area < 1e-12) continue;
    normal /= flat.area;
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    if (normal[axis] < 0) normal = -normal;
    flat.offset = normal.dot(at[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      flat.corners[k] = {at[k][(axis + 1) % 3], at[k][(axis + 2) % 3]};
      flat.box.extend(flat.corners[k]);
    }
    // In the two slabs of half a slab's distance that it is inside of: one has its neighbours.
    const auto cell = [](double value, double step) { return std::llround(value / step); };
    const std::int64_t slab = cell(flat.offset, kSlab / 2);
    for (const std::int64_t key : {slab, slab + 1}) {
      slabs[{cell(normal.x(), kNormalStep), cell(normal.y(), kNormalStep),
             cell(normal.z(), kNormalStep), key}]
          .push_back(flat);
    }
  }
  std::vector<std::uint8_t> overlapped(mesh.triangles.size());
  for (auto& [key, slab] : slabs) MarkSlab(&slab, &overlapped);
  return overlapped;
}

}  // namespace aisle::sim
