#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "simulator/shade/light/light_cache.h"
#include "simulator/shade/light/static_light.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

class KeptLight : public testing::Test {
 protected:
  KeptLight() : folder_(fs::path(testing::TempDir()) / fmt::format("aisle-light-{}", getpid())) {
    fs::remove_all(folder_);
  }
  ~KeptLight() override { fs::remove_all(folder_); }

  static LightState Random(unsigned seed, std::size_t slots) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 9);
    LightState state;
    for (std::size_t i = 0; i < slots; ++i) {
      state.total.push_back(unit(random));
      state.direct.push_back(unit(random));
    }
    state.volume =
        LightVolume(Eigen::AlignedBox3f(Eigen::Vector3f(-1, 0, 2), Eigen::Vector3f(1, 2, 3)), 0.5f);
    for (std::size_t i = 0; i < state.volume.size(); ++i) {
      state.volume.Set(i, {unit(random), {unit(random), unit(random), unit(random)}, 1});
    }
    return state;
  }

  fs::path OnlyFile() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    EXPECT_EQ(files.size(), 1u) << "nothing half-written is left";
    return files.at(0);
  }

  fs::path folder_;
};

TEST_F(KeptLight, IsReadBackToTheBit) {
  const LightState state = Random(1, 1000);
  SaveLight(folder_, 42, state);
  const std::optional<LightState> read = LoadLight(folder_, 42, 1000);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->total, state.total);
  EXPECT_EQ(read->direct, state.direct);
  ASSERT_EQ(read->volume.size(), state.volume.size());
  for (std::size_t i = 0; i < state.volume.size(); ++i) {
    EXPECT_EQ(read->volume.node(i).mean, state.volume.node(i).mean);
    EXPECT_EQ(read->volume.node(i).slope, state.volume.node(i).slope);
    EXPECT_EQ(read->volume.node(i).weight, state.volume.node(i).weight);
    EXPECT_EQ(read->volume.Position(i), state.volume.Position(i));
  }
}

TEST_F(KeptLight, OfAnotherKeyOrSizeIsNone) {
  EXPECT_FALSE(LoadLight(folder_, 42, 100));
  SaveLight(folder_, 42, Random(2, 100));
  EXPECT_FALSE(LoadLight(folder_, 43, 100));
  EXPECT_FALSE(LoadLight(folder_, 42, 101));
  EXPECT_TRUE(LoadLight(folder_, 42, 100));
}

/// A disc that dies, a copy that is cut: every byte that is wrong or missing is noticed.
TEST_F(KeptLight, ThatIsDamagedAnywhereIsNone) {
  SaveLight(folder_, 7, Random(3, 60));
  const fs::path file = OnlyFile();
  std::ifstream stream(file, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  const auto write = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    std::string bytes = whole;
    const std::size_t at = i < 64 ? static_cast<std::size_t>(i) : random() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 << random() % 8));
    write(bytes);
    EXPECT_FALSE(LoadLight(folder_, 7, 60)) << "byte " << at;
  }
  for (int i = 0; i < 50; ++i) {
    write(whole.substr(0, random() % whole.size()));
    EXPECT_FALSE(LoadLight(folder_, 7, 60));
  }
  write(whole);
  EXPECT_TRUE(LoadLight(folder_, 7, 60));
}

/// The checksum would tell, but after all that the header speaks of has been made room for.
TEST_F(KeptLight, ThatIsOfAnotherSizeThanItSaysIsNone) {
  SaveLight(folder_, 7, Random(3, 60));
  const fs::path file = OnlyFile();
  std::ofstream(file, std::ios::binary | std::ios::app) << "more";
  EXPECT_FALSE(LoadLight(folder_, 7, 60));
}

TEST_F(KeptLight, InAFolderThatCannotBeIsNoError) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  EXPECT_NO_THROW(SaveLight(folder_, 1, Random(5, 10)));
  EXPECT_FALSE(LoadLight(folder_, 1, 10));
}

/// Solved in the order of their keys, and then the oldest is used: the second one is in the way.
TEST_F(KeptLight, OfLongAgoMakesRoomForWhatIsUsed) {
  for (const std::uint64_t key : {1, 2, 3}) {
    SaveLight(folder_, key, Random(6, 100));
    fs::last_write_time(folder_ / fmt::format("light-{:016x}.bin", key),
                        fs::file_time_type::clock::now() - std::chrono::hours(9 - key));
  }
  std::ofstream(folder_ / "of-another.bin") << std::string(100'000, 'x');
  const std::uintmax_t one = fs::file_size(folder_ / fmt::format("light-{:016x}.bin", 1));
  EXPECT_TRUE(LoadLight(folder_, 1, 100));
  ShrinkLight(folder_, 3 * one);
  EXPECT_TRUE(HasLight(folder_, 1) && HasLight(folder_, 2) && HasLight(folder_, 3));
  ShrinkLight(folder_, 3 * one - 1);
  EXPECT_TRUE(HasLight(folder_, 1) && HasLight(folder_, 3));
  EXPECT_FALSE(HasLight(folder_, 2));
  ShrinkLight(folder_, 0);
  EXPECT_TRUE(HasLight(folder_, 1)) << "what was used last stays";
  EXPECT_FALSE(HasLight(folder_, 3));
  EXPECT_TRUE(fs::exists(folder_ / "of-another.bin"));
}

}  // namespace
}  // namespace aisle::sim
