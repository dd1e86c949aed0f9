#include "simulator/scene/mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

using Files = std::vector<std::string>;

/// Where a file is that a key names; adds it to `files`.
void Find(MeshSpec* named, const std::string& key, const Scene& scene, Files* files,
          Issues* issues) {
  if (named->name.empty()) return;
  const auto index = static_cast<std::size_t>(named->mark.file);
  const std::string& from = index < scene.files.size() ? scene.files[index] : scene.file;
  named->file = (fs::path(from).parent_path() / named->name).lexically_normal().string();
  std::error_code failed;
  if (!fs::is_regular_file(named->file, failed)) {
    issues->Add(named->mark, key, fmt::format("no such file: {}", named->file));
    return;
  }
  if (std::ranges::find(*files, named->file) == files->end()) files->push_back(named->file);
}

void FindOfPerson(PersonSpec* person, Scene* scene, Issues* issues) {
  CaptureSpec& capture = person->capture;
  const std::string key = fmt::format("people[{}]", person->place);
  Find(&capture.bvh, key + ".bvh", *scene, &scene->motion_files, issues);
  Find(&capture.mesh, key + ".mesh", *scene, &scene->mesh_files, issues);
  if (!capture.bvh.name.empty() && !person->route.plan.steps.empty()) {
    issues->Add(capture.bvh.mark, key, "it moves with its motion; remove `steps`");
  }
  if (!capture.bvh.name.empty() && scene->drive.there) {
    issues->Add(capture.bvh.mark, key,
                "a closed drive must know where people walk; use `steps` instead of a motion");
  }
  if (!capture.bvh.name.empty() && scene->crowd.people > 0) {
    issues->Add(capture.bvh.mark, key,
                "a crowd must know where people walk to keep clear of them; use `steps` instead of "
                "a motion");
  }
}

void FindOfPremises(Premises* premises, Scene* scene, Issues* issues) {
  Find(&premises->hall.mesh, "hall.mesh", *scene, &scene->mesh_files, issues);
  for (std::size_t i = 0; i < premises->props.size(); ++i) {
    PropSpec& prop = premises->props[i];
    const std::string key = fmt::format("props[{}]", i);
    if (!prop.mesh.name.empty() && !prop.model.empty()) {
      issues->Add(prop.mesh.mark, key, "it has both a `model` and a `mesh`; keep one of them");
    }
    Find(&prop.mesh, key + ".mesh", *scene, &scene->mesh_files, issues);
  }
}

}  // namespace

void FindMeshFiles(Scene* scene, Issues* issues) {
  FindOfPremises(scene, scene, issues);
  for (Premises& premises : scene->dealt) FindOfPremises(&premises, scene, issues);
  for (PersonSpec& person : scene->people) FindOfPerson(&person, scene, issues);
  for (const Files* files : {&scene->mesh_files, &scene->motion_files}) {
    scene->files.insert(scene->files.end(), files->begin(), files->end());
  }
}

}  // namespace aisle::sim
