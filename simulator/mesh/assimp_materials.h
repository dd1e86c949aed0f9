#pragma once

#include <assimp/scene.h>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// Fills `model->materials` and `model->textures` from what assimp read of an OBJ or COLLADA file.
/// `file` is the model's path, for textures beside it. In COLLADA a texture stands in place of the
/// colour, in OBJ they multiply. Throws ImportError.
void AddAssimpMaterials(const aiScene& scene, const std::filesystem::path& file, bool is_collada,
                        const ImportOptions& options, Model* model);

}  // namespace aisle::sim
