#include "simulator/mesh/gltf_materials.h"

#include "simulator/mesh/texture_store.h"

namespace aisle::sim {
namespace {

constexpr float kDielectricF0 = 0.04f;

class MaterialReader {
 public:
  MaterialReader(const GltfDocument& document, const std::filesystem::path& file,
                 const ImportOptions& options, Model* model)
      : document_(document), file_(file), options_(options), textures_(options, model) {}

  Material Read(const GltfValue& from) {
    Material material;
    material.name = from.Text("name", "");
    material.emission = std::max(Grey(from, "emissiveFactor", 3, 0), 0.0f);
    float metallic = 1;
    material.albedo = 1;
    if (from.Has("pbrMetallicRoughness")) {
      const GltfValue surface = from.Get("pbrMetallicRoughness");
      material.albedo = std::max(Grey(surface, "baseColorFactor", 4, 1), 0.0f);
      material.albedo_texture = Texture(surface, "baseColorTexture", false);
      metallic = std::clamp(surface.Number("metallicFactor", 1), 0.0f, 1.0f);
      material.roughness = std::clamp(surface.Number("roughnessFactor", 1), 0.0f, 1.0f);
    }
    if (!LeavesNormalMapOut(from)) material.normal_texture = Texture(from, "normalTexture", true);
    if (material.normal_texture >= 0) {
      material.normal_scale = from.Get("normalTexture").Number("scale", 1);
    }
    material.specular_f0 = kDielectricF0 * (1 - metallic) + material.albedo * metallic;
    material.albedo = std::min(material.albedo * (1 - metallic), 1.0f);
    return material;
  }

 private:
  float Grey(const GltfValue& holder, const char* key, std::size_t count, float otherwise) const {
    const std::vector<float> rgb = holder.Numbers(key, count);
    const float all = otherwise;
    return rgb.empty() ? GreyOf(Eigen::Vector3f(all, all, all), options_.band)
                       : GreyOf(Eigen::Vector3f(rgb[0], rgb[1], rgb[2]), options_.band);
  }

  /// Index of the model's texture; -1 without one, or when its image is in no core format.
  int Texture(const GltfValue& holder, const char* key, bool is_normal_map) {
    if (!holder.Has(key)) return -1;
    const GltfValue root = document_.root();
    const std::size_t textures = root.Count("textures"), images = root.Count("images");
    const std::size_t texture = holder.Get(key).Get("index").IndexBelow(textures, "texture");
    const auto source = root.Item("textures", texture).IndexBelow("source", images, "image");
    if (!source) return -1;
    const GltfValue image = root.Item("images", *source);
    const std::string name = image.Text("uri", "");
    const bool is_file = !name.empty() && !name.starts_with("data:");
    const std::string id = is_file ? name : fmt::format("images[{}]", *source);
    return textures_.Add(id, is_normal_map, [&] { return ImageBytes(image); });
  }

  Bytes ImageBytes(const GltfValue& image) const {
    if (image.Has("uri")) return UriBytes(image.Get("uri"), file_, options_);
    const std::size_t views = document_.root().Count("bufferViews");
    const std::span<const std::uint8_t> bytes =
        ViewBytes(document_, image.Get("bufferView").IndexBelow(views, "bufferView"));
    return {bytes.begin(), bytes.end()};
  }

  const GltfDocument& document_;
  const std::filesystem::path& file_;
  const ImportOptions& options_;
  TextureStore textures_;
};

/// The set that a texture is read at, if there is the texture.
std::optional<std::size_t> SetOf(const GltfValue& holder, const char* texture) {
  if (!holder.Has(texture)) return std::nullopt;
  return holder.Get(texture).Whole("texCoord", 0);
}

std::optional<std::size_t> SetOfColour(const GltfValue& material) {
  constexpr const char* kSurface = "pbrMetallicRoughness";
  if (!material.Has(kSurface)) return std::nullopt;
  return SetOf(material.Get(kSurface), "baseColorTexture");
}

}  // namespace

std::size_t CoordinatesOf(const GltfValue& material) {
  return SetOfColour(material).value_or(SetOf(material, "normalTexture").value_or(0));
}

bool LeavesNormalMapOut(const GltfValue& material) {
  const auto normals = SetOf(material, "normalTexture");
  return normals && *normals != CoordinatesOf(material);
}

void AddGltfMaterials(const GltfDocument& document, const std::filesystem::path& file,
                      const ImportOptions& options, Model* model) {
  MaterialReader reader(document, file, options, model);
  for (const GltfValue& material : document.root().Items("materials")) {
    model->materials.push_back(reader.Read(material));
  }
  const nlohmann::json nothing = nlohmann::json::object();
  model->materials.push_back(reader.Read({&nothing, "the default material"}));
}

}  // namespace aisle::sim
