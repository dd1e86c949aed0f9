#include "simulator/mesh/kept/kept_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/simulator/mesh/scratch.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

Model Triangle(const Scratch& scratch, float side) {
  return ImportModel(
      scratch.Write("t.obj", fmt::format("v 0 0 0\nv {} 0 0\nv 0 {} 0\nf 1 2 3\n", side, side)));
}

TEST(KeepModel, MeshAndRecordAreBothNewOrNeitherIs) {
  const Scratch scratch;
  const fs::path file = scratch.path() / "kept.aislemesh", record = file.string() + ".json";
  const Model old = Triangle(scratch, 1), other = Triangle(scratch, 2);
  KeepModel(old, {}, file);
  const std::string bytes = TextOf(file), text = TextOf(record);
  for (const fs::path& broken : {file, record}) {
    const fs::path in_the_way = broken.string() + ".part";
    fs::create_directory(in_the_way);
    EXPECT_THROW(KeepModel(other, {}, file), ImportError) << broken;
    EXPECT_EQ(TextOf(file), bytes) << broken;
    EXPECT_EQ(TextOf(record), text) << broken;
    fs::remove(in_the_way);
    EXPECT_FALSE(fs::exists(file.string() + ".part")) << broken;
    EXPECT_FALSE(fs::exists(record.string() + ".part")) << broken;
  }
  EXPECT_EQ(OpenUserModel(file).mesh.positions, old.mesh.positions);
  KeepModel(other, {}, file);
  EXPECT_EQ(OpenUserModel(file).mesh.positions, other.mesh.positions);
}

/// What is kept of a scene from run to run is known by the bytes of the files it names.
TEST(OpenUserModel, TakesAllOfItFromTheFileThatIsNamed) {
  const Scratch scratch;
  const fs::path file = scratch.Write("hall.gltf", R"({"asset": {"version": "2.0"},
      "buffers": [{"byteLength": 3, "uri": "hall%20one.bin"}]})");
  scratch.Write("hall one.bin", "123");
  try {
    OpenUserModel(file);
    FAIL() << "it was read";
  } catch (const ImportError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("it names a separate file, hall one.bin"));
  }
}

TEST(KeepModel, AFolderInTheRecordsPlaceLeavesNoMesh) {
  const Scratch scratch;
  const fs::path file = scratch.path() / "kept.aislemesh";
  fs::create_directory(file.string() + ".json");
  EXPECT_THROW(KeepModel(Triangle(scratch, 1), {}, file), ImportError);
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace aisle::sim
