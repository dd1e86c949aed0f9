#include "simulator/mesh/import_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "simulator/mesh/confined_files.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr float kDielectricF0 = 0.04f;

std::vector<std::uint8_t> ReadBytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Loads each image once for each use.
class TextureLoader {
 public:
  TextureLoader(const aiScene& scene, const fs::path& file, const ImportOptions& options,
                Model* model)
      : scene_(scene), file_(file), options_(options), model_(model) {}

  /// Index of the material's texture of that type; -1 if it has none.
  int Load(const aiMaterial& material, aiTextureType type, bool is_normal_map) {
    aiString path;
    if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS) return -1;
    const auto key = std::make_pair(std::string(path.C_Str()), is_normal_map);
    const auto known = known_.find(key);
    if (known != known_.end()) return known->second;
    const cv::Mat image = DecodeImage(Bytes(path), file_.string() + ": texture " + key.first,
                                      options_.max_texture_px);
    const int index = static_cast<int>(model_->textures.size());
    model_->textures.push_back(
        {fs::path(key.first).filename().string(),
         is_normal_map ? Rgb(image) : cv::Mat(GreyOf(image, options_.band))});
    known_[key] = index;
    return index;
  }

 private:
  std::vector<std::uint8_t> Bytes(const aiString& path) const {
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(path.C_Str())) {
      if (embedded->mHeight != 0) throw ImportError(file_.string() + ": a raw embedded texture");
      const auto* data = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
      return {data, data + embedded->mWidth};
    }
    std::string relative = path.C_Str();
    std::replace(relative.begin(), relative.end(), '\\', '/');
    const fs::path image = file_.parent_path() / relative;
    if (!fs::exists(image)) {
      throw ImportError(fmt::format("{}: texture {} is missing", file_.string(), relative));
    }
    if (!IsInside(image, options_.root) || fs::file_size(image) > options_.max_file_bytes) {
      throw ImportError(fmt::format("{}: texture {} lies outside {} or is too large",
                                    file_.string(), relative, options_.root.string()));
    }
    return ReadBytes(image);
  }

  static cv::Mat Rgb(const cv::Mat& image) {
    cv::Mat rgb;
    const int channels = image.channels();
    cv::cvtColor(image, rgb,
                 channels == 1   ? cv::COLOR_GRAY2RGB
                 : channels == 4 ? cv::COLOR_BGRA2RGB
                                 : cv::COLOR_BGR2RGB);
    return rgb;
  }

  const aiScene& scene_;
  const fs::path& file_;
  const ImportOptions& options_;
  Model* model_;
  std::map<std::pair<std::string, bool>, int> known_;
};

/// A colour of the material in the wanted band, `otherwise` where it has none.
float ColorOf(const aiMaterial& material, const char* key, unsigned type, unsigned index, Band band,
              float otherwise) {
  aiColor4D color;
  if (material.Get(key, type, index, color) != aiReturn_SUCCESS) return otherwise;
  const float value = GreyOf(Eigen::Vector3f(color.r, color.g, color.b), band);
  return std::isfinite(value) ? std::max(value, 0.0f) : otherwise;
}

float NumberOf(const aiMaterial& material, const char* key, unsigned type, unsigned index,
               float otherwise) {
  float value = otherwise;
  if (material.Get(key, type, index, value) != aiReturn_SUCCESS) return otherwise;
  return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : otherwise;
}

}  // namespace

void ImportMaterials(const aiScene& scene, const fs::path& file, const ImportOptions& options,
                     Model* model) {
  TextureLoader textures(scene, file, options, model);
  const bool is_gltf = file.extension() == ".glb" || file.extension() == ".gltf";
  const bool is_collada = file.extension() == ".dae" || file.extension() == ".DAE";
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial& from = *scene.mMaterials[i];
    Material material;
    material.name = from.GetName().C_Str();
    material.albedo = ColorOf(from, AI_MATKEY_COLOR_DIFFUSE, options.band, 0.5f);
    material.albedo_texture = textures.Load(from, aiTextureType_DIFFUSE, false);
    material.emission = ColorOf(from, AI_MATKEY_COLOR_EMISSIVE, options.band, 0);
    if (is_gltf) {  // metallic-roughness, one band of it
      material.albedo = ColorOf(from, AI_MATKEY_BASE_COLOR, options.band, 1);
      material.albedo_texture = textures.Load(from, aiTextureType_BASE_COLOR, false);
      material.normal_texture = textures.Load(from, aiTextureType_NORMALS, true);
      from.Get(AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0), material.normal_scale);
      if (!std::isfinite(material.normal_scale)) material.normal_scale = 1;
      const float metallic = NumberOf(from, AI_MATKEY_METALLIC_FACTOR, 1);
      material.roughness = NumberOf(from, AI_MATKEY_ROUGHNESS_FACTOR, 1);
      material.specular_f0 = kDielectricF0 * (1 - metallic) + material.albedo * metallic;
      material.albedo *= 1 - metallic;
    } else if (is_collada && material.albedo_texture >= 0) {
      material.albedo = 1;  // in COLLADA the texture stands in place of the colour
    }
    material.albedo = std::min(material.albedo, 1.0f);
    model->materials.push_back(material);
  }
  if (model->materials.empty()) model->materials.push_back({});
}

}  // namespace aisle::sim
