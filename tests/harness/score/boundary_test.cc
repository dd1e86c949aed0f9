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

/// DAVIS's F written out pixel by pixel, as its definition has it.
double DavisF(const cv::Mat1b& truth, const cv::Mat1b& answer, double radius_px) {
  const auto at = [](const cv::Mat1b& mask, int y, int x) {
    return y < mask.rows && x < mask.cols && mask(y, x) != 0;
  };
  const auto outline = [&](const cv::Mat1b& mask) {
    std::vector<cv::Point> points;
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        const bool right = x + 1 < mask.cols && at(mask, y, x) != at(mask, y, x + 1);
        const bool below = y + 1 < mask.rows && at(mask, y, x) != at(mask, y + 1, x);
        const bool across =
            x + 1 < mask.cols && y + 1 < mask.rows && at(mask, y, x) != at(mask, y + 1, x + 1);
        if (right || below || across) points.emplace_back(x, y);
      }
    }
    return points;
  };
  const std::vector<cv::Point> a = outline(truth), b = outline(answer);
  const auto share = [&](const std::vector<cv::Point>& of, const std::vector<cv::Point>& near) {
    const auto met = std::count_if(of.begin(), of.end(), [&](cv::Point p) {
      return std::any_of(near.begin(), near.end(),
                         [&](cv::Point q) { return cv::norm(p - q) <= radius_px; });
    });
    return static_cast<double>(met) / static_cast<double>(of.size());
  };
  const double recall = share(a, b), precision = share(b, a);
  return 2 * recall * precision / (recall + precision);
}

TEST(BoundaryTest, ReachesTheValueOfDavis) {
  cv::Mat1b truth = Square(20, 30, 50), answer = Square(22, 27, 44);
  truth(cv::Rect(60, 0, 12, 40)) = 255;  // up to the image's border
  answer(cv::Rect(80, 85, 20, 15)) = 255;
  const BoundaryRule rule = DavisRule(truth.size());
  EXPECT_EQ(rule.tolerance_px, 2);  // 0.008 of 141 pixels, rounded up
  const double f = *BoundaryF(CompareBoundaries(truth, answer, rule));
  EXPECT_NEAR(f, DavisF(truth, answer, 2), 1e-12);
  EXPECT_GT(f, 0.1);
  EXPECT_LT(f, 0.9);
  EXPECT_EQ(DavisRule({854, 480}).tolerance_px, 8);
}

}  // namespace
}  // namespace aisle
