#include "simulator/mesh/import_assimp.h"

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "simulator/mesh/assimp_left_out.h"
#include "simulator/mesh/assimp_materials.h"
#include "simulator/mesh/bands.h"
#include "simulator/mesh/confined_files.h"
#include "simulator/mesh/model_parts.h"
#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

void Require(bool condition, const std::string& otherwise) {
  if (!condition) throw ImportError(otherwise);
}

Eigen::Vector3f ToEigen(const aiVector3D& v) { return {v.x, v.y, v.z}; }
Eigen::Quaternionf ToEigen(const aiQuaternion& q) { return {q.w, q.x, q.y, q.z}; }

Eigen::Affine3f ToEigen(const aiMatrix4x4& m) {
  Eigen::Affine3f matrix = Eigen::Affine3f::Identity();
  matrix.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, 0, 0,
      0, 1;
  return matrix;
}

/// Translation, rotation and scale of a node.
NodePose PoseOf(const aiNode& node) {
  aiVector3D scale, position;
  aiQuaternion rotation;
  node.mTransformation.Decompose(scale, rotation, position);
  const NodePose pose{ToEigen(position), ToEigen(rotation).normalized(), ToEigen(scale)};
  const Eigen::Affine3f given = ToEigen(node.mTransformation);
  if (!IsComposedOf(given.matrix(), pose)) {
    throw ImportError(fmt::format(
        "node '{}' is not made of translation, rotation and scale; apply shear before the export",
        node.mName.C_Str()));
  }
  return pose;
}

/// Leaves only the importer of the format the file is in: the others have known holes.
void KeepImporterOf(ModelFormat format, Assimp::Importer* importer) {
  const std::string wanted = format == ModelFormat::kObj ? "obj" : "dae";
  std::vector<Assimp::BaseImporter*> unwanted;
  for (std::size_t i = 0; i < importer->GetImporterCount(); ++i) {
    const std::string extensions =
        fmt::format(" {} ", importer->GetImporterInfo(i)->mFileExtensions);
    if (extensions.find(fmt::format(" {} ", wanted)) == std::string::npos) {
      unwanted.push_back(importer->GetImporter(i));
    }
  }
  for (Assimp::BaseImporter* one : unwanted) {
    importer->UnregisterLoader(one);
    delete one;  // unregistering hands it back to the caller
  }
}

/// Adds what assimp read to a model, checking every number on the way.
class SceneReader {
 public:
  SceneReader(const aiScene& scene, const ImportOptions& options, Model* model)
      : scene_(scene), options_(options), model_(model) {}

  void Read() {
    std::size_t faces = 0;
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) faces += scene_.mMeshes[i]->mNumFaces;
    Require(faces <= options_.max_triangles,
            fmt::format("it has {} faces, the limit is {}", faces, options_.max_triangles));
    AddNodes();
    rest_ = PoseNodes(*model_, {});
    AddClips();
    for (const auto& [source, node] : sources_) {
      for (unsigned k = 0; k < source->mNumMeshes; ++k) {
        Require(source->mMeshes[k] < scene_.mNumMeshes, "a node names a mesh that does not exist");
        AddPart(PartOf(*scene_.mMeshes[source->mMeshes[k]], node), options_, model_);
      }
    }
  }

 private:
  void AddNodes() {
    std::vector<std::pair<const aiNode*, int>> open = {{scene_.mRootNode, 0}};
    while (!open.empty()) {
      const auto [source, parent] = open.back();
      open.pop_back();
      Require(model_->nodes.size() < kMostModelNodes, "it has too many nodes");
      const int index = static_cast<int>(model_->nodes.size());
      nodes_of_[source->mName.C_Str()].push_back(index);
      model_->nodes.push_back({source->mName.C_Str(), parent, PoseOf(*source)});
      sources_.emplace_back(source, index);
      for (unsigned i = source->mNumChildren; i-- > 0;) {
        open.emplace_back(source->mChildren[i], index);
      }
    }
  }

  /// The one node of that name; -1 if there is none.
  int NodeOf(const aiString& name) const {
    const auto found = nodes_of_.find(name.C_Str());
    if (found == nodes_of_.end()) return -1;
    Require(found->second.size() == 1,
            fmt::format("{} nodes are named '{}', and joints or animations mean one of them; give "
                        "each its own name, or save it as .glb",
                        found->second.size(), name.C_Str()));
    return found->second.front();
  }

  void AddClips() {
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) {
      const aiAnimation& from = *scene_.mAnimations[i];
      const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 1;
      Clip clip;
      clip.name = from.mName.C_Str();
      for (unsigned k = 0; k < from.mNumChannels; ++k) {
        const aiNodeAnim& source = *from.mChannels[k];
        ClipChannel channel;
        channel.node = NodeOf(source.mNodeName);
        if (channel.node < 0) continue;
        AddKeys(source.mPositionKeys, source.mNumPositionKeys, ticks, &channel.translations.keys);
        AddKeys(source.mRotationKeys, source.mNumRotationKeys, ticks, &channel.rotations.keys);
        AddKeys(source.mScalingKeys, source.mNumScalingKeys, ticks, &channel.scales.keys);
        clip.duration_s =
            std::max({clip.duration_s, LastTime(channel.translations.keys),
                      LastTime(channel.rotations.keys), LastTime(channel.scales.keys)});
        clip.channels.push_back(std::move(channel));
      }
      model_->clips.push_back(std::move(clip));
    }
  }

  template <class Key, class Value>
  static void AddKeys(const Key* keys, unsigned count, double ticks,
                      std::vector<std::pair<float, Value>>* to) {
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

  MeshPart PartOf(const aiMesh& mesh, int node) const {
    MeshPart part;
    part.node = node;
    part.material = mesh.mMaterialIndex;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      part.positions.push_back(ToEigen(mesh.mVertices[i]));
      if (mesh.HasNormals()) part.normals.push_back(ToEigen(mesh.mNormals[i]));
      if (mesh.HasTextureCoords(0)) {
        part.uvs.push_back(ToEigen(mesh.mTextureCoords[0][i]).head<2>());
      }
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {  // polygons become fans
      const aiFace& face = mesh.mFaces[i];
      for (unsigned k = 2; k < face.mNumIndices; ++k) {
        part.triangles.push_back({face.mIndices[0], face.mIndices[k - 1], face.mIndices[k]});
      }
    }
    if (mesh.HasBones()) {
      AddBones(mesh, &part);
    } else {
      part.mirrored = rest_[static_cast<std::size_t>(node)].linear().determinant() < 0;
    }
    return part;
  }

  void AddBones(const aiMesh& mesh, MeshPart* part) const {
    part->pulls.resize(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      const aiBone& bone = *mesh.mBones[i];
      const int node = NodeOf(bone.mName);
      Require(node >= 0, "a bone names a node that does not exist");
      part->joints.push_back({node, ToEigen(bone.mOffsetMatrix)});
      for (unsigned k = 0; k < bone.mNumWeights; ++k) {
        const auto& [vertex, weight] = bone.mWeights[k];
        Require(vertex < mesh.mNumVertices, "a bone weighs a vertex that does not exist");
        part->pulls[vertex].emplace_back(weight, static_cast<std::uint16_t>(i));
      }
    }
  }

  const aiScene& scene_;
  const ImportOptions& options_;
  Model* model_;
  NodeFrames rest_;
  std::vector<std::pair<const aiNode*, int>> sources_;  ///< in order, with their model nodes
  std::map<std::string, std::vector<int>> nodes_of_;
};

}  // namespace

void AddAssimpModel(const fs::path& file, ModelFormat format, const ImportOptions& options,
                    Model* model) {
  Assimp::Importer importer;
  KeepImporterOf(format, &importer);
  // Otherwise the file's own axis is turned to y, and then the one that is asked for.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION,
                           options.up != UpAxis::kAsStated);
  importer.SetIOHandler(new ConfinedFiles(options.root, options.max_file_bytes));  // takes it over
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(file.string(), aiProcess_FlipUVs);
  } catch (const std::exception& error) {
    throw ImportError(fmt::format("it cannot be read: {}", error.what()));
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw ImportError(fmt::format("it cannot be read: {}", importer.GetErrorString()));
  }
  SceneReader(*scene, options, model).Read();
  ForEachBand(options, model, [&](const ImportOptions& band) {
    AddAssimpMaterials(*scene, file, format == ModelFormat::kCollada, band, model);
  });
  model->left_out = LeftOutOf(*scene);
}

}  // namespace aisle::sim
