#include "simulator/mesh/two_bone.h"

#include <cmath>

namespace aisle::sim {
namespace {

using Eigen::Affine3f;
using Eigen::Vector3f;

/// Rotation about a point that turns one direction into another.
Affine3f Turn(const Vector3f& about, const Vector3f& from, const Vector3f& to) {
  return Eigen::Translation3f(about) * Eigen::Quaternionf::FromTwoVectors(from, to) *
         Eigen::Translation3f(-about);
}

}  // namespace

void MoveSubtree(const Model& model, int top, const Affine3f& motion, NodeFrames* frames) {
  std::vector<bool> below(model.nodes.size(), false);
  for (std::size_t i = static_cast<std::size_t>(top); i < below.size(); ++i) {
    const int parent = model.nodes[i].parent;
    below[i] =
        static_cast<int>(i) == top || (parent >= top && below[static_cast<std::size_t>(parent)]);
    if (below[i]) (*frames)[i] = motion * (*frames)[i];
  }
}

void ReachFor(const Model& model, const Limb& limb, const Affine3f& target, float reach,
              NodeFrames* frames) {
  const auto frame = [&](int node) -> Affine3f& {
    return (*frames)[static_cast<std::size_t>(node)];
  };
  const Vector3f root = frame(limb.upper).translation();
  const Vector3f knee = frame(limb.lower).translation();
  const Vector3f end = frame(limb.end).translation();
  const float upper = (knee - root).norm(), lower = (end - knee).norm();
  if (upper <= 0 || lower <= 0) return;

  Vector3f way = target.translation() - root;
  const float distance =
      std::clamp(way.norm(), std::abs(upper - lower) * 1.001f + 1e-5f, reach * (upper + lower));
  way.normalize();
  // The knee keeps to its side of the line from root to end.
  Vector3f bend =
      (knee - root) - (knee - root).dot((end - root).normalized()) * (end - root).normalized();
  bend -= bend.dot(way) * way;
  if (bend.norm() < 1e-5f * upper) bend = Vector3f::UnitX() - way.x() * way;
  bend.normalize();
  const float along = (upper * upper - lower * lower + distance * distance) / (2 * distance);
  const float aside = std::sqrt(std::max(0.0f, upper * upper - along * along));
  const Vector3f new_knee = root + along * way + aside * bend;

  MoveSubtree(model, limb.upper, Turn(root, knee - root, new_knee - root), frames);
  const Vector3f moved_end = frame(limb.end).translation();
  const Vector3f new_end = root + distance * way;
  MoveSubtree(model, limb.lower, Turn(new_knee, moved_end - new_knee, new_end - new_knee), frames);

  Affine3f placed = target;
  placed.translation() = new_end;
  MoveSubtree(model, limb.end, placed * frame(limb.end).inverse(), frames);
}

}  // namespace aisle::sim
