#pragma once

#include "simulator/scene/issues.h"
#include "simulator/scene/scene.h"

namespace aisle::sim {

/// Finds the meshes and motions of the user's own that a scene names, those of every hall that a
/// seed may deal included, meant from the folder of the file that names them, and adds their files
/// to the scene's. None is opened. Mistakes go to `issues`.
void FindMeshFiles(Scene* scene, Issues* issues);

}  // namespace aisle::sim
