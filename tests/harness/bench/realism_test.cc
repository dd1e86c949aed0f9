#include "harness/bench/realism.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>
#include <opencv2/core.hpp>

#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

TEST(CountWithinTest, TheRealSetsSpanTheRangeAndTheUnknownHaveNoPart) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::vector<PictureSet> real = {{"a", 1, {1, 5}}, {"b", 1, {3, unknown}}};
  const std::vector<PictureSet> given = {
      {"c", 1, {1, 5}}, {"d", 1, {2, 4}}, {"e", 1, {3.1, unknown}}};
  EXPECT_EQ(CountWithin(real, given, 0).within, 2);
  EXPECT_EQ(CountWithin(real, given, 0).known, 3);
  EXPECT_EQ(CountWithin(real, given, 1).within, 1);
  EXPECT_EQ(CountWithin(real, given, 1).known, 2);
}

TEST(FindPicturesTest, TheLeftCameraOfADatasetIsFoundInItsLayout) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_find_{}", ::getpid());
  EXPECT_THROW(FindPictures(folder), InputError);
  const cv::Mat1b image(4, 4, static_cast<unsigned char>(7));
  for (const char* name : {"2.png", "1.png"}) WriteImage(folder / "mav0/cam0/data" / name, image);
  const std::vector<fs::path> files = FindPictures(folder);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].filename(), "1.png");
  for (const char* name : {"left_1.png", "right_1.png"}) WriteImage(folder / name, image);
  ASSERT_EQ(FindPictures(folder).size(), 1u);
  EXPECT_EQ(FindPictures(folder)[0].filename(), "left_1.png");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace aisle
