#include "simulator/mesh/import.h"

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <numbers>

#include "simulator/mesh/confined_files.h"
#include "simulator/mesh/gltf_nodes.h"
#include "simulator/mesh/import_materials.h"
#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNodes = 100'000;
constexpr std::array<const char*, 4> kExtensions = {".glb", ".gltf", ".obj", ".dae"};

Eigen::Vector3f ToEigen(const aiVector3D& v) { return {v.x, v.y, v.z}; }
Eigen::Quaternionf ToEigen(const aiQuaternion& q) { return {q.w, q.x, q.y, q.z}; }

Eigen::Affine3f ToEigen(const aiMatrix4x4& m) {
  Eigen::Affine3f matrix = Eigen::Affine3f::Identity();
  matrix.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, 0, 0,
      0, 1;
  return matrix;
}

/// Leaves only the importers of the formats we accept: the others have known holes.
void KeepOwnFormats(Assimp::Importer* importer) {
  std::vector<Assimp::BaseImporter*> unwanted;
  for (std::size_t i = 0; i < importer->GetImporterCount(); ++i) {
    const std::string extensions =
        fmt::format(" {} ", importer->GetImporterInfo(i)->mFileExtensions);
    const bool wanted = std::ranges::any_of(kExtensions, [&](const char* extension) {
      return extensions.find(fmt::format(" {} ", extension + 1)) != std::string::npos;
    });
    if (!wanted) unwanted.push_back(importer->GetImporter(i));
  }
  for (Assimp::BaseImporter* one : unwanted) {
    importer->UnregisterLoader(one);
    delete one;  // unregistering hands it back to the caller
  }
}

/// Builds a Model from what assimp read, checking every number on the way.
class ModelBuilder {
 public:
  ModelBuilder(const aiScene& scene, const fs::path& file, const ImportOptions& options)
      : scene_(scene), file_(file), options_(options) {}

  Model Build() {
    model_.name = file_.stem().string();
    CountTriangles();
    AddNodes();
    AddClips();
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i] == nullptr) continue;  // the node that turns y-up to z-up
      for (unsigned k = 0; k < sources_[i]->mNumMeshes; ++k) {
        const unsigned mesh = sources_[i]->mMeshes[k];
        Require(mesh < scene_.mNumMeshes, "a node names a mesh that does not exist");
        AddMesh(*scene_.mMeshes[mesh], static_cast<int>(i));
      }
    }
    Require(!model_.mesh.triangles.empty(), "it has no triangles");
    ImportMaterials(scene_, file_, options_, &model_);
    for (const std::uint16_t material : model_.mesh.materials) {
      Require(material < model_.materials.size(), "a mesh names a material that does not exist");
    }
    const NodeFrames rest = PoseNodes(model_, {});
    SkinVertices(model_, JointMatrices(model_, rest), &model_.mesh.positions, &model_.mesh.normals);
    for (const Eigen::Vector3f& position : model_.mesh.positions) {
      Require(position.allFinite(), "a node's transformation is not finite");
    }
    return std::move(model_);
  }

 private:
  void Require(bool condition, const std::string& otherwise) const {
    if (!condition) throw ImportError(fmt::format("{}: {}", file_.string(), otherwise));
  }

  void CountTriangles() const {
    std::size_t count = 0;
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) count += scene_.mMeshes[i]->mNumFaces;
    Require(count <= options_.max_triangles,
            fmt::format("it has {} faces, the limit is {}", count, options_.max_triangles));
  }

  void AddNodes() {
    ModelNode top;
    if (options_.frame == ModelFrame::kZUp) {
      top.rest.rotation =
          Eigen::AngleAxisf(std::numbers::pi_v<float> / 2, Eigen::Vector3f::UnitX());
    }
    model_.nodes.push_back(top);
    sources_.push_back(nullptr);
    std::vector<std::pair<const aiNode*, int>> open = {{scene_.mRootNode, 0}};
    while (!open.empty()) {
      const auto [source, parent] = open.back();
      open.pop_back();
      Require(model_.nodes.size() < kMaxNodes, "it has too many nodes");
      aiVector3D scale, position;
      aiQuaternion rotation;
      source->mTransformation.Decompose(scale, rotation, position);
      ModelNode node{source->mName.C_Str(),
                     parent,
                     {ToEigen(position), ToEigen(rotation).normalized(), ToEigen(scale)}};
      const int index = static_cast<int>(model_.nodes.size());
      node_of_.emplace(node.name, index);
      model_.nodes.push_back(std::move(node));
      sources_.push_back(source);
      for (unsigned i = source->mNumChildren; i-- > 0;) {
        open.emplace_back(source->mChildren[i], index);
      }
    }
  }

  void AddClips() {
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) {
      const aiAnimation& from = *scene_.mAnimations[i];
      const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 1;
      Clip clip;
      clip.name = from.mName.C_Str();
      for (unsigned k = 0; k < from.mNumChannels; ++k) {
        const aiNodeAnim& source = *from.mChannels[k];
        const auto node = node_of_.find(source.mNodeName.C_Str());
        if (node == node_of_.end()) continue;
        ClipChannel channel;
        channel.node = node->second;
        AddKeys(source.mPositionKeys, source.mNumPositionKeys, ticks, &channel.translations);
        AddKeys(source.mRotationKeys, source.mNumRotationKeys, ticks, &channel.rotations);
        AddKeys(source.mScalingKeys, source.mNumScalingKeys, ticks, &channel.scales);
        clip.duration_s = std::max({clip.duration_s, LastTime(channel.translations),
                                    LastTime(channel.rotations), LastTime(channel.scales)});
        clip.channels.push_back(std::move(channel));
      }
      model_.clips.push_back(std::move(clip));
    }
  }

  template <class Key, class Value>
  void AddKeys(const Key* keys, unsigned count, double ticks,
               std::vector<std::pair<float, Value>>* to) const {
    for (unsigned i = 0; i < count; ++i) {
      const float time = static_cast<float>(keys[i].mTime / ticks);
      Value value = ToEigen(keys[i].mValue);
      bool finite = std::isfinite(time);
      if constexpr (std::is_same_v<Value, Eigen::Quaternionf>) {
        finite = finite && value.coeffs().allFinite() && value.norm() > 0;
        value.normalize();
      } else {
        finite = finite && value.allFinite();
      }
      Require(finite, "an animation key is not finite");
      Require(to->empty() || time >= to->back().first, "animation keys are not in order of time");
      to->emplace_back(time, value);
    }
  }

  template <class Value>
  static float LastTime(const std::vector<std::pair<float, Value>>& keys) {
    return keys.empty() ? 0 : keys.back().first;
  }

  void AddMesh(const aiMesh& mesh, int node) {
    const std::size_t first = model_.bind_positions.size();
    AddVertices(mesh);
    AddTriangles(mesh, first);
    if (mesh.HasBones()) {
      AddWeights(mesh, first);
    } else {
      FollowNode(mesh, node);
    }
    if (!mesh.HasNormals()) ComputeNormals(first);
  }

  void AddVertices(const aiMesh& mesh) {
    const bool has_uvs = mesh.HasTextureCoords(0);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const Eigen::Vector3f position = ToEigen(mesh.mVertices[i]);
      Require(position.allFinite(), "a vertex is not finite");
      Eigen::Vector3f normal =
          mesh.HasNormals() ? ToEigen(mesh.mNormals[i]) : Eigen::Vector3f::Zero();
      if (!normal.allFinite()) normal.setZero();
      const Eigen::Vector3f uv =
          has_uvs ? ToEigen(mesh.mTextureCoords[0][i]) : Eigen::Vector3f::Zero();
      Require(uv.allFinite(), "a texture coordinate is not finite");
      model_.bind_positions.push_back(position);
      model_.bind_normals.push_back(normal);
      model_.mesh.uvs.push_back(uv.head<2>());
    }
  }

  /// Polygons become fans; points and lines are left out.
  void AddTriangles(const aiMesh& mesh, std::size_t first) {
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        Require(face.mIndices[k] < mesh.mNumVertices, "a face names a vertex that does not exist");
      }
      const auto index = [&](unsigned k) {
        return static_cast<std::uint32_t>(first + face.mIndices[k]);
      };
      for (unsigned k = 2; k < face.mNumIndices; ++k) {
        model_.mesh.triangles.push_back({index(0), index(k - 1), index(k)});
        model_.mesh.materials.push_back(static_cast<std::uint16_t>(mesh.mMaterialIndex));
      }
    }
    Require(model_.mesh.triangles.size() <= options_.max_triangles,
            fmt::format("it has more than {} triangles", options_.max_triangles));
  }

  std::uint16_t AddJoint(int node, const Eigen::Affine3f& bind_to_node) {
    Require(model_.joints.size() < 65535, "it has too many joints");
    Require(bind_to_node.matrix().allFinite(), "a joint's bind matrix is not finite");
    model_.joints.push_back({node, bind_to_node});
    return static_cast<std::uint16_t>(model_.joints.size() - 1);
  }

  void FollowNode(const aiMesh& mesh, int node) {
    const std::uint16_t joint = AddJoint(node, Eigen::Affine3f::Identity());
    const VertexWeights weights{{joint, 0, 0, 0}, {1, 0, 0, 0}};
    model_.weights.insert(model_.weights.end(), mesh.mNumVertices, weights);
  }

  void AddWeights(const aiMesh& mesh, std::size_t first) {
    std::vector<std::vector<std::pair<float, std::uint16_t>>> pulls(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      const aiBone& bone = *mesh.mBones[i];
      const auto node = node_of_.find(bone.mName.C_Str());
      Require(node != node_of_.end(), "a bone names a node that does not exist");
      const std::uint16_t joint = AddJoint(node->second, ToEigen(bone.mOffsetMatrix));
      for (unsigned k = 0; k < bone.mNumWeights; ++k) {
        const auto& [vertex, weight] = bone.mWeights[k];
        Require(vertex < mesh.mNumVertices, "a bone weighs a vertex that does not exist");
        Require(std::isfinite(weight), "a bone weight is not finite");
        if (weight > 0) pulls[vertex].emplace_back(weight, joint);
      }
    }
    for (auto& pull : pulls) {
      Require(!pull.empty(), "a skinned vertex follows no bone");
      std::stable_sort(pull.begin(), pull.end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
      pull.resize(std::min<std::size_t>(pull.size(), 4));
      float sum = 0;
      for (const auto& [weight, joint] : pull) sum += weight;
      VertexWeights weights;
      for (std::size_t k = 0; k < pull.size(); ++k) {
        weights.weights[k] = pull[k].first / sum;
        weights.joints[k] = pull[k].second;
      }
      model_.weights.push_back(weights);
    }
    Require(model_.weights.size() == first + mesh.mNumVertices, "its bone weights do not add up");
  }

  /// Area-weighted normals for a mesh that came without.
  void ComputeNormals(std::size_t first) {
    for (const auto& [a, b, c] : model_.mesh.triangles) {
      if (a < first) continue;
      const auto& p = model_.bind_positions;
      const Eigen::Vector3f normal = (p[b] - p[a]).cross(p[c] - p[a]);
      for (const std::uint32_t i : {a, b, c}) model_.bind_normals[i] += normal;
    }
    for (std::size_t i = first; i < model_.bind_normals.size(); ++i) {
      Eigen::Vector3f& normal = model_.bind_normals[i];
      normal = normal.norm() > 0 ? Eigen::Vector3f(normal.normalized()) : Eigen::Vector3f::UnitY();
    }
  }

  const aiScene& scene_;
  const fs::path& file_;
  const ImportOptions& options_;
  Model model_;
  std::vector<const aiNode*> sources_;  ///< per model node
  std::map<std::string, int> node_of_;
};

/// Folders and sizes in order before a parser sees the file.
void CheckFile(const fs::path& file, const ImportOptions& options) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::ranges::find(kExtensions, extension) == kExtensions.end()) {
    throw ImportError(file.string() + ": models are .glb, .gltf, .obj or .dae files");
  }
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) {
    throw ImportError(file.string() + ": there is no such file");
  }
  if (!IsInside(file, options.root)) {
    throw ImportError(fmt::format("{}: it lies outside {}", file.string(), options.root.string()));
  }
  if (fs::file_size(file) > options.max_file_bytes) {
    throw ImportError(
        fmt::format("{}: it is larger than {} bytes", file.string(), options.max_file_bytes));
  }
  if (extension != ".glb" && extension != ".gltf") return;
  if (const std::string error = GltfNodeError(file); !error.empty()) {
    throw ImportError(
        fmt::format("{}: {}; the nodes of a model must form a tree", file.string(), error));
  }
}

}  // namespace

Model ImportModel(const fs::path& file, const ImportOptions& given) {
  ImportOptions options = given;
  if (options.root.empty()) options.root = fs::absolute(file).parent_path();
  CheckFile(file, options);
  Assimp::Importer importer;
  KeepOwnFormats(&importer);
  importer.SetIOHandler(new ConfinedFiles(options.root, options.max_file_bytes));  // takes it over
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(file.string(), aiProcess_FlipUVs);
  } catch (const std::exception& error) {
    throw ImportError(fmt::format("{}: {}", file.string(), error.what()));
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw ImportError(
        fmt::format("{}: it cannot be read: {}", file.string(), importer.GetErrorString()));
  }
  return ModelBuilder(*scene, file, options).Build();
}

int Model::FindNode(const std::string& name) const {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

int Model::FindClip(const std::string& name) const {
  for (std::size_t i = 0; i < clips.size(); ++i) {
    if (clips[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace aisle::sim
