#include "harness/record/copy_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <random>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class CopyRunTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_copy_{}", ::getpid());
  const RunSpec spec_{.scene = "s", .scene_file = "", .system = BuiltIn("plain"), .seed = 3};
};

/// A file of several pieces, the last of which is not full.
TEST_F(CopyRunTest, EveryFileArrivesByteByByteWhateverItsSize) {
  const fs::path run = folder_ / "a/runs" / RunId(spec_);
  std::string bytes((std::size_t{3} << 20) + 17, ' ');
  std::mt19937_64 random(1);
  for (char& byte : bytes) byte = static_cast<char>(random());
  WriteFileAtomically(run / "bag/large.mcap", bytes);
  WriteFileAtomically(run / "empty.txt", "");
  WriteFileAtomically(run / "result.json", "{}");
  CopyRun(spec_, folder_ / "a", folder_ / "b");
  const fs::path copy = folder_ / "b/runs" / RunId(spec_);
  EXPECT_TRUE(ReadFile(copy / "bag/large.mcap") == bytes);
  EXPECT_EQ(ReadFile(copy / "empty.txt"), "");
  EXPECT_EQ(ReadFile(copy / "result.json"), "{}");
  for (const auto& entry : fs::recursive_directory_iterator(copy)) {
    EXPECT_NE(entry.path().filename().string().front(), '.') << "nothing is left aside";
  }
}

TEST_F(CopyRunTest, ARunThatIsNotThereIsNotCopied) {
  EXPECT_THROW(CopyRun(spec_, folder_ / "a", folder_ / "b"), InputError);
  EXPECT_FALSE(fs::exists(folder_ / "b"));
}

}  // namespace
}  // namespace aisle
