#pragma once

#include "simulator/mesh/gltf_document.h"

namespace aisle::sim {

/// Adds the file's metallic-roughness materials, one band of them, with their base colour and
/// normal textures, and after them glTF's default material. Emission is cut to what a material
/// states without extensions. `file` is the model's path, for images beside it. Throws ImportError.
void AddGltfMaterials(const GltfDocument& document, const std::filesystem::path& file,
                      const ImportOptions& options, Model* model);

/// Which set of texture coordinates a material's textures are read at: the base colour's, else the
/// normal map's. A normal map of another set than the colour's is left out.
std::size_t CoordinatesOf(const GltfValue& material);
/// Whether that is so.
bool LeavesNormalMapOut(const GltfValue& material);

}  // namespace aisle::sim
