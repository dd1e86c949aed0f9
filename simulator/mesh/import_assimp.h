#pragma once

#include "simulator/mesh/import.h"
#include "simulator/mesh/model_format.h"

namespace aisle::sim {

/// Adds an OBJ or COLLADA file, as assimp reads it, below model node 0. No other importer of assimp
/// is let near the file. Throws ImportError without the file's name; also where several nodes bear
/// the name that a bone or an animation means, for in these formats assimp knows nodes by name.
void AddAssimpModel(const std::filesystem::path& file, ModelFormat format,
                    const ImportOptions& options, Model* model);

}  // namespace aisle::sim
