#include "simulator/sensor/tone.h"

#include <gtest/gtest.h>

namespace aisle::sim {
namespace {

/// The companding as a count of codes: 256 steps of one 12-bit code, 128 of two, 384 of four, 256
/// of eight.
int CompandedCode(int code12) {
  int code10 = 0, reached = 0;
  for (const auto& [steps, size] :
       {std::pair(256, 1), std::pair(128, 2), std::pair(384, 4), std::pair(256, 8)}) {
    for (int i = 0; i < steps; ++i) {
      if (reached + size > code12) return code10;
      reached += size;
      ++code10;
    }
  }
  return code10;
}

TEST(Compand, IsTheTwelveToTenBitTable) {
  EXPECT_EQ(CompandedCode(4096), 1024);
  for (int code = 0; code <= 4096; ++code) {
    const double companded = 1024 * double{Compand(static_cast<float>(code) / 4096)};
    EXPECT_GE(companded, CompandedCode(code) - 1e-3) << code;
    EXPECT_LT(companded, CompandedCode(code) + 1) << code;
  }
}

TEST(Compand, RisesAndIsUndone) {
  float last = -1;
  for (int i = 0; i <= 10000; ++i) {
    const float share = static_cast<float>(i) / 10000;
    const float grey = Compand(share);
    EXPECT_GT(grey, last);
    EXPECT_NEAR(Expand(grey), share, 1e-6);
    last = grey;
  }
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace aisle::sim
