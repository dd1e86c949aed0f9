#pragma once

#include <assimp/scene.h>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// Fills `model->materials` and `model->textures` from what assimp read. `file` is the model's
/// path, for textures beside it and for messages.
void ImportMaterials(const aiScene& scene, const std::filesystem::path& file,
                     const ImportOptions& options, Model* model);

}  // namespace aisle::sim
