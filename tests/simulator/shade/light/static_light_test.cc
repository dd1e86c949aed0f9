#include "simulator/shade/light/static_light.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "simulator/common/parallel.h"
#include "simulator/shade/light/light_cache.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

class StaticLightTest : public testing::Test {
 protected:
  StaticLightTest() { fs::remove_all(options_.cache_folder); }
  ~StaticLightTest() override { fs::remove_all(options_.cache_folder); }

  StaticLight Solved() const { return StaticLight(world_, tracer_, textures_, options_); }
  /// What was kept of a solution with these lamps on.
  LightState Kept(const std::vector<float>& lamps, std::size_t slots) const {
    return LoadLight(options_.cache_folder, LightKey(world_, options_, lamps), slots).value();
  }

  const World world_{test::Hall({.boxes = 20, .lights = 3})};
  const Tracer tracer_{world_, {}};
  const TexturePool textures_{world_.textures()};
  const StaticLightOptions options_{
      .cache_folder = fs::path(testing::TempDir()) / fmt::format("aisle-static-{}", getpid()),
      .texel_m = 0.2f,
      .coarse_texel_m = 1,
      .volume_spacing_m = 2,
      .directions = 16};
};

TEST_F(StaticLightTest, DimmedLampsAreTakenOffTheWholeOneAfterTheOther) {
  const StaticLight light = Solved();
  const LightState whole = *light.At({}), dimmed = *light.At(std::vector{0.25f, 1.0f, 0.0f});
  const std::size_t slots = whole.total.size();
  ASSERT_GT(slots, 40'000u) << "it is done in several pieces";
  const LightState off = Kept({0, 0, 1}, slots), faint = Kept({1, 0, 0}, slots);
  for (const auto values : {&LightState::total, &LightState::direct}) {
    std::vector<float> expected = whole.*values;
    for (std::size_t i = 0; i < slots; ++i) {
      expected[i] = std::max(0.0f, expected[i] - (off.*values)[i]);
      expected[i] = std::max(0.0f, expected[i] - 0.75f * (faint.*values)[i]);
    }
    EXPECT_EQ(dimmed.*values, expected);
  }
  for (std::size_t i = 0; i < whole.volume.size(); ++i) {
    EXPECT_FLOAT_EQ(
        dimmed.volume.node(i).mean,
        whole.volume.node(i).mean - off.volume.node(i).mean - 0.75f * faint.volume.node(i).mean);
    EXPECT_EQ(dimmed.volume.node(i).weight, whole.volume.node(i).weight);
  }
}

TEST_F(StaticLightTest, DimmedLampsGiveTheSameBitsForAnyNumberOfThreads) {
  const std::vector<float> scale = {0.6f, 0.3f, 0.6f};
  std::vector<LightState> states;
  for (const int threads : {1, 4}) {
    Arena(threads).Execute([&] { states.push_back(*Solved().At(scale)); });
  }
  EXPECT_EQ(states[0].total, states[1].total);
  EXPECT_EQ(states[0].direct, states[1].direct);
}

}  // namespace
}  // namespace aisle::sim
