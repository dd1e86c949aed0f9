#include "simulator/mesh/gltf_left_out.h"

#include "simulator/mesh/gltf_materials.h"
#include "simulator/mesh/left_out.h"

namespace aisle::sim {
namespace {

/// Extensions that leave nothing out: what they say is read, or named on its own.
constexpr std::array<std::string_view, 2> kSilent = {"KHR_mesh_quantization",
                                                     "KHR_lights_punctual"};

struct Counts {
  std::size_t lights = 0, points = 0, lines = 0, morphs = 0, colours = 0;
  std::size_t shine = 0, occlusion = 0, glow = 0, formats = 0, transparent = 0, bumps = 0;
};

std::size_t LightsOf(const GltfValue& root) {
  if (!root.Has("extensions")) return 0;
  const GltfValue extensions = root.Get("extensions");
  if (!extensions.Has("KHR_lights_punctual")) return 0;
  return extensions.Get("KHR_lights_punctual").Count("lights");
}

void CountMeshes(const GltfValue& root, Counts* counts) {
  constexpr std::size_t kTriangles = 4;
  for (const GltfValue& mesh : root.Items("meshes")) {
    for (const GltfValue& primitive : mesh.Items("primitives")) {
      const std::size_t mode = primitive.Whole("mode", kTriangles);
      counts->points += mode == 0 ? 1 : 0;
      counts->lines += mode > 0 && mode < kTriangles ? 1 : 0;
      counts->morphs += primitive.Count("targets");
      counts->colours +=
          primitive.Has("attributes") && primitive.Get("attributes").Has("COLOR_0") ? 1 : 0;
    }
  }
}

/// Whether a texture's image is in none of glTF's own formats.
bool IsForeign(const GltfValue& root, const GltfValue& holder, const char* key) {
  if (!holder.Has(key)) return false;
  const std::size_t texture =
      holder.Get(key).Get("index").IndexBelow(root.Count("textures"), "texture");
  return !root.Item("textures", texture).Has("source");
}

void CountMaterials(const GltfValue& root, Counts* counts) {
  for (const GltfValue& material : root.Items("materials")) {
    const std::string mode = material.Text("alphaMode", "OPAQUE");
    counts->transparent += mode == "OPAQUE" ? 0 : 1;
    counts->occlusion += material.Has("occlusionTexture") ? 1 : 0;
    counts->glow += material.Has("emissiveTexture") ? 1 : 0;
    counts->formats += IsForeign(root, material, "normalTexture") ? 1 : 0;
    counts->bumps += LeavesNormalMapOut(material) ? 1 : 0;
    if (!material.Has("pbrMetallicRoughness")) continue;
    const GltfValue surface = material.Get("pbrMetallicRoughness");
    const bool foreign = IsForeign(root, surface, "metallicRoughnessTexture");
    counts->shine += surface.Has("metallicRoughnessTexture") && !foreign ? 1 : 0;
    counts->formats += foreign ? 1 : 0;
    counts->formats += IsForeign(root, surface, "baseColorTexture") ? 1 : 0;
  }
}

}  // namespace

std::vector<std::string> LeftOutOfGltf(const GltfDocument& document) {
  const GltfValue root = document.root();
  Counts counts;
  counts.lights = LightsOf(root);
  CountMeshes(root, &counts);
  CountMaterials(root, &counts);
  LeftOut out;
  out.Add(root.Count("cameras"), "camera");
  out.Add(counts.lights, "light");
  out.Add(counts.points, "cloud of points", "clouds of points");
  out.Add(counts.lines, "bundle of lines", "bundles of lines");
  out.Add(counts.morphs, "morph target");
  out.Add(counts.colours, "set of vertex colours", "sets of vertex colours");
  out.Add(counts.formats, "texture that is neither PNG nor JPEG",
          "textures that are neither PNG nor JPEG");
  out.Add(counts.bumps, "normal map on other coordinates than its colour",
          "normal maps on other coordinates than their colours");
  out.Add(counts.shine, "texture of metal and roughness but for its mean",
          "textures of metal and roughness but for their means");
  out.Add(counts.occlusion, "texture of occlusion", "textures of occlusion");
  out.Add(counts.glow, "texture of emission", "textures of emission");
  out.Add(counts.transparent, "material's transparency", "materials' transparency");
  for (const GltfValue& extension : root.Items("extensionsUsed")) {
    const std::string name = extension.Text();
    if (std::ranges::find(kSilent, name) == kSilent.end()) out.Add("the extension " + name);
  }
  return out.Take();
}

}  // namespace aisle::sim
