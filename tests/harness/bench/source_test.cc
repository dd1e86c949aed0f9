#include "harness/bench/source.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// A folder with a scene of that many frames, all by one name.
class KeptFramesTest : public testing::Test {
 protected:
  ~KeptFramesTest() override { fs::remove_all(folder_); }

  std::size_t FramesOf(const std::string& place, int frames, int from = 0,
                       int to = std::numeric_limits<int>::max()) const {
    const fs::path file = folder_ / place / "bits.yaml";
    std::string text = ReadFile(AISLE_SOURCE_DIR "/scenes/smoke/bits.yaml");
    text.replace(text.find("frames: 8"), 9, fmt::format("frames: {}", frames));
    WriteFileAtomically(file, text.substr(text.find('\n') + 1));  // less the editor's line
    const BenchView view{.text = "bits",
                         .path = file.string(),
                         .scene = "bits",
                         .assets_dir = AISLE_SOURCE_DIR "/assets",
                         .from = from,
                         .to = to};
    return OpenSource(view, {.frames_dir = (folder_ / "frames").string()})->Schedule().size();
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_bench_{}", ::getpid());
};

TEST_F(KeptFramesTest, AreThoseOfTheSceneAsItIsWrittenNow) {
  EXPECT_EQ(FramesOf("a", 3), 3u);
  EXPECT_EQ(FramesOf("a", 5), 5u);  // edited
  EXPECT_EQ(FramesOf("b", 4), 4u);  // another of the same name
  const auto kept = [&] {
    return std::distance(fs::directory_iterator(folder_ / "frames"), fs::directory_iterator());
  };
  EXPECT_EQ(kept(), 3);
  EXPECT_EQ(FramesOf("c", 3), 3u);  // the first again, written elsewhere
  EXPECT_EQ(kept(), 3);
}

TEST_F(KeptFramesTest, AStretchBeyondTheEndIsRefused) {
  EXPECT_EQ(FramesOf("a", 3, 1, 3), 3u);
  for (const auto& [from, to] : {std::pair(1, 4), std::pair(7, 9)}) {
    try {
      FramesOf("a", 3, from, to);
      ADD_FAILURE() << from << "-" << to;
    } catch (const InputError& refused) {
      EXPECT_EQ(
          std::string(refused.what()),
          fmt::format("bits: it ends before frame {}; its frames are 0 to 2, all of them 0-3", to));
    }
  }
}

}  // namespace
}  // namespace aisle
