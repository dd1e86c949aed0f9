#include "slam/dynamic/robust/unseen_columns.h"

#include <gtest/gtest.h>

#include "slam/stereo/dense/semi_global.h"
#include "tests/slam/dynamic/robust/usual_tolerance.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kUnseen = 60;
const auto kFull = static_cast<float>(FieldOptions{}.coupling);

/// Something close by whose first 60 columns the right camera does not see, 120x80 pixels. It
/// begins at column 20, before a wall.
struct CloseBy {
  cv::Mat1f disparity = cv::Mat1f(80, 120, 70.0F);
  cv::Mat1b image = cv::Mat1b(80, 120, 180);
  std::vector<int> unseen = std::vector<int>(80, kUnseen);
  CloseBy() {
    disparity.colRange(0, kUnseen).setTo(kNoDisparity);
    image.colRange(0, 20).setTo(90);
  }
  Links links() const {
    const cv::Mat1f filled(disparity.size(), 70.0F);
    const cv::Mat1b floor(disparity.size(), static_cast<unsigned char>(0));
    Links links = LinkPixels(filled, image, floor, test::kUsualTolerance, {});
    LinkUnseen(disparity, unseen, {}, &links);
    return links;
  }
};

TEST(LinkUnseen, TiesSomethingCloseByTogetherAndToWhatBothSee) {
  const Links links = CloseBy().links();
  for (int x = 20; x < 119; ++x) EXPECT_EQ(links.right(10, x), kFull) << x;
  for (int x = 20; x < 119; ++x) EXPECT_EQ(links.down(10, x), kFull) << x;
}

TEST(LinkUnseen, EndsAtTheOutline) {
  const Links links = CloseBy().links();
  for (int y = 0; y < 80; ++y) EXPECT_EQ(links.right(y, 19), 0) << y;
  EXPECT_EQ(links.right(10, 10), kFull);  // the wall keeps the ties that it had
}

TEST(LinkUnseen, AFewRowsOfPrintAreNoOutline) {
  CloseBy close;
  close.image(cv::Rect(34, 30, 6, 7)).setTo(60);
  const Links links = close.links();
  for (int y = 25; y < 42; ++y) {
    for (int x = 20; x < 119; ++x) EXPECT_EQ(links.right(y, x), kFull) << x << ", " << y;
    EXPECT_EQ(links.right(y, 19), 0) << y;
  }
}

TEST(LinkUnseen, AFewRowsInWhichTheOutlineIsFaintDoNotLeak) {
  CloseBy close;
  close.image.rowRange(30, 37).setTo(180);
  const Links links = close.links();
  for (int y = 25; y < 42; ++y) EXPECT_EQ(links.right(y, 19), 0) << y;
  // Nor by way of the rows around, where the outline is slanted.
  CloseBy slanted;
  for (int y = 0; y < 80; ++y) slanted.image.row(y).colRange(20, 20 + y / 4).setTo(90);
  const Links ties = slanted.links();
  int leaks = 0;
  for (int y = 10; y < 70; ++y) {
    for (int x = 0; x < kUnseen; ++x) {
      const bool within = slanted.image(y, x) == 180, below = slanted.image(y + 1, x) == 180;
      leaks += within != below && ties.down(y, x) > 0.2F * kFull;
    }
  }
  EXPECT_EQ(leaks, 0);
}

TEST(LinkUnseen, LeavesAMatchAndRowsThatSeeAllAsTheyWere) {
  CloseBy close;
  close.disparity(cv::Rect(30, 0, 4, 80)).setTo(2.0F);  // seen past it
  close.unseen[50] = 0;
  close.image.row(50).colRange(40, 120).setTo(90);
  const cv::Mat1b floor(close.disparity.size(), static_cast<unsigned char>(0));
  Links links = LinkPixels(close.disparity, close.image, floor, test::kUsualTolerance, {});
  const Links before{links.right.clone(), links.down.clone()};
  LinkUnseen(close.disparity, close.unseen, {}, &links);
  EXPECT_EQ(links.right(10, 29), before.right(10, 29));
  EXPECT_EQ(links.right(10, 31), before.right(10, 31));
  EXPECT_EQ(links.right(50, 39), before.right(50, 39));
}

/// Disparities of 60x40 pixels: a wall at 4, of which the right image shows what is right of column
/// 8, and from row 20 on a person at 25 between some columns.
cv::Mat1f WallAndPerson(const cv::Range& person) {
  cv::Mat1f disparity(40, 60, 4.0F);
  disparity.colRange(0, 8).setTo(kNoDisparity);
  disparity.rowRange(20, 40).colRange(0, person.start).setTo(kNoDisparity);
  disparity.rowRange(20, 40).colRange(person).setTo(25);
  return disparity;
}

TEST(UnseenColumns, AreThoseOfTheNearestThingThatIsCut) {
  const std::vector<int> unseen = UnseenColumns(WallAndPerson({30, 45}), 80);
  ASSERT_EQ(unseen.size(), 80U);
  EXPECT_EQ(unseen[10], 16);
  EXPECT_EQ(unseen[70], 60);
  // Nothing is cut of who stands farther from the edge, and what hides behind is not the edge's.
  EXPECT_EQ(UnseenColumns(WallAndPerson({40, 50}), 80)[70], 0);
  cv::Mat1f both = WallAndPerson({40, 50});
  both(cv::Rect(8, 20, 15, 20)).setTo(4);
  EXPECT_EQ(UnseenColumns(both, 80)[70], 16);
}

TEST(UnseenColumns, AChanceMatchIsNoEdge) {
  cv::Mat1f disparity = WallAndPerson({30, 45});
  disparity.rowRange(20, 40).colRange(10, 12).setTo(3);
  EXPECT_EQ(UnseenColumns(disparity, 80)[70], 60);
  EXPECT_EQ(UnseenColumns(cv::Mat1f(40, 60, kNoDisparity), 80), std::vector<int>(80, 0));
}

TEST(UnseenColumns, OddRowsHaveThemToo) {
  const std::vector<int> unseen = UnseenColumns(WallAndPerson({30, 45}), 81);
  ASSERT_EQ(unseen.size(), 81U);
  EXPECT_EQ(unseen[80], 60);
}

TEST(AsMostAround, FillsAFewRowsAndNoMore) {
  std::vector<int> unseen(60, 0);
  std::fill(unseen.begin() + 20, unseen.begin() + 50, 40);
  unseen[30] = unseen[31] = 0;
  const std::vector<int> most = AsMostAround(unseen);
  EXPECT_EQ(most[30], 40);
  EXPECT_EQ(most[31], 40);
  EXPECT_EQ(std::count(most.begin(), most.begin() + 15, 0), 15);
  EXPECT_EQ(std::count(most.begin() + 55, most.end(), 0), 5);
  // One row of a chance match makes no neighbours.
  std::vector<int> lone(60, 0);
  lone[30] = 40;
  EXPECT_EQ(AsMostAround(lone), lone);
}

}  // namespace
}  // namespace aisle::slam::dynamic
