#include "simulator/mesh/gltf_meshes.h"

#include "simulator/mesh/gltf_accessor.h"
#include "simulator/mesh/gltf_materials.h"
#include "simulator/mesh/model_parts.h"
#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

enum Mode : std::size_t { kTriangles = 4, kStrip = 5, kFan = 6 };

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Triangles over a list of corners (glTF 2.0, 3.7.2.1).
Triangles TrianglesOver(const std::vector<std::uint32_t>& corners, std::size_t mode) {
  Triangles triangles;
  const std::size_t step = mode == kTriangles ? 3 : 1;
  for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
    if (mode == kFan) {
      triangles.push_back({corners[0], corners[i + 1], corners[i + 2]});
    } else if (mode == kStrip && i % 2 == 1) {
      triangles.push_back({corners[i + 1], corners[i], corners[i + 2]});
    } else {
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
  }
  return triangles;
}

class MeshReader {
 public:
  MeshReader(const GltfDocument& document, const GltfNodes& nodes, const ImportOptions& options,
             Model* model)
      : document_(document),
        nodes_(nodes),
        options_(options),
        rest_(PoseNodes(*model, {})),
        model_(model) {}

  void AddNode(std::size_t index) {
    const GltfValue root = document_.root();
    const GltfValue node = root.Item("nodes", index);
    const auto mesh_index = node.IndexBelow("mesh", root.Count("meshes"), "mesh");
    if (!mesh_index) return;
    const auto skin = node.IndexBelow("skin", root.Count("skins"), "skin");
    const GltfValue mesh = root.Item("meshes", *mesh_index);
    CheckMorphs(node.Has("weights") ? node : mesh);
    if (mesh.Count("primitives") == 0) mesh.Fail("'primitives' are missing");
    for (const GltfValue& primitive : mesh.Items("primitives")) {
      const std::size_t mode = primitive.Whole("mode", kTriangles);
      if (mode > kFan) primitive.Fail(fmt::format("mode {} does not exist", mode));
      if (mode < kTriangles) continue;
      AddPrimitive(primitive, mode, nodes_.of_file[index], skin);
    }
  }

 private:
  static void CheckMorphs(const GltfValue& weighted) {
    const std::size_t count = weighted.Count("weights");
    for (const float weight : weighted.Numbers("weights", count)) {
      if (weight == 0) continue;
      weighted.Get("weights").Fail(
          "morph targets are not read, and these have weight; apply the shape before the export");
    }
  }

  /// The accessor of an attribute, if the primitive has it.
  std::optional<std::size_t> Attribute(const GltfValue& primitive, const std::string& name) const {
    return primitive.Get("attributes")
        .IndexBelow(name.c_str(), document_.root().Count("accessors"), "accessor");
  }

  /// An attribute of all `count` vertices; empty when the primitive has none.
  std::optional<GltfArray<float>> Floats(const GltfValue& primitive, const std::string& name,
                                         const char* type, std::size_t count) const {
    const auto index = Attribute(primitive, name);
    if (!index) return std::nullopt;
    GltfArray<float> array = ReadFloats(document_, *index, {type, MaxCount()});
    RequireCount(primitive, name, array.count, count);
    return array;
  }

  static void RequireCount(const GltfValue& primitive, const std::string& name, std::size_t is,
                           std::size_t count) {
    if (is == count) return;
    primitive.Fail(fmt::format("{} has {} elements, POSITION has {}", name, is, count));
  }

  std::size_t MaxCount() const { return 3 * options_.max_triangles; }

  void AddPrimitive(const GltfValue& primitive, std::size_t mode, int node,
                    std::optional<std::size_t> skin) {
    const auto position = Attribute(primitive, "POSITION");
    if (!position) primitive.Fail("attribute POSITION is missing");
    MeshPart part;
    part.node = node;
    const GltfArray<float> positions = ReadFloats(document_, *position, {"VEC3", MaxCount()});
    for (std::size_t i = 0; i < positions.count; ++i) {
      part.positions.emplace_back(positions[i][0], positions[i][1], positions[i][2]);
    }
    if (const auto normals = Floats(primitive, "NORMAL", "VEC3", positions.count)) {
      for (std::size_t i = 0; i < normals->count; ++i) {
        part.normals.emplace_back((*normals)[i][0], (*normals)[i][1], (*normals)[i][2]);
      }
    }
    const std::size_t materials = document_.root().Count("materials");
    part.material = primitive.IndexBelow("material", materials, "material").value_or(materials);
    const std::size_t set = part.material < materials
                                ? CoordinatesOf(document_.root().Item("materials", part.material))
                                : 0;
    const std::string coordinates = fmt::format("TEXCOORD_{}", set);
    if (const auto uvs = Floats(primitive, coordinates, "VEC2", positions.count)) {
      for (std::size_t i = 0; i < uvs->count; ++i) {
        // Turned over twice, as results so far were measured with them: v to within 6e-8.
        part.uvs.emplace_back((*uvs)[i][0], 1 - (1 - (*uvs)[i][1]));
      }
    }
    part.triangles = TrianglesOver(Corners(primitive, positions.count), mode);
    if (skin && Attribute(primitive, "JOINTS_0")) {
      ReadSkin(primitive, document_.root().Item("skins", *skin), &part);
    } else {
      part.mirrored = rest_[static_cast<std::size_t>(node)].linear().determinant() < 0;
    }
    AddPart(part, options_, model_);
  }

  std::vector<std::uint32_t> Corners(const GltfValue& primitive, std::size_t vertices) const {
    const auto index =
        primitive.IndexBelow("indices", document_.root().Count("accessors"), "accessor");
    if (index) {
      std::vector<std::uint32_t> corners =
          ReadIndices(document_, *index, {"SCALAR", MaxCount()}).numbers;
      for (const std::uint32_t corner : corners) {
        if (corner < vertices) continue;
        primitive.Get("indices").Fail(fmt::format(
            "a face names vertex {}, which does not exist; there are {}", corner, vertices));
      }
      return corners;
    }
    std::vector<std::uint32_t> corners(vertices);
    for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
    return corners;
  }

  void ReadSkin(const GltfValue& primitive, const GltfValue& skin, MeshPart* part) const {
    part->joints = JointsOf(skin);
    part->pulls.resize(part->positions.size());
    for (int set = 0;; ++set) {
      const std::string joints_name = fmt::format("JOINTS_{}", set);
      const auto joints_index = Attribute(primitive, joints_name);
      if (!joints_index) break;
      const auto joints = ReadIndices(document_, *joints_index, {"VEC4", MaxCount()});
      RequireCount(primitive, joints_name, joints.count, part->positions.size());
      const auto weights =
          Floats(primitive, fmt::format("WEIGHTS_{}", set), "VEC4", part->positions.size());
      if (!weights) primitive.Fail(fmt::format("{} has no WEIGHTS_{}", joints_name, set));
      for (std::size_t i = 0; i < joints.numbers.size(); ++i) {
        const std::uint32_t joint = joints.numbers[i];
        if (joint >= part->joints.size()) {
          primitive.Fail(fmt::format("{}: vertex {} follows joint {}, its skin has {}", joints_name,
                                     i / 4, joint, part->joints.size()));
        }
        part->pulls[i / 4].emplace_back(weights->numbers[i], static_cast<std::uint16_t>(joint));
      }
    }
  }

  std::vector<ModelJoint> JointsOf(const GltfValue& skin) const {
    std::vector<ModelJoint> joints;
    for (const GltfValue& joint : skin.Items("joints")) {
      const std::size_t node = joint.IndexBelow(nodes_.of_file.size(), "node");
      if (nodes_.of_file[node] < 0) {
        joint.Fail(fmt::format("joint node {} is not in the scene; add its root to it", node));
      }
      joints.push_back({nodes_.of_file[node], Eigen::Affine3f::Identity()});
    }
    const auto bind =
        skin.IndexBelow("inverseBindMatrices", document_.root().Count("accessors"), "accessor");
    if (!bind) return joints;
    const GltfArray<float> matrices = ReadFloats(document_, *bind, {"MAT4", 1u << 16});
    if (matrices.count < joints.size()) {
      skin.Fail(fmt::format("{} joints have only {} inverse bind matrices", joints.size(),
                            matrices.count));
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
      joints[i].bind_to_node.matrix().topRows<3>() =
          Eigen::Map<const Eigen::Matrix4f>(matrices[i]).topRows<3>();
    }
    return joints;
  }

  const GltfDocument& document_;
  const GltfNodes& nodes_;
  const ImportOptions& options_;
  NodeFrames rest_;
  Model* model_;
};

}  // namespace

void AddGltfMeshes(const GltfDocument& document, const GltfNodes& nodes,
                   const ImportOptions& options, Model* model) {
  MeshReader reader(document, nodes, options, model);
  for (const std::size_t node : nodes.in_order) reader.AddNode(node);
}

}  // namespace aisle::sim
