#include "harness/report/page/resources.h"

#include <gtest/gtest.h>

#include "harness/io/file.h"

namespace aisle {
namespace {

TEST(ResourcesTest, TheProgramHoldsTheFilesByteForByte) {
  const std::filesystem::path folder = AISLE_SOURCE_DIR "/harness/report/page";
  EXPECT_EQ(kScript, ReadFile(folder / "report.js"));
  EXPECT_EQ(kStyleSheet, ReadFile(folder / "style.css"));
}

}  // namespace
}  // namespace aisle
