#include "simulator/truth/truth.h"

#include <map>
#include <optional>
#include <span>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

/// The parts of one instance (a vehicle may be several meshes).
struct Group {
  std::uint16_t instance = 0;
  std::vector<std::size_t> movers;
  GeometryMask mask = 0;
};

std::vector<Group> GroupByInstance(const Snapshot& snapshot) {
  std::map<std::uint16_t, Group> groups;
  for (std::size_t i = 0; i < snapshot.movers.size(); ++i) {
    Group& group = groups[snapshot.movers[i].instance];
    group.movers.push_back(i);
    group.mask |= MoverBit(i);
  }
  std::vector<Group> in_order;
  for (auto& [instance, group] : groups) {
    group.instance = instance;
    in_order.push_back(std::move(group));
  }
  return in_order;
}

/// The pixels whose centres its silhouette can cover, by projecting its triangles' corners; parts
/// behind the camera make it the whole image.
cv::Rect WindowOf(const Snapshot& snapshot, const Group& group, const CameraView& view) {
  constexpr double kNear = 1e-3;  // m
  const PixelRays& rays = *view.rays;
  const Eigen::Isometry3d T_camera_world = view.T_world_camera.inverse();
  Eigen::AlignedBox2d box;  // x / z, y / z
  bool behind = false, ahead = false;
  for (const std::size_t i : group.movers) {
    for (const Eigen::Vector3f& position : snapshot.movers[i].positions) {
      const Eigen::Vector3d p = T_camera_world * position.cast<double>();
      (p.z() > kNear ? ahead : behind) = true;
      if (p.z() > kNear) box.extend(Eigen::Vector2d(p.x() / p.z(), p.y() / p.z()));
    }
  }
  if (!ahead) return {};
  const cv::Rect all(0, 0, rays.width, rays.height);
  if (behind) return all;
  const Eigen::Vector2d margin(rays.step_x, rays.step_y);
  const PixelWindow window = WindowOfRays(rays, box.min() - margin, box.max() + margin);
  return cv::Rect(cv::Point(window.x0, window.y0),
                  cv::Point(std::max(window.x0, window.x1), std::max(window.y0, window.y1))) &
         all;
}

/// A growing set of pixels: its enclosing rectangle and its count.
struct PixelSet {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1, count = 0;
  void Add(int x, int y) {
    x0 = std::min(x0, x), x1 = std::max(x1, x + 1);
    y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
    ++count;
  }
  void Add(const PixelSet& other) {
    x0 = std::min(x0, other.x0), x1 = std::max(x1, other.x1);
    y0 = std::min(y0, other.y0), y1 = std::max(y1, other.y1);
    count += other.count;
  }
  cv::Rect2d box() const {
    if (count == 0) return {};
    // Pixel (x, y) covers [x - 1/2, x + 1/2].
    return {x0 - 0.5, y0 - 0.5, static_cast<double>(x1 - x0), static_cast<double>(y1 - y0)};
  }
};

struct Silhouette {
  PixelSet visible, full;
  int dynamic = 0;
};

Silhouette ScanRows(const Instant& instant, const CameraView& view, const CameraTruth& truth,
                    const cv::Rect& window, const Group& group, int y) {
  Silhouette found;
  // Packets are 4 × 2 pixels.
  for (int x = window.x; x < window.x + window.width; x += 4) {
    Rays8 rays = PixelPacket(view, x, y);
    for (int k = 0; k < kLanes; ++k) {
      const int px = x + k % 4, py = y + k / 4;
      if (!rays.valid[k]) continue;
      if (truth.instance(py, px) != group.instance) continue;
      rays.valid[k] = 0;
      found.visible.Add(px, py);
      found.full.Add(px, py);
      found.dynamic += truth.dynamic(py, px) != 0;
    }
    const unsigned hidden = instant.Occluded(rays, Coherence::kCoherent, group.mask);
    for (int k = 0; k < kLanes; ++k) {
      if (hidden >> k & 1) found.full.Add(x + k % 4, y + k / 4);
    }
  }
  return found;
}

Silhouette FindSilhouette(const Instant& instant, const CameraView& view, const CameraTruth& truth,
                          const cv::Rect& window, const Group& group) {
  const int bands = (window.height + 1) / 2;
  std::vector<Silhouette> rows(static_cast<std::size_t>(bands));
  ParallelFor(0, bands, [&](int band) {
    rows[static_cast<std::size_t>(band)] =
        ScanRows(instant, view, truth, window, group, window.y + 2 * band);
  });
  Silhouette all;
  for (const Silhouette& row : rows) {
    all.visible.Add(row.visible);
    all.full.Add(row.full);
    all.dynamic += row.dynamic;
  }
  return all;
}

/// The box around all parts, along the axes of the object's frame.
Eigen::AlignedBox3d BoxIn(const Eigen::Isometry3d& T_world_object, const Snapshot& snapshot,
                          const Group& group) {
  const Eigen::Isometry3d T_object_world = T_world_object.inverse();
  Eigen::AlignedBox3d box;
  for (const std::size_t i : group.movers) {
    for (const Eigen::Vector3f& position : snapshot.movers[i].positions) {
      box.extend(T_object_world * position.cast<double>());
    }
  }
  return box;
}

/// None where it has no pixel in the image and would have none if it stood alone.
std::optional<ObjectTruth> Describe(const Instant& instant, const CameraView& view,
                                    const CameraTruth& truth, const Group& group) {
  const cv::Rect window = WindowOf(instant.snapshot(), group, view);
  if (window.empty()) return std::nullopt;
  const Silhouette silhouette = FindSilhouette(instant, view, truth, window, group);
  if (silhouette.full.count == 0) return std::nullopt;
  const MoverState& first = instant.snapshot().movers[group.movers.front()];
  const Eigen::AlignedBox3d box = BoxIn(first.T_world_object, instant.snapshot(), group);
  return ObjectTruth{.instance = group.instance,
                     .box_visible = silhouette.visible.box(),
                     .box_full = silhouette.full.box(),
                     .T_world_object = first.T_world_object,
                     .extent_m = box.sizes(),
                     .center_m = first.T_world_object * box.center(),
                     .velocity_mps = first.velocity_mps,
                     .visible_fraction = static_cast<double>(silhouette.visible.count) /
                                         static_cast<double>(silhouette.full.count),
                     .visible_pixels = silhouette.visible.count,
                     .dynamic_pixels = silhouette.dynamic};
}

}  // namespace

CameraTruth LabelHits(const World& world, const Instant& instant, const HitImage& image,
                      const MovingNow& moving) {
  const cv::Size size(image.width, image.height);
  CameraTruth truth{cv::Mat1f(size), cv::Mat1w(size), cv::Mat1b(size), cv::Mat1b(size),
                    cv::Mat1b(size)};
  const std::span<const MoverState> movers = instant.snapshot().movers;
  ParallelFor(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t i = image.Index(x, y);
      const std::uint32_t geometry = image.geometry[i];
      std::uint16_t instance = 0;
      bool dynamic = false;
      if (geometry == 0) {
        instance = world.statics().instances[image.primitive[i]];
      } else if (geometry != kNoGeometry) {
        instance = movers[geometry - 1].instance;
        dynamic = moving(geometry - 1, image.primitive[i], image.u[i], image.v[i]);
      }
      truth.depth(y, x) = image.t[i];
      truth.instance(y, x) = instance;
      truth.object_class(y, x) =
          static_cast<std::uint8_t>(world.instances()[instance].object_class);
      truth.dynamic(y, x) = dynamic ? 255 : 0;
      truth.actor(y, x) = world.instances()[instance].is_actor ? 255 : 0;
    }
  });
  return truth;
}

std::vector<ObjectTruth> DescribeMovers(const Instant& instant, const CameraView& view,
                                        const CameraTruth& truth) {
  const std::vector<Group> groups = GroupByInstance(instant.snapshot());
  std::vector<std::optional<ObjectTruth>> described(groups.size());
  ParallelFor(std::size_t{0}, groups.size(),
              [&](std::size_t i) { described[i] = Describe(instant, view, truth, groups[i]); });
  std::vector<ObjectTruth> result;
  for (const std::optional<ObjectTruth>& object : described) {
    if (object) result.push_back(*object);
  }
  return result;
}

}  // namespace aisle::sim
