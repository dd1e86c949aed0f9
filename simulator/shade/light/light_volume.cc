#include "simulator/shade/light/light_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aisle::sim {

LightVolume::LightVolume(const Shape& shape, std::vector<Node> nodes)
    : shape_(shape), nodes_(std::move(nodes)) {}

LightVolume::LightVolume(const Eigen::AlignedBox3f& box, float spacing_m)
    : shape_(ShapeOf(box, spacing_m)), nodes_(shape_.size()) {}

std::size_t LightVolume::Shape::size() const {
  return static_cast<std::size_t>(count.cast<std::int64_t>().prod());
}

LightVolume::Shape LightVolume::ShapeOf(const Eigen::AlignedBox3f& box, float spacing_m) {
  Shape shape{.origin = box.min(), .spacing = spacing_m};
  for (int i = 0; i < 3; ++i) shape.count[i] = 2 + static_cast<int>(box.sizes()[i] / spacing_m);
  return shape;
}

Eigen::Vector3f LightVolume::Position(std::size_t node) const {
  const auto i = static_cast<int>(node);
  const Eigen::Vector3i cell(i % shape_.count[0], i / shape_.count[0] % shape_.count[1],
                             i / shape_.count[0] / shape_.count[1]);
  return shape_.origin + shape_.spacing * cell.cast<float>();
}

float LightVolume::Node::Irradiance(const Eigen::Vector3f& normal) const {
  // The cosine-weighted integral of mean + slope·ω over the hemisphere of the normal.
  constexpr float kPi = std::numbers::pi_v<float>;
  return std::max(0.0f, kPi * mean + 2 * kPi / 3 * slope.dot(normal));
}

LightVolume::Node LightVolume::At(const Eigen::Vector3f& position) const {
  if (nodes_.empty()) return {};
  const Eigen::Vector3f at = (position - shape_.origin) / shape_.spacing;
  Eigen::Vector3i cell;
  Eigen::Vector3f f;
  for (int i = 0; i < 3; ++i) {
    const float inside = std::clamp(at[i], 0.0f, static_cast<float>(shape_.count[i]) - 1.001f);
    cell[i] = static_cast<int>(inside);
    f[i] = inside - static_cast<float>(cell[i]);
  }
  Node sum;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i c = cell + Eigen::Vector3i(corner & 1, corner >> 1 & 1, corner >> 2);
    const Node& node = nodes_[static_cast<std::size_t>(
        (c.z() * shape_.count[1] + c.y()) * shape_.count[0] + c.x())];
    const float w = node.weight * (corner & 1 ? f.x() : 1 - f.x()) *
                    (corner & 2 ? f.y() : 1 - f.y()) * (corner & 4 ? f.z() : 1 - f.z());
    sum.mean += w * node.mean;
    sum.slope += w * node.slope;
    sum.weight += w;
  }
  if (sum.weight <= 0) return {};
  return {sum.mean / sum.weight, sum.slope / sum.weight, sum.weight};
}

}  // namespace aisle::sim
