#include "simulator/shade/pass/other_camera.h"

namespace aisle::sim {

OtherCamera::OtherCamera(const CameraView& view, const HitImage& image)
    : image_(&image),
      straight_(view.rays->straight),
      to_camera_(view.rotation.transpose()),
      origin_(view.origin),
      first_x_(view.rays->x[0]),
      first_y_(view.rays->y[0]),
      columns_per_x_(1 / view.rays->step_x),
      rows_per_y_(1 / view.rays->step_y) {}

I8 OtherCamera::Find(const F8x3& points, I8 primitive, I8 active, I8* pixels) const {
  if (!straight_) return I8{};
  const F8x3 d = {points.x - origin_.x(), points.y - origin_.y(), points.z - origin_.z()};
  const auto along = [&](int axis) {
    return to_camera_(axis, 0) * d.x + to_camera_(axis, 1) * d.y + to_camera_(axis, 2) * d.z;
  };
  const F8 depth = along(2);
  const I8 ahead = active & (depth > 1e-3f);
  const F8 per_depth = 1 / Select(ahead, depth, Wide(1));
  const F8 column = Floor((along(0) * per_depth - first_x_) * columns_per_x_ + 0.5f);
  const F8 row = Floor((along(1) * per_depth - first_y_) * rows_per_y_ + 0.5f);
  const I8 inside = ahead & (column >= 0) & (row >= 0) &
                    (column < static_cast<float>(image_->width)) &
                    (row < static_cast<float>(image_->height));
  if (!Any(inside)) return I8{};
  *pixels = inside ? ToInt(row) * image_->stride + ToInt(column) : I8{};
  const auto* geometries = reinterpret_cast<const std::int32_t*>(image_->geometry.data());
  const auto* primitives = reinterpret_cast<const std::int32_t*>(image_->primitive.data());
  return inside & (GatherInt(geometries, *pixels) == 0) &
         (GatherInt(primitives, *pixels) == primitive);
}

}  // namespace aisle::sim
