#include "simulator/mesh/check_model.h"

#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

constexpr int kTimesPerClip = 16;

void Require(bool condition, const char* otherwise) {
  if (!condition) throw ImportError(otherwise);
}

template <class Index>
bool IsIn(Index index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}

bool IsFinite(const NodePose& pose) {
  return pose.translation.allFinite() && pose.rotation.coeffs().allFinite() &&
         pose.scale.allFinite();
}

void CheckMesh(const Model& model) {
  const TriangleMesh& mesh = model.mesh;
  const std::size_t vertices = mesh.positions.size();
  Require(mesh.normals.size() == vertices && mesh.uvs.size() == vertices &&
              model.bind_positions.size() == vertices && model.bind_normals.size() == vertices &&
              model.weights.size() == vertices,
          "its lists of vertices differ in length");
  Require(mesh.materials.size() == mesh.triangles.size(),
          "it has not as many materials as triangles");
  for (const auto& corners : mesh.triangles) {
    for (const std::uint32_t corner : corners) {
      Require(corner < vertices, "a face names a vertex that does not exist");
    }
  }
  for (const std::uint16_t material : mesh.materials) {
    Require(material < model.materials.size(), "a mesh names a material that does not exist");
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    Require(model.bind_positions[i].allFinite(), "a vertex is not finite");
    Require(mesh.normals[i].allFinite() && model.bind_normals[i].allFinite(),
            "a normal is not finite");
    Require(mesh.uvs[i].allFinite(), "a texture coordinate is not finite");
  }
}

void CheckSkeleton(const Model& model) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const ModelNode& node = model.nodes[i];
    Require(node.parent >= -1 && node.parent < static_cast<int>(i),
            "a node does not come after its parent");
    Require(IsFinite(node.rest), "a node's transformation is not finite");
  }
  for (const ModelJoint& joint : model.joints) {
    Require(IsIn(joint.node, model.nodes.size()), "a joint follows a node that does not exist");
    Require(joint.bind_to_node.matrix().allFinite(), "a joint's bind matrix is not finite");
  }
  for (const VertexWeights& follows : model.weights) {
    for (std::size_t k = 0; k < follows.joints.size(); ++k) {
      Require(follows.joints[k] < model.joints.size(),
              "a vertex follows a joint that does not exist");
      Require(follows.weights[k] >= 0 && follows.weights[k] <= 1,
              "a joint's weight is not between 0 and 1");
    }
  }
}

bool IsFinite(const Eigen::Vector3f& value) { return value.allFinite(); }
bool IsFinite(const Eigen::Quaternionf& value) { return value.coeffs().allFinite(); }

template <class Value>
void CheckCurve(const KeyCurve<Value>& curve) {
  const bool cubic = curve.interpolation == Interpolation::kCubic;
  Require(cubic || curve.interpolation == Interpolation::kStep ||
              curve.interpolation == Interpolation::kLinear,
          "an animation has an interpolation that does not exist");
  Require(curve.slopes.size() == (cubic ? curve.keys.size() : 0),
          "an animation has not as many slopes as keys");
  float last_s = -std::numeric_limits<float>::infinity();
  for (const auto& [time_s, value] : curve.keys) {
    Require(std::isfinite(time_s) && IsFinite(value), "an animation key is not finite");
    Require(time_s >= last_s, "animation keys are not in order of time");
    last_s = time_s;
  }
  for (const auto& [in, out] : curve.slopes) {
    Require(IsFinite(in) && IsFinite(out), "an animation key is not finite");
  }
}

void CheckSurfaces(const std::vector<Material>& materials, const std::vector<Texture>& textures,
                   const ImportOptions& options) {
  for (const Texture& texture : textures) {
    const cv::Mat& image = texture.image;
    Require(image.type() == CV_8UC1 || image.type() == CV_8UC3,
            "a texture is neither grey nor a normal map");
    Require(image.cols >= 1 && image.cols <= options.max_texture_px && image.rows >= 1 &&
                image.rows <= options.max_texture_px,
            "a texture is larger than allowed");
  }
  const auto is_texture = [&](int index, int type) {
    return index == -1 || (IsIn(index, textures.size()) &&
                           textures[static_cast<std::size_t>(index)].image.type() == type);
  };
  for (const Material& material : materials) {
    Require(is_texture(material.albedo_texture, CV_8UC1) &&
                is_texture(material.normal_texture, CV_8UC3),
            "a material names a texture that does not exist");
    for (const float value : {material.albedo, material.normal_scale, material.specular_f0,
                              material.roughness, material.emission}) {
      Require(std::isfinite(value), "a material is not finite");
    }
  }
}

void CheckColour(const Model& model, const ImportOptions& options) {
  Require(model.colour.empty() || model.colour.size() == 3, "a colour has three bands");
  for (const ModelSurfaces& band : model.colour) {
    Require(band.materials.size() == model.materials.size() &&
                band.textures.size() == model.textures.size(),
            "its bands differ in their materials or textures");
    CheckSurfaces(band.materials, band.textures, options);
  }
}

/// For each joint the box around the vertices that follow it, where they are bound.
std::vector<Eigen::AlignedBox3f> BoxesOfJoints(const Model& model) {
  std::vector<Eigen::AlignedBox3f> boxes(model.joints.size());
  for (std::size_t i = 0; i < model.weights.size(); ++i) {
    const VertexWeights& follows = model.weights[i];
    for (std::size_t k = 0; k < 4 && follows.weights[k] > 0; ++k) {
      boxes[follows.joints[k]].extend(model.bind_positions[i]);
    }
  }
  return boxes;
}

/// Whether every joint carries its box to within reach; what is blended from it is then as well.
bool WithinReach(const Model& model, const std::vector<Eigen::AlignedBox3f>& boxes,
                 const PoseLayer& layer, float reach) {
  const std::vector<Eigen::Affine3f> matrices = JointMatrices(model, PoseNodes(model, {&layer, 1}));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].isEmpty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const auto at = static_cast<Eigen::AlignedBox3f::CornerType>(corner);
      const Eigen::Vector3f placed = matrices[i] * boxes[i].corner(at);
      if (!(placed.cwiseAbs().maxCoeff() <= reach)) return false;
    }
  }
  return true;
}

void CheckClips(const Model& model, const ImportOptions& options) {
  const std::vector<Eigen::AlignedBox3f> boxes = BoxesOfJoints(model);
  // A joint may carry vertices that others hold back: thus the tenfold.
  const float reach = 10 * options.max_reach_m;
  for (std::size_t clip = 0; clip < model.clips.size(); ++clip) {
    const Clip& one = model.clips[clip];
    Require(std::isfinite(one.duration_s) && one.duration_s >= 0,
            "a clip's duration is not finite");
    for (const ClipChannel& channel : one.channels) {
      Require(IsIn(channel.node, model.nodes.size()), "a clip moves a node that does not exist");
      CheckCurve(channel.translations);
      CheckCurve(channel.rotations);
      CheckCurve(channel.scales);
    }
    if (one.channels.empty()) continue;
    for (int i = 0; i <= kTimesPerClip; ++i) {
      const double share = std::min(static_cast<double>(i) / kTimesPerClip, 0.999999);
      const PoseLayer layer{static_cast<int>(clip), share * one.duration_s, 1, -1};
      if (WithinReach(model, boxes, layer, reach)) continue;
      throw ImportError(
          fmt::format("its clip '{}' takes it further than {} m from its origin; check its unit "
                      "(metres) and its keys",
                      one.name, reach));
    }
  }
}

void CheckReach(const Model& model, const ImportOptions& options) {
  for (const Eigen::Vector3f& position : model.mesh.positions) {
    Require(position.allFinite(), "a node's transformation is not finite");
    if (position.cwiseAbs().maxCoeff() <= options.max_reach_m) continue;
    throw ImportError(
        fmt::format("a vertex at ({:.4g}, {:.4g}, {:.4g}) m is more than {} m from the model's "
                    "origin: check its unit (metres) and the scales of its nodes",
                    position.x(), position.y(), position.z(), options.max_reach_m));
  }
}

}  // namespace

void CheckModel(const Model& model, const ImportOptions& options) {
  Require(!model.mesh.triangles.empty(), "it has no triangles");
  Require(model.mesh.triangles.size() <= options.max_triangles, "it has too many triangles");
  CheckReach(model, options);
  CheckMesh(model);
  CheckSkeleton(model);
  CheckSurfaces(model.materials, model.textures, options);
  CheckColour(model, options);
  CheckClips(model, options);
}

}  // namespace aisle::sim
