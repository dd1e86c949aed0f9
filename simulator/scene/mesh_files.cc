#include "simulator/scene/mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

void Find(MeshSpec* mesh, const std::string& key, Scene* scene, Issues* issues) {
  if (mesh->name.empty()) return;
  const auto index = static_cast<std::size_t>(mesh->mark.file);
  const std::string& from = index < scene->files.size() ? scene->files[index] : scene->file;
  mesh->file = (fs::path(from).parent_path() / mesh->name).lexically_normal().string();
  std::error_code failed;
  if (!fs::is_regular_file(mesh->file, failed)) {
    issues->Add(mesh->mark, key, fmt::format("there is no such file: {}", mesh->file));
    return;
  }
  if (std::ranges::find(scene->mesh_files, mesh->file) != scene->mesh_files.end()) return;
  scene->mesh_files.push_back(mesh->file);
}

}  // namespace

void FindMeshFiles(Scene* scene, Issues* issues) {
  Find(&scene->hall.mesh, "hall.mesh", scene, issues);
  for (std::size_t i = 0; i < scene->props.size(); ++i) {
    PropSpec& prop = scene->props[i];
    const std::string key = fmt::format("props[{}]", i);
    if (!prop.mesh.name.empty() && !prop.model.empty()) {
      issues->Add(prop.mesh.mark, key, "it has a `model` and a `mesh`; give one of them");
    }
    Find(&prop.mesh, key + ".mesh", scene, issues);
  }
  scene->files.insert(scene->files.end(), scene->mesh_files.begin(), scene->mesh_files.end());
}

}  // namespace aisle::sim
