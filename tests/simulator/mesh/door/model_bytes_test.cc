#include "simulator/mesh/door/model_bytes.h"

#include <gmock/gmock.h>
#include <xxhash.h>

#include <cstring>
#include <random>

#include "tests/simulator/mesh/mutants.h"
#include "tests/simulator/mesh/scratch.h"

namespace aisle::sim {
namespace {

Model Asset(const std::string& name) {
  return ImportModel(std::filesystem::path(AISLE_SOURCE_DIR) / "assets" / (name + ".glb"));
}

/// Bytes that somebody has changed who knows how the checksum is made.
std::string Sealed(std::string bytes) {
  constexpr std::size_t kHeader = 32, kSizeAt = 16, kChecksumAt = 24;
  const std::uint64_t size = bytes.size() - kHeader;
  const std::uint64_t checksum = XXH3_64bits(bytes.data() + kHeader, size);
  std::memcpy(bytes.data() + kSizeAt, &size, sizeof(size));
  std::memcpy(bytes.data() + kChecksumAt, &checksum, sizeof(checksum));
  return bytes;
}

std::string ErrorIn(const std::string& bytes) {
  try {
    DecodeModel(bytes, {});
  } catch (const ImportError& error) {
    return error.what();
  }
  return "";
}

TEST(ModelBytes, GiveBackEveryModelToTheLastBit) {
  for (const char* name : {"people/worker_anton", "vehicles/forklift", "kit/drum"}) {
    const Model model = Asset(name);
    const std::string bytes = EncodeModel(model);
    const Model back = DecodeModel(bytes, {});
    EXPECT_EQ(EncodeModel(back), bytes) << name;
    EXPECT_EQ(back.mesh.triangles, model.mesh.triangles);
    ASSERT_EQ(back.textures.size(), model.textures.size());
    for (std::size_t i = 0; i < back.textures.size(); ++i) {
      EXPECT_EQ(cv::norm(back.textures[i].image, model.textures[i].image, cv::NORM_INF), 0);
    }
    ASSERT_EQ(back.clips.size(), model.clips.size());
    for (std::size_t i = 0; i < back.clips.size(); ++i) {
      EXPECT_EQ(back.clips[i].name, model.clips[i].name);
    }
  }
}

TEST(ModelBytes, DamagedAreRefused) {
  const std::string bytes = EncodeModel(Asset("kit/drum"));
  EXPECT_THAT(ErrorIn(""), testing::HasSubstr("end too early"));
  EXPECT_THAT(ErrorIn(std::string(40, 'x')), testing::HasSubstr("not a model's"));
  EXPECT_THAT(ErrorIn(bytes.substr(0, bytes.size() - 1)), testing::HasSubstr("as many as they"));
  std::string other = bytes;
  other[other.size() / 2] = static_cast<char>(other[other.size() / 2] ^ 1);
  EXPECT_THAT(ErrorIn(other), testing::HasSubstr("checksum"));
  EXPECT_THAT(ErrorIn(Sealed(bytes + "more")), testing::HasSubstr("something follows"));
}

/// A reader that was taken over can seal what it likes: the checksum is no defence then, the checks
/// behind it are.
TEST(ModelBytes, SealedByAnEnemyAreSoundOrRefused) {
  const Scratch scratch;
  const std::string bytes = EncodeModel(ImportModel(scratch.Write("whole.dae", kCollada)));
  int taken = 0, refused = 0;
  for (unsigned seed = 0; seed < 5'000; ++seed) {
    std::mt19937 random(seed);
    std::string mutant = bytes;
    for (std::size_t edits = 1 + random() % 3; edits > 0; --edits) {
      const std::size_t at = 32 + random() % (mutant.size() - 36);
      const std::uint32_t words[] = {0, 0xFFFFFFFF, 0x7F800000, 0x7FC00000, 0x7FFFFFFF, 65536};
      const auto word =
          static_cast<std::uint32_t>(random() % 2 == 0 ? words[random() % 6] : random());
      std::memcpy(mutant.data() + at, &word, random() % 4 + 1);
    }
    try {
      const Model model = DecodeModel(Sealed(mutant), {});
      for (const auto& corners : model.mesh.triangles) {
        for (const std::uint32_t corner : corners) ASSERT_LT(corner, model.mesh.positions.size());
      }
      ++taken;
    } catch (const ImportError&) {
      ++refused;
    }
  }
  EXPECT_GT(taken, 250);
  EXPECT_GT(refused, 250);
}

TEST(ModelBytes, AListMayNotBeLongerThanItsBytes) {
  std::string bytes = EncodeModel(Asset("kit/drum"));
  const std::uint64_t many = std::uint64_t{1} << 60;
  std::memcpy(bytes.data() + 32, &many, sizeof(many));  // of the name
  EXPECT_THAT(ErrorIn(Sealed(bytes)), testing::HasSubstr("longer than its bytes"));
}

/// A list in memory is larger than its bytes: of 8 MB that claimed to be channels came 400.
TEST(ModelBytes, AFalseCountTakesNoMemory) {
  Model model = Asset("kit/drum");
  model.clips = {{.name = "the clip", .duration_s = 1, .channels = {}}};
  std::string bytes = EncodeModel(model);
  const std::size_t count_at =
      bytes.find("the clip") + std::string("the clip").size() + sizeof(float);
  bytes += std::string(std::size_t{8} << 20, '\0');
  const std::uint64_t many = bytes.size() / 40;  // of a channel's 64
  std::memcpy(bytes.data() + count_at, &many, sizeof(many));
  EXPECT_THAT(ErrorIn(Sealed(bytes)), testing::HasSubstr("longer than its bytes"));
}

}  // namespace
}  // namespace aisle::sim
