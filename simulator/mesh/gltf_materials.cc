#include "simulator/mesh/gltf_materials.h"

#include <map>

#include "simulator/mesh/texture_store.h"

namespace aisle::sim {
namespace {

constexpr float kDielectricF0 = 0.04f;
/// From this share of metal on, the colour's texture counts in the one reflectance that the lobe of
/// a whole material has, by its mean.
constexpr float kMostlyMetal = 0.5f;

/// Mean reflectance of an sRGB image.
float MeanReflectance(const cv::Mat& grey) {
  std::array<double, 256> counts{};
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) ++counts[grey.at<std::uint8_t>(y, x)];
  }
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    sum += counts[i] * double{LinearOf(static_cast<std::uint8_t>(i))};
  }
  return static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, grey.total())));
}

/// How much of a surface is metal, and how rough it is.
struct Metal {
  float metallic = 1, roughness = 1;
};

class MaterialReader {
 public:
  MaterialReader(const GltfDocument& document, const std::filesystem::path& file,
                 const ImportOptions& options, Model* model)
      : document_(document),
        file_(file),
        options_(options),
        model_(model),
        textures_(options, model) {}

  Material Read(const GltfValue& from) {
    Material material;
    material.name = from.Text("name", "");
    material.emission = std::max(Grey(from, "emissiveFactor", 3, 0), 0.0f);
    material.albedo = 1;
    Metal metal;
    if (from.Has("pbrMetallicRoughness")) {
      const GltfValue surface = from.Get("pbrMetallicRoughness");
      material.albedo = std::max(Grey(surface, "baseColorFactor", 4, 1), 0.0f);
      material.albedo_texture = Texture(surface, "baseColorTexture", false);
      metal = MetalOf(surface);
    }
    material.roughness = metal.roughness;
    if (!LeavesNormalMapOut(from)) material.normal_texture = Texture(from, "normalTexture", true);
    if (material.normal_texture >= 0) {
      material.normal_scale = from.Get("normalTexture").Number("scale", 1);
    }
    // A metal shines by its lobe alone. Where that is too broad to be one, all of it is diffuse.
    const float metallic = metal.roughness < kDullRoughness ? metal.metallic : 0.0f;
    float mirrored = material.albedo;
    if (metallic > kMostlyMetal && material.albedo_texture >= 0) {
      const auto texture = static_cast<std::size_t>(material.albedo_texture);
      mirrored *= MeanReflectance(model_->textures[texture].image);
    }
    material.specular_f0 = kDielectricF0 * (1 - metallic) + mirrored * metallic;
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

  /// The factors, times the mean of their map: its blue is metal, its green roughness.
  Metal MetalOf(const GltfValue& surface) {
    Metal metal{std::clamp(surface.Number("metallicFactor", 1), 0.0f, 1.0f),
                std::clamp(surface.Number("roughnessFactor", 1), 0.0f, 1.0f)};
    const auto image = ImageOf(surface, "metallicRoughnessTexture");
    if (!image) return metal;
    const auto [known, is_new] = metal_means_.try_emplace(*image);
    if (is_new) {
      const GltfValue of_map = document_.root().Item("images", *image);
      const cv::Mat map = DecodeImage(ImageBytes(of_map), "texture " + NameOf(of_map, *image),
                                      options_.max_texture_px);
      const cv::Scalar mean = cv::mean(map) / 255;
      // OpenCV has blue first; a grey image has one for all.
      known->second = {static_cast<float>(mean[0]),
                       static_cast<float>(map.channels() == 1 ? mean[0] : mean[1])};
    }
    metal.metallic *= known->second.metallic;
    metal.roughness *= known->second.roughness;
    return metal;
  }

  /// The image of a texture; none without one, or when it is in no core format.
  std::optional<std::size_t> ImageOf(const GltfValue& holder, const char* key) const {
    if (!holder.Has(key)) return std::nullopt;
    const GltfValue root = document_.root();
    const std::size_t textures = root.Count("textures"), images = root.Count("images");
    const std::size_t texture = holder.Get(key).Get("index").IndexBelow(textures, "texture");
    return root.Item("textures", texture).IndexBelow("source", images, "image");
  }

  /// What tells an image from the others: its file, or its place.
  static std::string NameOf(const GltfValue& image, std::size_t index) {
    const std::string name = image.Text("uri", "");
    const bool is_file = !name.empty() && !name.starts_with("data:");
    return is_file ? name : fmt::format("images[{}]", index);
  }

  /// Index of the model's texture; -1 without one, or when its image is in no core format.
  int Texture(const GltfValue& holder, const char* key, bool is_normal_map) {
    const auto index = ImageOf(holder, key);
    if (!index) return -1;
    const GltfValue image = document_.root().Item("images", *index);
    return textures_.Add(NameOf(image, *index), is_normal_map, [&] { return ImageBytes(image); });
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
  Model* model_;
  TextureStore textures_;
  std::map<std::size_t, Metal> metal_means_;  ///< by image
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
