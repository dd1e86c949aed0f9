#include "harness/io/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class ReadLinearImageTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "temp");
    ::setenv("OPENCV_TEMP_PATH", (folder_ / "temp").c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("OPENCV_TEMP_PATH");
    fs::remove_all(folder_);
  }
  fs::path Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text, Durability::kSurvivesProcessLoss);
    return folder_ / name;
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_image_{}", ::getpid());
};

TEST_F(ReadLinearImageTest, GivesTheRowsOfAPortableFloatMapFromTheTop) {
  // Bottom row first; red, green, blue.
  const float values[] = {1, 2, 3, 4, 5, 6};
  std::string text = "PF\n1 2\n-1.0\n";
  text.append(reinterpret_cast<const char*>(values), sizeof(values));
  const cv::Mat3f image = ReadLinearImage(Write("image.pfm", text));
  ASSERT_EQ(image.size(), cv::Size(1, 2));
  EXPECT_EQ(image(0, 0), cv::Vec3f(6, 5, 4));
  EXPECT_EQ(image(1, 0), cv::Vec3f(3, 2, 1));
}

TEST_F(ReadLinearImageTest, OfABrokenFileLeavesNothingBehind) {
  for (const char* text : {"PF\n 2\n-1.0\n2 2\n", "Pf\n2 0\n0\n", "PF\n2 2\n-1.0\nshort", "exr"}) {
    const fs::path file = Write("broken.pfm", text);
    EXPECT_THROW(ReadLinearImage(file), InputError) << text;
  }
  EXPECT_TRUE(fs::is_empty(folder_ / "temp"));
}

TEST_F(ReadLinearImageTest, SaysWhatKeepsItFromTheFile) {
  EXPECT_THROW(ReadLinearImage(folder_ / "absent.pfm"), InputError);
  EXPECT_THROW(ReadLinearImage(Write("image.png", "PF\n1 1\n-1.0\n0000")), InputError);
}

}  // namespace
}  // namespace aisle
