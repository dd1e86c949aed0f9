#include "simulator/mesh/assimp_materials.h"

#include <assimp/material.h>

#include "simulator/mesh/confined_files.h"
#include "simulator/mesh/texture_store.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> TextureBytes(const aiScene& scene, const std::string& path,
                                       const fs::path& file, const ImportOptions& options) {
  if (const aiTexture* embedded = scene.GetEmbeddedTexture(path.c_str())) {
    if (embedded->mHeight != 0) throw ImportError("a raw embedded texture");
    const auto* data = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
    return {data, data + embedded->mWidth};
  }
  std::string relative = path;
  std::replace(relative.begin(), relative.end(), '\\', '/');
  const fs::path image = file.parent_path() / relative;
  std::error_code failed;
  if (!fs::is_regular_file(image, failed)) {
    throw ImportError(fmt::format("texture {} is missing", relative));
  }
  if (!IsInside(image, options.root) || fs::file_size(image, failed) > options.max_file_bytes) {
    throw ImportError(
        fmt::format("texture {} lies outside {} or is too large", relative, options.root.string()));
  }
  return ReadBytes(image);
}

/// A colour of the material in the wanted band, `otherwise` where it has none.
float ColorOf(const aiMaterial& material, const char* key, unsigned type, unsigned index, Band band,
              float otherwise) {
  aiColor4D color;
  if (material.Get(key, type, index, color) != aiReturn_SUCCESS) return otherwise;
  const float value = GreyOf(Eigen::Vector3f(color.r, color.g, color.b), band);
  return std::isfinite(value) ? std::max(value, 0.0f) : otherwise;
}

}  // namespace

void AddAssimpMaterials(const aiScene& scene, const fs::path& file, bool is_collada,
                        const ImportOptions& options, Model* model) {
  TextureStore textures(options, model);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial& from = *scene.mMaterials[i];
    Material material;
    material.name = from.GetName().C_Str();
    material.albedo = ColorOf(from, AI_MATKEY_COLOR_DIFFUSE, options.band, 0.5f);
    material.emission = ColorOf(from, AI_MATKEY_COLOR_EMISSIVE, options.band, 0);
    aiString path;
    if (from.GetTexture(aiTextureType_DIFFUSE, 0, &path) == aiReturn_SUCCESS) {
      const std::string name = path.C_Str();
      material.albedo_texture =
          textures.Add(name, false, [&] { return TextureBytes(scene, name, file, options); });
    }
    if (is_collada && material.albedo_texture >= 0) material.albedo = 1;
    material.albedo = std::min(material.albedo, 1.0f);
    model->materials.push_back(material);
  }
  if (model->materials.empty()) model->materials.push_back({});
}

}  // namespace aisle::sim
