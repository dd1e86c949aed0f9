#include "simulator/world/actors.h"

#include <cmath>

#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

/// Half of the time over which velocities are differenced.
constexpr double kHalfStep_s = 0.0005;

}  // namespace

TriangleMesh Wardrobe::Wear(const std::shared_ptr<const Model>& model) {
  const auto [entry, is_new] = first_material_.try_emplace(
      model.get(), static_cast<std::uint16_t>(parts_->materials.size()));
  if (is_new) {
    const int first_texture = static_cast<int>(parts_->textures.size());
    worn_.push_back({model, parts_->materials.size(), parts_->textures.size()});
    for (Material material : model->materials) {
      if (material.albedo_texture >= 0) material.albedo_texture += first_texture;
      if (material.normal_texture >= 0) material.normal_texture += first_texture;
      material.name = model->name + "/" + material.name;
      parts_->materials.push_back(std::move(material));
    }
    parts_->textures.insert(parts_->textures.end(), model->textures.begin(), model->textures.end());
  }
  TriangleMesh mesh = model->mesh;
  for (std::uint16_t& material : mesh.materials) {
    material = static_cast<std::uint16_t>(material + entry->second);
  }
  return mesh;
}

Eigen::Isometry3d ObjectPose(const RouteState& state) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(state.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() << state.position.x(), state.position.y(), 0;
  return pose;
}

MoverState SkinState(const Model& model, const BodyMotion& motion, double time_s,
                     MoverParts parts) {
  std::vector<Eigen::Affine3f> joints = motion.joints(time_s);
  std::vector<Eigen::Affine3f> rates = motion.joints(time_s + kHalfStep_s);
  const std::vector<Eigen::Affine3f> before = motion.joints(time_s - kHalfStep_s);
  const Eigen::Affine3f place(motion.T_world_body(time_s).cast<float>());
  const Eigen::Matrix4f moves = ((motion.T_world_body(time_s + kHalfStep_s).matrix() -
                                  motion.T_world_body(time_s - kHalfStep_s).matrix()) /
                                 (2 * kHalfStep_s))
                                    .cast<float>();
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const Eigen::Matrix4f own =
        (rates[i].matrix() - before[i].matrix()) / static_cast<float>(2 * kHalfStep_s);
    rates[i].matrix() = moves * joints[i].matrix() + place.matrix() * own;
    joints[i] = place * joints[i];
  }
  MoverState state;
  BlendVertices(model, rates, &state.velocities);
  if (parts == MoverParts::kAll) SkinVertices(model, joints, &state.positions, &state.normals);
  return state;
}

void PlaceObject(const RouteState& now, double leftwards_mps, MoverState* state) {
  state->T_world_object = ObjectPose(now);
  const Eigen::Matrix3d& axes = state->T_world_object.linear();
  state->velocity_mps = axes.col(0) * now.speed_mps + axes.col(1) * leftwards_mps;
}

}  // namespace aisle::sim
