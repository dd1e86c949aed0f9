#include "simulator/mesh/model_parts.h"

#include "simulator/mesh/check_model.h"
#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

constexpr std::size_t kMaxIndex = 65535;  ///< joints and materials are counted in 16 bits

void Require(bool condition, const char* otherwise) {
  if (!condition) throw ImportError(otherwise);
}

void AddVertices(const MeshPart& part, Model* model) {
  const std::size_t count = part.positions.size();
  Require(part.normals.empty() || part.normals.size() == count,
          "a mesh has not as many normals as positions");
  Require(part.uvs.empty() || part.uvs.size() == count,
          "a mesh has not as many texture coordinates as positions");
  for (std::size_t i = 0; i < count; ++i) {
    Require(part.positions[i].allFinite(), "a vertex is not finite");
    Eigen::Vector3f normal = part.normals.empty() ? Eigen::Vector3f::Zero() : part.normals[i];
    if (!normal.allFinite()) normal.setZero();
    const Eigen::Vector2f uv = part.uvs.empty() ? Eigen::Vector2f::Zero() : part.uvs[i];
    Require(uv.allFinite(), "a texture coordinate is not finite");
    model->bind_positions.push_back(part.positions[i]);
    model->bind_normals.push_back(normal);
    model->mesh.uvs.push_back(uv);
  }
}

void AddTriangles(const MeshPart& part, std::size_t first, Model* model) {
  Require(part.material < kMaxIndex, "it has too many materials");
  for (const auto& triangle : part.triangles) {
    std::array<std::uint32_t, 3> moved{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (triangle[k] >= part.positions.size()) {
        throw ImportError(fmt::format("a face names vertex {}, which does not exist; there are {}",
                                      triangle[k], part.positions.size()));
      }
      moved[k] = static_cast<std::uint32_t>(first + triangle[k]);
    }
    model->mesh.triangles.push_back(moved);
    model->mesh.materials.push_back(static_cast<std::uint16_t>(part.material));
  }
}

VertexWeights WeightsOf(std::vector<std::pair<float, std::uint16_t>> pull, std::size_t first_joint,
                        std::size_t joints) {
  for (const auto& [weight, joint] : pull) {
    Require(std::isfinite(weight) && weight >= 0, "a joint's weight is negative or not finite");
    Require(joint < joints, "a vertex follows a joint that does not exist");
  }
  std::erase_if(pull, [](const auto& one) { return one.first == 0; });
  Require(!pull.empty(), "a skinned vertex follows no joint: all its weights are 0");
  std::stable_sort(pull.begin(), pull.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  pull.resize(std::min<std::size_t>(pull.size(), 4));
  float sum = 0;
  for (const auto& [weight, joint] : pull) sum += weight;
  Require(std::isfinite(sum), "the weights of a vertex are too large");
  VertexWeights weights;
  for (std::size_t k = 0; k < pull.size(); ++k) {
    weights.weights[k] = pull[k].first / sum;
    weights.joints[k] = static_cast<std::uint16_t>(first_joint + pull[k].second);
  }
  return weights;
}

void AddWeights(const MeshPart& part, Model* model) {
  const std::size_t first = model->joints.size();
  Require(first + std::max<std::size_t>(part.joints.size(), 1) < kMaxIndex,
          "it has too many joints");
  if (part.joints.empty()) {
    model->joints.push_back({part.node, Eigen::Affine3f::Identity()});
    const VertexWeights rigid{{static_cast<std::uint16_t>(first), 0, 0, 0}, {1, 0, 0, 0}};
    model->weights.insert(model->weights.end(), part.positions.size(), rigid);
    return;
  }
  for (const ModelJoint& joint : part.joints) {
    Require(joint.bind_to_node.matrix().allFinite(), "a joint's bind matrix is not finite");
    model->joints.push_back(joint);
  }
  Require(part.pulls.size() == part.positions.size(), "a mesh has not as many weights as vertices");
  for (const auto& pull : part.pulls) {
    model->weights.push_back(WeightsOf(pull, first, part.joints.size()));
  }
}

/// Area-weighted normals for the vertices of a part that came without.
void ComputeNormals(std::size_t first_vertex, std::size_t first_triangle, Model* model) {
  constexpr float kNone = 1e-6f;  // shorter ones say no direction
  const std::span normals = std::span(model->bind_normals).subspan(first_vertex);
  const auto is_none = [](const Eigen::Vector3f& normal) { return !(normal.norm() >= kNone); };
  if (std::ranges::none_of(normals, is_none)) return;
  const auto& p = model->bind_positions;
  std::vector<Eigen::Vector3f> sums(normals.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = first_triangle; i < model->mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = model->mesh.triangles[i];
    const Eigen::Vector3f normal = (p[b] - p[a]).cross(p[c] - p[a]);
    for (const std::uint32_t k : {a, b, c}) sums[k - first_vertex] += normal;
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!is_none(normals[i])) continue;
    normals[i] =
        sums[i].norm() > 0 ? Eigen::Vector3f(sums[i].normalized()) : Eigen::Vector3f::UnitY();
  }
}

}  // namespace

void AddPart(const MeshPart& part, const ImportOptions& options, Model* model) {
  const std::size_t first_vertex = model->bind_positions.size();
  const std::size_t first_triangle = model->mesh.triangles.size();
  if (first_triangle + part.triangles.size() > options.max_triangles) {
    throw ImportError(fmt::format("it has more than {} triangles", options.max_triangles));
  }
  if (first_vertex + part.positions.size() > 3 * options.max_triangles) {
    throw ImportError(fmt::format("it has more than {} vertices", 3 * options.max_triangles));
  }
  AddVertices(part, model);
  AddTriangles(part, first_vertex, model);
  AddWeights(part, model);
  ComputeNormals(first_vertex, first_triangle, model);
  if (!part.mirrored) return;
  for (std::size_t i = first_triangle; i < model->mesh.triangles.size(); ++i) {
    std::swap(model->mesh.triangles[i][1], model->mesh.triangles[i][2]);
  }
}

void FinishModel(const ImportOptions& options, Model* model) {
  Require(!model->mesh.triangles.empty(), "it has no triangles");
  const NodeFrames rest = PoseNodes(*model, {});
  SkinVertices(*model, JointMatrices(*model, rest), &model->mesh.positions, &model->mesh.normals);
  CheckModel(*model, options);
}

}  // namespace aisle::sim
