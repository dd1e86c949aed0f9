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

MoverState SkinState(const Model& model,
                     const std::function<std::vector<Eigen::Affine3f>(double)>& world_joints,
                     const std::function<RouteState(double)>& route, double time_s) {
  std::vector<Eigen::Affine3f> rates = world_joints(time_s + kHalfStep_s);
  const std::vector<Eigen::Affine3f> before = world_joints(time_s - kHalfStep_s);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    rates[i].matrix() =
        (rates[i].matrix() - before[i].matrix()) / static_cast<float>(2 * kHalfStep_s);
  }
  const RouteState now = route(time_s);
  MoverState state;
  state.T_world_object = ObjectPose(now);
  state.velocity_mps = state.T_world_object.linear().col(0) * now.speed_mps;
  SkinVertices(model, world_joints(time_s), &state.positions, &state.normals);
  BlendVertices(model, rates, &state.velocities);
  return state;
}

}  // namespace aisle::sim
