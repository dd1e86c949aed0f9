#include "harness/score/boundary.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

cv::Mat1b Square(int x, int y, int side) {
  cv::Mat1b mask(100, 100, static_cast<unsigned char>(0));
  mask(cv::Rect(x, y, side, side)) = 255;
  return mask;
}

TEST(BoundaryTest, TheSameMaskAgreesFully) {
  const BoundaryCounts counts = CompareBoundaries(Square(30, 30, 20), Square(30, 30, 20));
  EXPECT_EQ(counts.truth, 4 * 19);
  EXPECT_DOUBLE_EQ(*BoundaryF(counts), 1);
}

TEST(BoundaryTest, AShiftWithinTheToleranceCostsNothingAndBeyondItMuch) {
  EXPECT_DOUBLE_EQ(*BoundaryF(CompareBoundaries(Square(30, 30, 20), Square(32, 30, 20))), 1);
  EXPECT_LT(*BoundaryF(CompareBoundaries(Square(30, 30, 20), Square(40, 40, 20))), 0.4);
  EXPECT_DOUBLE_EQ(*BoundaryF(CompareBoundaries(Square(10, 10, 20), Square(70, 70, 20))), 0);
}

TEST(BoundaryTest, IsSymmetric) {
  const cv::Mat1b a = Square(30, 30, 20), b = Square(36, 33, 25);
  EXPECT_DOUBLE_EQ(*BoundaryF(CompareBoundaries(a, b)), *BoundaryF(CompareBoundaries(b, a)));
}

TEST(BoundaryTest, EmptyMasksHaveNoOutlineToJudge) {
  const cv::Mat1b none(100, 100, static_cast<unsigned char>(0));
  EXPECT_FALSE(BoundaryF(CompareBoundaries(none, none)).has_value());
  EXPECT_DOUBLE_EQ(*BoundaryF(CompareBoundaries(Square(5, 5, 9), none)), 0);
}

}  // namespace
}  // namespace aisle
