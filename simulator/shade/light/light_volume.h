#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace aisle::sim {

/// Indirect light in free space: radiance L(ω) = mean + slope·ω at the nodes of a grid, linear in
/// between. Nodes inside solid things have weight 0 and do not count.
class LightVolume {
 public:
  struct Node {
    float mean = 0;
    Eigen::Vector3f slope = Eigen::Vector3f::Zero();
    float weight = 0;  ///< 1 in free space, 0 inside a thing

    /// On the side of a unit normal.
    float Irradiance(const Eigen::Vector3f& normal) const;
  };

  struct Shape {
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< of the first node
    float spacing = 1;                                 ///< m
    Eigen::Vector3i count = Eigen::Vector3i::Zero();   ///< nodes along x, y, z

    std::size_t size() const;  ///< nodes in all
  };
  /// Of nodes that reach from a box's least corner to beyond its greatest.
  static Shape ShapeOf(const Eigen::AlignedBox3f& box, float spacing_m);

  LightVolume() = default;
  LightVolume(const Shape& shape, std::vector<Node> nodes);
  LightVolume(const Eigen::AlignedBox3f& box, float spacing_m);

  std::size_t size() const { return nodes_.size(); }
  Eigen::Vector3f Position(std::size_t node) const;
  void Set(std::size_t node, const Node& value) { nodes_[node] = value; }
  const Node& node(std::size_t i) const { return nodes_[i]; }
  std::span<const Node> nodes() const { return nodes_; }
  const Shape& shape() const { return shape_; }

  /// The light at a point between the nodes; none where all nodes around lie inside things.
  Node At(const Eigen::Vector3f& position) const;
  /// Irradiance at a point on the side of `normal`.
  float Irradiance(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) const {
    return At(position).Irradiance(normal);
  }

 private:
  Shape shape_;
  std::vector<Node> nodes_;
};

}  // namespace aisle::sim
