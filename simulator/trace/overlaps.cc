#include "simulator/trace/overlaps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "simulator/common/mix.h"
#include "simulator/common/parallel.h"

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

/// The plane of a triangle, and the axis that it faces most; nothing where it has no area.
struct Plane {
  Eigen::Vector3d normal;  ///< upwards along the axis
  double area = 0, offset = 0;
  Eigen::Index axis = 0;
};
using CornersInSpace = std::array<Eigen::Vector3d, 3>;
CornersInSpace CornersOf(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.positions[a].cast<double>(), mesh.positions[b].cast<double>(),
          mesh.positions[c].cast<double>()};
}
std::optional<Plane> PlaneOf(const CornersInSpace& at) {
  Plane plane;
  plane.normal = (at[1] - at[0]).cross(at[2] - at[0]);
  plane.area = plane.normal.norm();
  if (plane.area < 1e-12) return std::nullopt;
  plane.normal /= plane.area;
  plane.normal.cwiseAbs().maxCoeff(&plane.axis);
  if (plane.normal[plane.axis] < 0) plane.normal = -plane.normal;
  plane.offset = plane.normal.dot(at[0]);
  return plane;
}

Flat Flatten(const TriangleMesh& mesh, std::uint32_t triangle) {
  const CornersInSpace at = CornersOf(mesh, triangle);
  const Plane plane = *PlaneOf(at);
  Flat flat{
      .triangle = triangle, .area = plane.area, .offset = plane.offset, .corners = {}, .box = {}};
  for (std::size_t k = 0; k < 3; ++k) {
    flat.corners[k] = {at[k][(plane.axis + 1) % 3], at[k][(plane.axis + 2) % 3]};
    flat.box.extend(flat.corners[k]);
  }
  return flat;
}

/// A triangle in one of the two slabs, of half a slab's distance, that it is inside of: one of them
/// has its neighbours. Planes that face alike within a step are told apart by their distance.
struct InSlab {
  std::array<std::int64_t, 4> slab;
  std::uint32_t triangle;

  bool operator<(const InSlab& other) const {
    return std::tie(slab, triangle) < std::tie(other.slab, other.triangle);
  }
};
std::array<InSlab, 2> SlabsOf(std::uint32_t triangle, const Plane& plane) {
  const auto cell = [](double value, double step) { return std::llround(value / step); };
  const Eigen::Vector3d& n = plane.normal;
  const std::array facing = {cell(n.x(), kNormalStep), cell(n.y(), kNormalStep),
                             cell(n.z(), kNormalStep)};
  const std::int64_t slab = cell(plane.offset, kSlab / 2);
  return {InSlab{{facing[0], facing[1], facing[2], slab}, triangle},
          InSlab{{facing[0], facing[1], facing[2], slab + 1}, triangle}};
}

/// What shares a slab shares a bucket; buckets are worked on side by side.
constexpr std::size_t kBuckets = 256;
std::size_t BucketOf(const InSlab& entry) {
  std::uint64_t hash = 0;
  for (const std::int64_t cell : entry.slab) {
    hash = Mix(hash + kGolden + static_cast<std::uint64_t>(cell));
  }
  return hash % kBuckets;
}
using Bucket = std::vector<InSlab>;

std::vector<Bucket> IntoBuckets(const TriangleMesh& mesh) {
  // By parts of the mesh first, each with buckets of its own.
  const std::size_t triangles = mesh.triangles.size();
  const std::size_t parts = 1 + triangles / 65536;
  std::vector<std::vector<Bucket>> of_part(parts);
  ParallelFor(std::size_t{0}, parts, [&](std::size_t part) {
    std::vector<Bucket>& buckets = of_part[part];
    buckets.resize(kBuckets);
    const std::size_t end = triangles * (part + 1) / parts;
    for (std::size_t i = triangles * part / parts; i < end; ++i) {
      const auto triangle = static_cast<std::uint32_t>(i);
      const std::optional<Plane> plane = PlaneOf(CornersOf(mesh, triangle));
      if (!plane) continue;
      for (const InSlab& entry : SlabsOf(triangle, *plane)) {
        buckets[BucketOf(entry)].push_back(entry);
      }
    }
  });
  std::vector<Bucket> buckets(kBuckets);
  ParallelFor(std::size_t{0}, kBuckets, [&](std::size_t b) {
    for (std::vector<Bucket>& part : of_part) {
      buckets[b].insert(buckets[b].end(), part[b].begin(), part[b].end());
      part[b] = {};
    }
  });
  return buckets;
}

/// Adds the lesser of each pair in one slab.
void AddOverlapped(std::vector<Flat> slab, std::vector<std::uint32_t>* overlapped) {
  std::ranges::sort(slab, {},
                    [](const Flat& flat) { return std::tuple(flat.box.min().x(), flat.triangle); });
  std::vector<std::uint8_t> known(slab.size());
  for (std::size_t i = 0; i < slab.size(); ++i) {
    const Flat& a = slab[i];
    for (std::size_t j = i + 1; j < slab.size(); ++j) {
      const Flat& b = slab[j];
      if (b.box.min().x() > a.box.max().x()) break;
      const bool a_is_less = std::tuple(-a.area, a.triangle) > std::tuple(-b.area, b.triangle);
      const std::size_t less = a_is_less ? i : j;
      if (known[less] == 0 && Overlap(a, b)) known[less] = 1;
    }
  }
  for (std::size_t i = 0; i < slab.size(); ++i) {
    if (known[i] != 0) overlapped->push_back(slab[i].triangle);
  }
}

/// The triangles of a bucket that larger ones of their slab cover; some may stand there twice.
std::vector<std::uint32_t> OverlappedOf(Bucket bucket, const TriangleMesh& mesh) {
  std::ranges::sort(bucket, std::less<>());
  std::vector<std::uint32_t> overlapped;
  for (auto first = bucket.begin(); first != bucket.end();) {
    const auto last = std::find_if(first, bucket.end(),
                                   [&](const InSlab& entry) { return entry.slab != first->slab; });
    if (last - first > 1) {
      std::vector<Flat> slab;
      for (auto entry = first; entry != last; ++entry) {
        slab.push_back(Flatten(mesh, entry->triangle));
      }
      AddOverlapped(std::move(slab), &overlapped);
    }
    first = last;
  }
  return overlapped;
}

}  // namespace

std::vector<std::uint8_t> FindOverlapped(const TriangleMesh& mesh) {
  std::vector<Bucket> buckets = IntoBuckets(mesh);
  std::vector<std::vector<std::uint32_t>> found(buckets.size());
  ParallelFor(std::size_t{0}, buckets.size(),
              [&](std::size_t b) { found[b] = OverlappedOf(std::move(buckets[b]), mesh); });
  std::vector<std::uint8_t> overlapped(mesh.triangles.size());
  for (const auto& of_bucket : found) {
    for (const std::uint32_t triangle : of_bucket) overlapped[triangle] = 1;
  }
  return overlapped;
}

}  // namespace aisle::sim
