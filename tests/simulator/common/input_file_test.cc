#include "simulator/common/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace aisle::sim {
namespace {

using testing::HasSubstr;

TEST(InputFile, IsAFileThatEnds) {
  const std::filesystem::path folder = testing::TempDir(), file = folder / "aisle_input_file.txt";
  std::ofstream(file) << "12345";
  EXPECT_EQ(InputFileError(file, 5), "");
  EXPECT_THAT(InputFileError(file, 4), HasSubstr("has 5 bytes, and at most 4 are read"));
  EXPECT_EQ(InputFileError(folder / "none.txt", 5),
            (folder / "none.txt").string() + ": no such file");
  EXPECT_THAT(InputFileError(folder, 5), HasSubstr("is a folder"));
  EXPECT_THAT(InputFileError("/dev/zero", 5), HasSubstr("is a device"));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace aisle::sim
