#include "slam/common/median.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

TEST(Median, IsTheMiddleValueInWhateverOrder) {
  EXPECT_EQ(Median<int>({5, 1, 9}), 5);
  EXPECT_EQ(Median<int>({9, 1, 7, 5}), 7);  // the upper of the two
  EXPECT_EQ(Median<int>({4}), 4);
  EXPECT_EQ(Median<int>({}), 0);
}

}  // namespace
}  // namespace aisle::slam
