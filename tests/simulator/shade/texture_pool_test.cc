#include "simulator/shade/surface/texture_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle::sim {
namespace {

cv::Mat1b Checks(int size, int cell) {
  cv::Mat1b image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) image(y, x) = (x / cell + y / cell) % 2 ? 255 : 0;
  }
  return image;
}

TEST(TexturePool, TexelCentresGiveTheirLinearReflectance) {
  cv::Mat1b ramp(4, 4);
  for (int i = 0; i < 16; ++i) ramp(i / 4, i % 4) = static_cast<std::uint8_t>(17 * i);
  const std::vector<Texture> textures = {{"ramp", ramp}};
  const TexturePool pool(textures);
  for (int i = 0; i < 16; ++i) {
    const float s = static_cast<float>(17 * i) / 255;
    const float linear = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
    const float value = pool.SampleWide(0, (static_cast<float>(i % 4) + 0.5f) / 4,
                                        (static_cast<float>(i / 4) + 0.5f) / 4, 1e-4f);
    EXPECT_NEAR(value, linear, 0.004f + 0.004f * linear);
  }
}

TEST(TexturePool, TexturesThatTogetherAreTooLargeAreRefusedAndTheLargestNamed) {
  const std::vector<Texture> textures = {{"small", Checks(16, 4)},
                                         {"large", Checks(256, 4)},
                                         {"bumps", cv::Mat(64, 64, CV_8UC3, cv::Scalar::all(128))}};
  // Each level has a row and a column more than its texels.
  const auto level_sum = [](std::size_t side) {
    std::size_t sum = 0;
    for (; side >= 1; side /= 2) sum += (side + 1) * (side + 1);
    return sum;
  };
  const std::size_t bytes = level_sum(16) + level_sum(256) + 2 * level_sum(64);
  EXPECT_NO_THROW(TexturePool(textures, bytes));
  try {
    TexturePool(textures, bytes - 1);
    FAIL() << "they were taken";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("its 3 textures take 0 MB"));
    EXPECT_THAT(error.what(),
                testing::EndsWith("'large' (256 x 256), 'bumps' (64 x 64), 'small' (16 x 16)"));
  }
}

TEST(TexturePool, AWideFootprintSeesTheMeanLightAndNoTextureSeesOne) {
  const std::vector<Texture> textures = {{"checks", Checks(256, 4)}};
  const TexturePool pool(textures);
  EXPECT_NEAR(pool.SampleWide(0, 0.3f, 0.6f, 0.5f), 0.5f, 0.01f);
  EXPECT_EQ(pool.SampleWide(-1, 0.3f, 0.6f, 0.5f), 1);
}

TEST(TexturePool, AThinFootprintKeepsWhatCrossesItsShortSide) {
  // Stripes across v; the footprint is long along u and short along v, as on a floor ahead.
  cv::Mat1b stripes(256, 256);
  for (int y = 0; y < 256; ++y) stripes.row(y) = y / 16 % 2 ? 255 : 0;
  const std::vector<Texture> textures = {{"stripes", stripes}};
  const TexturePool pool(textures);
  const F8 zero = Wide(0), v_white = Wide(24.0f / 256), v_black = Wide(8.0f / 256);
  const F8 step_long = Wide(16.0f / 256), step_short = Wide(2.0f / 256);
  EXPECT_GT(pool.Sample(I8{}, Wide(0.5f), v_white, step_long, zero, zero, step_short)[0], 0.95f);
  EXPECT_LT(pool.Sample(I8{}, Wide(0.5f), v_black, step_long, zero, zero, step_short)[0], 0.05f);
}

TEST(TexturePool, FootprintsThatAreNotFiniteDoNoHarm) {
  const std::vector<Texture> textures = {{"checks", Checks(64, 4)}};
  const TexturePool pool(textures);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, inf, -inf}) {
    const F8 value =
        pool.Sample(I8{}, Wide(0.5f), Wide(0.5f), Wide(bad), Wide(bad), Wide(bad), Wide(0.1f));
    EXPECT_GE(value[0], 0);
    EXPECT_LE(value[0], 1.001f);
  }
}

}  // namespace
}  // namespace aisle::sim
