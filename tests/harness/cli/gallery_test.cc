// What a gallery takes, and what it leaves alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/io/file.h"
#include "tests/harness/cli/exit.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder of scenes, and one for the pages.
class GalleryTest : public testing::Test {
 protected:
  ~GalleryTest() override { fs::remove_all(folder_); }

  /// A scene whose lens bends straight lines, as of most cameras.
  void WriteBentScene() const {
    std::string text = ReadFile(AISLE_SOURCE_DIR "/scenes/smoke/bits.yaml");
    const std::string straight = "center_px: [156, 107]";
    text.replace(text.find(straight), straight.size(),
                 straight +
                     ", distortion: radial-tangential, "
                     "distortion_coefficients: [-0.2, 0.05, 0, 0]");
    WriteFileAtomically(scenes_ / "bent.yaml", text.substr(text.find('\n') + 1));
  }
  int Make(std::string* said, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"gallery", scenes_.string(), "--samples", "1",
                                      "-o",      out_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return Exit(words, said);
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_shown_{}", ::getpid());
  const fs::path scenes_ = folder_ / "scenes", out_ = folder_ / "out";
};

TEST_F(GalleryTest, TakesEveryLensAndLeavesOutWhatIsNoScene) {
  WriteBentScene();
  WriteFileAtomically(scenes_ / "camchain.yaml", "cam0:\n  camera_model: pinhole\n");
  WriteFileAtomically(scenes_ / "recorded.yaml", "recording: drive.mcap\n");
  WriteFileAtomically(scenes_ / "data/mav0/cam0/sensor.yaml", "sensor_type: camera\n");
  std::string said;
  EXPECT_EQ(Make(&said), kAllPassed) << said;
  EXPECT_THAT(ReadFile(out_ / "README.md"), HasSubstr("## bent\n"));
  EXPECT_TRUE(fs::exists(out_ / "bent.jpg"));
  EXPECT_THAT(said, HasSubstr("skipped"));
  EXPECT_EQ(Make(&said), kAllPassed) << "its own page may be made anew: " << said;
  EXPECT_EQ(Make(&said, {"--shares"}), kAllPassed) << said;
}

TEST_F(GalleryTest, APageThatItDidNotWriteStays) {
  WriteBentScene();
  WriteFileAtomically(out_ / "README.md", "# My project\n");
  std::string said;
  EXPECT_EQ(Make(&said), kBadInput);
  EXPECT_THAT(said, HasSubstr("README.md: not a gallery page"));
  EXPECT_EQ(ReadFile(out_ / "README.md"), "# My project\n");
  EXPECT_FALSE(fs::exists(out_ / "bent.jpg")) << "told before the first picture";
}

}  // namespace
}  // namespace aisle
