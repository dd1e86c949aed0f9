#include "simulator/shade/light/light_cache.h"

#include <gtest/gtest.h>

#include "simulator/scene/load.h"
#include "simulator/scene/vary.h"
#include "simulator/shade/light/static_light.h"
#include "simulator/world/build.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

std::uint64_t KeyOf(WorldParts parts, const StaticLightOptions& options = {}) {
  const std::vector<float> scale(parts.lights.size(), 1.0f);
  return LightKey(World(std::move(parts)), options, scale);
}

std::uint64_t KeyOf(const World& world) {
  return LightKey(world, {}, std::vector<float>(world.lights().size(), 1.0f));
}

WorldParts SmallHall(bool movers = true) {
  return test::Hall({.boxes = 20, .movers = movers, .lights = 2});
}

TEST(LightKey, TheTwinsOfASceneShareIt) {
  const std::string root = AISLE_SOURCE_DIR;
  for (const char* name : {"paper/scene3", "weakness/forklift_pallet"}) {
    const Scene scene = LoadScene(root + "/scenes/" + name + ".yaml");
    const World live = BuildWorld(scene, root + "/assets", 1);
    const World empty = BuildWorld(WithoutActors(scene), root + "/assets", 1);
    ASSERT_GT(live.materials().size(), empty.materials().size()) << name;
    EXPECT_EQ(KeyOf(live), KeyOf(empty)) << name;
    EXPECT_EQ(KeyOf(live), KeyOf(BuildWorld(Frozen(scene), root + "/assets", 1))) << name;
  }
}

TEST(LightKey, WorldsThatShareItHaveTheSameLightBitByBit) {
  const World with(SmallHall(true)), without(SmallHall(false));
  ASSERT_EQ(KeyOf(with), KeyOf(without));
  const auto solve = [](const World& world) {
    const Tracer tracer(world, {});
    const TexturePool textures(world.textures());
    const StaticLightOptions draft = {
        .texel_m = 0.5f, .coarse_texel_m = 1, .volume_spacing_m = 2, .directions = 16};
    const std::vector<float> all_on(world.lights().size(), 1.0f);
    return *StaticLight(world, tracer, textures, draft).At(all_on);
  };
  const LightState a = solve(with), b = solve(without);
  EXPECT_EQ(a.total, b.total);
  EXPECT_EQ(a.direct, b.direct);
}

TEST(LightKey, MoversMaterialsAndTheOrderOfMaterialsDoNotEnter) {
  const std::uint64_t key = KeyOf(SmallHall());
  WorldParts parts = SmallHall();
  parts.materials[4].albedo = 0.9f;  // the figure's
  parts.textures.push_back({"another", test::Speckle(64, 3)});
  parts.materials.push_back({.name = "another", .albedo_texture = 2});
  EXPECT_EQ(KeyOf(parts), key);

  // The last two materials and both textures change places.
  parts = SmallHall();
  std::swap(parts.materials[2], parts.materials[1]);
  std::swap(parts.textures[0], parts.textures[1]);
  for (std::uint16_t& material : parts.statics.mesh.materials) {
    if (material == 1 || material == 2) material = static_cast<std::uint16_t>(3 - material);
  }
  for (Material& material : parts.materials) {
    if (material.albedo_texture >= 0) material.albedo_texture = 1 - material.albedo_texture;
  }
  EXPECT_EQ(KeyOf(parts), key);
}

TEST(LightKey, WhatTheLightDependsOnChangesIt) {
  const std::vector<std::pair<const char*, std::function<void(WorldParts*)>>> changes = {
      {"albedo", [](WorldParts* p) { p->materials[1].albedo *= 1.001f; }},
      {"emission", [](WorldParts* p) { p->materials[3].emission *= 1.001f; }},
      {"gloss", [](WorldParts* p) { p->materials[1].specular_f0 = 0.04f; }},
      {"roughness", [](WorldParts* p) { p->materials[1].roughness = 0.2f; }},
      {"which texture", [](WorldParts* p) { p->materials[0].albedo_texture = 1; }},
      {"texture pixel", [](WorldParts* p) { p->textures[0].image.at<std::uint8_t>(100, 7) ^= 1; }},
      {"texture shape",
       [](WorldParts* p) { p->textures[0].image = p->textures[0].image.reshape(1, 256); }},
      {"material of a triangle", [](WorldParts* p) { p->statics.mesh.materials[5] = 2; }},
      {"vertex", [](WorldParts* p) { p->statics.mesh.positions[9].x() += 1e-5f; }},
      {"normal", [](WorldParts* p) { p->statics.mesh.normals[9].x() += 1e-3f; }},
      {"texture coordinate", [](WorldParts* p) { p->statics.mesh.uvs[9].x() += 1e-3f; }},
      {"order of corners",
       [](WorldParts* p) {
         auto& corners = p->statics.mesh.triangles[3];
         std::swap(corners[0], corners[1]);
       }},
      {"lamp's place", [](WorldParts* p) { p->lights[1].center.z() -= 0.001f; }},
      {"lamp's size", [](WorldParts* p) { p->lights[1].half_u *= 1.001f; }},
      {"lamp's radiance", [](WorldParts* p) { p->lights[0].radiance *= 1.001f; }},
      {"one lamp less", [](WorldParts* p) { p->lights.pop_back(); }},
  };
  std::set<std::uint64_t> keys = {KeyOf(SmallHall())};
  for (const auto& [what, change] : changes) {
    WorldParts parts = SmallHall();
    change(&parts);
    EXPECT_TRUE(keys.insert(KeyOf(std::move(parts))).second) << what;
  }
  EXPECT_TRUE(keys.insert(KeyOf(SmallHall(), {.isa = "sse2"})).second);
  EXPECT_TRUE(keys.insert(KeyOf(SmallHall(), {.texel_m = 0.07f})).second);
  EXPECT_TRUE(keys.insert(KeyOf(SmallHall(), {.bounces = 5})).second);
  const World world(SmallHall());
  EXPECT_TRUE(keys.insert(LightKey(world, {}, std::vector{1.0f, 0.5f})).second);
}

}  // namespace
}  // namespace aisle::sim
