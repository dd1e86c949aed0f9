#include "simulator/shade/light/unfinished_light.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <numeric>

#include "simulator/shade/light/light_cache.h"
#include "simulator/shade/light/static_light.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

class Unfinished : public testing::Test {
 protected:
  Unfinished() : folder_(fs::path(testing::TempDir()) / fmt::format("aisle-begun-{}", getpid())) {
    fs::remove_all(folder_);
  }
  ~Unfinished() override { fs::remove_all(folder_); }

  static std::vector<float> From(float first, std::size_t count) {
    std::vector<float> light(count);
    std::iota(light.begin(), light.end(), first);
    return light;
  }
  /// Three pieces of 100 points.
  void WriteThree() const {
    UnfinishedLight light(folder_, 7);
    for (const float first : {0.f, 100.f, 200.f}) light.Append(From(first, 100));
  }
  fs::path file() const { return UnfinishedFileOf(folder_, 7); }
  std::vector<float> Begun(std::uint64_t key = 7) const {
    return UnfinishedLight(folder_, key).TakeBegun();
  }

  fs::path folder_;
};

TEST_F(Unfinished, GoesOnWhereItStopped) {
  EXPECT_TRUE(Begun().empty());
  WriteThree();
  UnfinishedLight next(folder_, 7);
  EXPECT_EQ(next.TakeBegun(), From(0, 300));
  next.Append(From(300, 50));
  EXPECT_EQ(Begun(), From(0, 350));
  EXPECT_TRUE(Begun(8).empty()) << "of another solution";
}

/// Whoever died amid a piece loses that piece alone, and the next one writes behind what is whole.
TEST_F(Unfinished, ThatIsCutAnywhereKeepsItsWholePieces) {
  WriteThree();
  const std::uintmax_t size = fs::file_size(file());
  for (const std::uintmax_t bytes : {size - 1, size - size / 3 + 1, 2 * size / 3, size / 3 - 1}) {
    fs::resize_file(file(), bytes);
    const std::size_t whole = 100 * (3 * bytes / size);
    UnfinishedLight next(folder_, 7);
    EXPECT_EQ(next.TakeBegun(), From(0, whole)) << bytes;
    next.Append(From(static_cast<float>(whole), 7));
    EXPECT_EQ(Begun(), From(0, whole + 7)) << bytes;
    fs::remove(file());
    WriteThree();
  }
}

TEST_F(Unfinished, ThatIsDamagedAnywhereIsReadUpToThere) {
  WriteThree();
  const auto size = static_cast<std::streamoff>(fs::file_size(file()));
  for (std::streamoff at = 0; at < size; at += 7) {
    std::fstream bytes(file(), std::ios::binary | std::ios::in | std::ios::out);
    bytes.seekg(at);
    const char was = static_cast<char>(bytes.get());
    bytes.seekp(at);
    bytes.put(static_cast<char>(was ^ 0x10));
    bytes.close();
    EXPECT_EQ(Begun(), From(0, 100 * static_cast<std::size_t>(3 * at / size))) << at;
    fs::remove(file());
    WriteThree();
  }
}

TEST_F(Unfinished, GoesWhenTheSolutionIsKept) {
  WriteThree();
  SaveLight(folder_, 7, LightState());
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(Unfinished, InAFolderThatCannotBeIsNoError) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  UnfinishedLight light(folder_, 7);
  light.Append(From(0, 10));
  EXPECT_TRUE(Begun().empty());
}

/// A solution that was interrupted anywhere is the same to the bit, and what was there is not
/// computed again: other light put there is believed.
TEST_F(Unfinished, SolutionGoesOnToTheSameBits) {
  const World world{test::Hall({.boxes = 20, .lights = 2})};
  const Tracer tracer{world, {}};
  const TexturePool textures{world.textures()};
  const std::vector<float> all_on(world.lights().size(), 1.0f);
  StaticLightOptions options{.cache_folder = folder_,
                             .texel_m = 0.5f,
                             .coarse_texel_m = 1,
                             .volume_spacing_m = 2,
                             .directions = 16};
  const std::uint64_t key = LightKey(world, options, all_on);
  const auto solve = [&] { return *StaticLight(world, tracer, textures, options).At(all_on); };
  // What lies there when the direct light is done, kept from being taken away.
  options.progress = [&](const LightProgress& at) {
    if (at.phase == std::string("patches")) {
      fs::copy_file(UnfinishedFileOf(folder_, key), UnfinishedFileOf(folder_, 1),
                    fs::copy_options::overwrite_existing);
    }
  };
  const LightState whole = solve();
  EXPECT_FALSE(fs::exists(UnfinishedFileOf(folder_, key)));
  fs::rename(UnfinishedFileOf(folder_, 1), UnfinishedFileOf(folder_, key));
  std::vector<float> direct = UnfinishedLight(folder_, key).TakeBegun();
  ASSERT_GT(direct.size(), 1000u);

  options.progress = {};
  for (const std::size_t points : {std::size_t{0}, std::size_t{512}, direct.size()}) {
    fs::remove_all(folder_);
    UnfinishedLight(folder_, key).Append(std::span(direct).first(points));
    const LightState resumed = solve();
    EXPECT_EQ(resumed.total, whole.total) << points;
    EXPECT_EQ(resumed.direct, whole.direct) << points;
  }
  fs::remove_all(folder_);
  std::fill_n(direct.begin(), 512, 1000.0f);
  UnfinishedLight(folder_, key).Append(std::span(direct).first(512));
  EXPECT_NE(solve().direct, whole.direct);
}

}  // namespace
}  // namespace aisle::sim
