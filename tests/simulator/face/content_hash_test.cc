#include "simulator/content_hash.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

struct Inputs {
  std::string essence = "a scene";
  WorldParts parts = test::Hall({.boxes = 20});
  std::int64_t end_ns = 4'000'000'000;
  SimulatorOptions options;
};

std::uint64_t HashOf(Inputs inputs) {
  return ContentHash(inputs.essence, World(std::move(inputs.parts)), inputs.end_ns, inputs.options);
}

TEST(ContentHash, ChangesWithEverythingThatDecidesAPixel) {
  const std::map<std::string, std::function<void(Inputs&)>> changes = {
      {"essence", [](Inputs& in) { in.essence += "!"; }},
      {"position", [](Inputs& in) { in.parts.statics.mesh.positions[5].x() += 1e-3f; }},
      {"normal", [](Inputs& in) { in.parts.statics.mesh.normals[5] = Eigen::Vector3f::UnitY(); }},
      {"normal of a mover",
       [](Inputs& in) { in.parts.mover_meshes[0].normals[5] = Eigen::Vector3f::UnitY(); }},
      {"uv", [](Inputs& in) { in.parts.statics.mesh.uvs[5].x() += 0.1f; }},
      {"albedo", [](Inputs& in) { in.parts.materials[1].albedo += 0.01f; }},
      {"which texture", [](Inputs& in) { in.parts.materials[0].albedo_texture = 1; }},
      {"which normal map", [](Inputs& in) { in.parts.materials[0].normal_texture = 1; }},
      {"transmission", [](Inputs& in) { in.parts.materials[4].transmission = 0.5f; }},
      {"texture", [](Inputs& in) { in.parts.textures[0].image.at<std::uint8_t>(3, 3) ^= 1; }},
      {"lamp", [](Inputs& in) { in.parts.lights[0].radiance *= 1.01f; }},
      {"colour",
       [](Inputs& in) {
         in.parts.colour.assign(3, BandSurfaces{in.parts.materials, in.parts.textures});
       }},
      {"one band of colour",
       [](Inputs& in) {
         in.parts.colour.assign(3, BandSurfaces{in.parts.materials, in.parts.textures});
         in.parts.colour[2].materials[1].albedo = 0.1f;
       }},
      {"files", [](Inputs& in) { in.parts.files_digest = 7; }},
      {"seed", [](Inputs& in) { in.options.seed = 2; }},
      {"twin", [](Inputs& in) { in.options.twin = Twin::kFrozen; }},
      {"pair", [](Inputs& in) { in.options.pair = "rear"; }},
      {"isa", [](Inputs& in) { in.options.isa = "native"; }},
      {"spacing of the light", [](Inputs& in) { in.options.light_spacing = 4; }}};
  std::map<std::uint64_t, std::string> seen = {{HashOf({}), "nothing"}};
  EXPECT_TRUE(seen.contains(HashOf({})));
  for (const auto& [what, change] : changes) {
    Inputs inputs;
    for (Texture& texture : inputs.parts.textures) texture.image = texture.image.clone();
    change(inputs);
    const auto [like, is_new] = seen.emplace(HashOf(std::move(inputs)), what);
    EXPECT_TRUE(is_new) << what << " gives the hash of " << like->second;
  }
}

}  // namespace
}  // namespace aisle::sim
