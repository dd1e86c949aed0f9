#include "simulator/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "simulator/mesh/kept/kept_model.h"
#include "simulator/scene/essence.h"
#include "simulator/scene/hall_files.h"
#include "simulator/scene/load.h"
#include "simulator/scene/vary.h"
#include "simulator/scene_camera.h"
#include "simulator/world/check_models.h"
#include "simulator/world/recorded_ways.h"

namespace aisle::sim {

std::vector<std::string> CheckSceneFile(const std::string& scene_file,
                                        const std::string& assets_dir, const BagPoseReader& bags) {
  try {
    const Scene scene = LoadScene(scene_file, bags);
    std::vector<std::string> errors = LensErrors(scene);
    if (assets_dir.empty()) return errors;
    AssetLibrary assets(assets_dir);
    std::ranges::copy(CheckModels(scene, assets), std::back_inserter(errors));
    return errors.empty() ? CheckCaptured(scene, &assets) : errors;
  } catch (const SceneError& error) {
    return error.messages();
  }
}

SceneInfo ReadSceneInfo(const std::string& scene_file, std::uint64_t seed,
                        const BagPoseReader& bags) {
  Scene scene = LoadScene(scene_file, bags);
  SceneInfo info{.frames = scene.frames, .drive = scene.drive, .hall = {}};
  // The hall is the seed's whoever is in it, and without them no crowd has to find its ways.
  info.hall = HallName(Seeded(WithoutActors(std::move(scene)), seed).hall.use);
  return info;
}

std::vector<std::string> DescribeSceneMeshes(const std::string& scene_file,
                                             const BagPoseReader& bags) {
  std::vector<std::string> lines;
  for (const std::string& file : LoadScene(scene_file, bags).mesh_files) {
    if (std::filesystem::path(file).extension() != kKeptExtension) {
      lines.push_back(fmt::format("{}: used as it is, its licence is recorded nowhere", file));
      continue;
    }
    const ModelRecord record = ReadModelRecord(file);
    lines.push_back(fmt::format("{}: licence {}, from {}", file, record.licence, record.source));
  }
  return lines;
}

std::vector<std::string> FilesOfScene(const std::string& scene_file, const BagPoseReader& bags) {
  return SceneFiles(scene_file, bags);
}

std::string EssenceOfScene(const std::string& scene_file, Twin twin, const BagPoseReader& bags) {
  return EssenceOf(scene_file, twin != Twin::kEmpty, bags);
}

}  // namespace aisle::sim
