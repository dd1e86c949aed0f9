#include "simulator/mesh/door/read_model.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>

#include "simulator/mesh/door/model_bytes.h"
#include "tests/simulator/mesh/mutants.h"
#include "tests/simulator/mesh/scratch.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

const fs::path kAssets = fs::path(AISLE_SOURCE_DIR) / "assets";

std::string ErrorAtTheDoor(const fs::path& file, const ModelDoor& door = {}) {
  try {
    ReadModel(file, {}, door);
  } catch (const ImportError& error) {
    return error.what();
  }
  return "";
}

/// A program of ours in the reader's place.
ModelDoor Behind(const Scratch& scratch, const std::string& script) {
  ModelDoor door;
  door.program = scratch.Write("reader", "#!/bin/sh\n" + script);
  ::chmod(door.program.c_str(), 0755);
  door.limits.time_s = 2;
  door.most_bytes = 1'000'000;
  return door;
}

TEST(ReadModel, GivesWhatReadingItHereGives) {
  for (const char* name : {"people/worker_anton", "vehicles/forklift", "kit/drum"}) {
    const fs::path file = kAssets / (std::string(name) + ".glb");
    for (const Band band : {Band::kLuminance, Band::kRed}) {
      ImportOptions options;
      options.band = band;
      options.root = kAssets;
      EXPECT_EQ(EncodeModel(ReadModel(file, options)), EncodeModel(ImportModel(file, options)))
          << name;
    }
  }
}

TEST(ReadModel, SaysWhatReadingItHereSays) {
  const Scratch scratch;
  scratch.Write("inside.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 9,
      "uri": "../outside.bin"}]})");
  for (const fs::path& file :
       {scratch.Write("none.glb", ""), scratch.Write("text.glb", "v 0 0 0\n"),
        scratch.Write("bad.obj", "v 0 0\n"), scratch.Write("x.stl", "solid"),
        scratch.Write("bad.dae", "<COLLADA>"), scratch.path() / "absent.glb",
        scratch.path() / "inside.gltf"}) {
    EXPECT_EQ(ErrorAtTheDoor(file), ErrorOf(file));
    EXPECT_THAT(ErrorAtTheDoor(file), testing::StartsWith(file.string() + ": "));
  }
}

TEST(ReadModel, OneFileAloneIsHeldToThatBehindTheDoorToo) {
  const Scratch scratch;
  const fs::path file = scratch.Write("parts.gltf", R"({"asset": {"version": "2.0"},
      "buffers": [{"byteLength": 9, "uri": "parts.bin"}]})");
  scratch.Write("parts.bin", "123456789");
  ImportOptions alone;
  alone.one_file = true;
  const std::string error = ErrorOf(file, alone);
  EXPECT_THAT(error, testing::HasSubstr("it names a separate file, parts.bin"));
  EXPECT_THAT(ErrorOf(file), testing::Not(testing::HasSubstr("separate")));
  try {
    ReadModel(file, alone);
    FAIL() << "it was read";
  } catch (const ImportError& refused) {
    EXPECT_EQ(refused.what(), error);
  }
}

TEST(ReadModel, WhateverHappensToTheReaderIsOneError) {
  const Scratch scratch;
  const fs::path file = scratch.Write("m.glb", "glTF");
  const std::pair<const char*, const char*> ends[] = {
      {"kill -SEGV $$", "did not survive it (signal 11"},
      {"kill -ABRT $$", "did not survive it (signal 6"},
      {"sleep 60", "is not read after 2 s"},
      {"exec >&- 2>&-; sleep 60", "is not read after 2 s"},
      {"exec cat /dev/zero", "holds more than 1000000 bytes"},
      {"echo hello", "end too early"},
      {"head -c 100 /dev/urandom", "are not a model's"},
      {"printf 'one\\033[31m two\\nthree' >&2; exit 4", "m.glb: one [31m two"}};
  for (const auto& [script, error] : ends) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(ErrorAtTheDoor(file, Behind(scratch, script)), testing::HasSubstr(error)) << script;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_LT(took.count(), 20) << script;
  }
}

TEST(ReadModel, AMachineThatFailsItIsNotTheFilesFault) {
  const Scratch scratch;
  const fs::path file = scratch.Write("m.glb", "glTF");
  ModelDoor none;
  none.program = scratch.path() / "none";
  EXPECT_THROW(ReadModel(file, {}, none), std::system_error);
  EXPECT_THROW(ReadModel(file, {}, Behind(scratch, "exit 3")), std::system_error);
}

TEST(ReadModel, AReaderThatMeetsAPictureIsStartedAgainWithADecoderAndOnlyOnce) {
  const Scratch scratch;
  const fs::path file = scratch.Write("m.glb", "glTF");
  const ModelDoor twice =
      Behind(scratch, "test \"${16}\" = 1 || exit 6; echo it has a decoder >&2; exit 4");
  EXPECT_EQ(ErrorAtTheDoor(file, twice), file.string() + ": it has a decoder");
  EXPECT_THROW(ReadModel(file, {}, Behind(scratch, "exit 6")), std::system_error);
}

TEST(ReadModel, AReaderIsLinkedWithoutTheDecodersOfPictures) {
  // They are nine tenths of what it costs to start one.
  const std::string list = fmt::format("readelf -d \"{}\" | grep -q ", ReaderProgram().string());
  ASSERT_EQ(std::system((list + "opencv_core").c_str()), 0);
  EXPECT_NE(std::system((list + "opencv_imgcodecs").c_str()), 0);
}

TEST(ReadModel, MemoryThatAFileAsksForIsNotTaken) {
  if (!BoundsMemory()) GTEST_SKIP() << "no memory bound under a sanitizer";
  const Scratch scratch;
  ModelDoor door;
  door.limits.memory_bytes = std::size_t{64} << 20;  // less than the program itself takes
  const fs::path file = kAssets / "people/worker_anton.glb";
  try {
    ReadModel(file, {}, door);
    ADD_FAILURE() << "it had enough memory";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("worker_anton.glb: "));
  }
}

TEST(ReadModel, MemoryThatAFileMayNotHaveIsTheFilesFault) {
  if (!BoundsMemory()) GTEST_SKIP() << "no memory bound under a sanitizer";
  // Somewhere between what the program takes and what the model does.
  const fs::path file = kAssets / "people/worker_anton.glb";
  int refused = 0, read = 0;
  for (std::size_t mib = 32; mib <= 1024 && read == 0; mib += 8) {
    ModelDoor door;
    door.limits.memory_bytes = mib << 20;
    try {
      ReadModel(file, {}, door);
      ++read;
    } catch (const ImportError& error) {
      refused +=
          std::string(error.what()).find("more memory than it may have") != std::string::npos;
    } catch (const std::exception&) {  // not enough for the program itself
    }
  }
  EXPECT_EQ(read, 1);
  EXPECT_GT(refused, 0);
}

template <class Mutate>
void TryMutants(const Scratch& scratch, const std::string& name, const std::string& whole,
                const Mutate& mutate) {
  int taken = 0, refused = 0, lost = 0;
  const int count = MutantsWanted(10);
  for (int seed = 0; seed < count; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const fs::path file = scratch.Write(name, mutate(whole, &random));
    const std::string error = ErrorAtTheDoor(file);
    taken += error.empty();
    refused += !error.empty();
    if (error.empty()) continue;
    EXPECT_THAT(error, testing::StartsWith(file.string() + ": ")) << "seed " << seed;
    EXPECT_GT(error.size(), file.string().size() + 10) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    if (error.find("did not survive") == std::string::npos) continue;
    ++lost;
    std::printf("%s, seed %d: %s\n", name.c_str(), seed, error.c_str());
  }
  std::printf("%s: %d taken, %d refused, %d of them because the reader died\n", name.c_str(), taken,
              refused, lost);
  EXPECT_GT(refused, 0) << "nothing was tried";
  EXPECT_EQ(lost, 0) << "stopped at the door, and to be mended in the reader";
}

class DoorMutants : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(std::system(fmt::format("\"{}\" \"{}/tests/support/gltf_models.py\" \"{}\"",
                                      AISLE_PYTHON, AISLE_SOURCE_DIR, scratch.path().string())
                              .c_str()),
              0);
  }
  const Scratch scratch;
};

TEST_F(DoorMutants, OfGlb) {
  TryMutants(scratch, "m.glb", TextOf(scratch.path() / "same_names.glb"), MutatedGlb);
}

TEST_F(DoorMutants, OfGltf) {
  TryMutants(scratch, "m.gltf", TextOf(scratch.path() / "text_inline.gltf"), MutatedText);
}

TEST_F(DoorMutants, OfObj) {
  scratch.Write("m.mtl", kMtl);
  TryMutants(scratch, "m.obj", kObj, MutatedText);
}

TEST_F(DoorMutants, OfCollada) { TryMutants(scratch, "m.dae", kCollada, MutatedText); }

}  // namespace
}  // namespace aisle::sim
