#include "harness/plugs/user_model.h"

#include "harness/io/input_error.h"
#include "harness/plugs/bag_poses.h"
#include "simulator/import_model.h"
#include "simulator/scene_file.h"

namespace aisle {

UserModel TakeInUserModel(const UserModelRequest& request) {
  try {
    sim::ImportedModel model = sim::ImportUserModel({.file = request.file,
                                                     .output = request.output,
                                                     .licence = request.licence,
                                                     .unit_m = request.unit_m,
                                                     .up = request.up,
                                                     .skinned = request.skinned});
    return {.low_m = model.low_m,
            .high_m = model.high_m,
            .triangles = model.triangles,
            .materials = model.materials,
            .textures = model.textures,
            .nodes = std::move(model.nodes),
            .clips = std::move(model.clips),
            .left_out = std::move(model.left_out),
            .picture = model.picture,
            .grid_m = model.grid_m};
  } catch (const std::system_error&) {
    throw;  // the machine's, not the file's
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

std::vector<std::string> DescribeMeshes(const std::string& scene_file) {
  try {
    return sim::DescribeSceneMeshes(scene_file, ReadPosesOfBag);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

}  // namespace aisle
