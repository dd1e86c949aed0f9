#pragma once

#include "simulator/mesh/gltf_document.h"

namespace aisle::sim {

/// Adds the file's metallic-roughness materials, one band of them, with their base colour and
/// normal textures, and after them glTF's default material. Emission is cut to what a material
/// states without extensions. `file` is the model's path, for images beside it. Throws ImportError.
void AddGltfMaterials(const GltfDocument& document, const std::filesystem::path& file,
                      const ImportOptions& options, Model* model);

}  // namespace aisle::sim
