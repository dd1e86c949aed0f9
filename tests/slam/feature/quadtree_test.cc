#include "slam/feature/quadtree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace aisle::slam {
namespace {

std::vector<Corner> RandomCorners(int count, int width, int height) {
  std::mt19937 random(5);
  std::set<std::pair<int, int>> places;
  std::vector<Corner> corners;
  while (std::ssize(corners) < count) {
    const int x = static_cast<int>(random() % static_cast<unsigned>(width));
    const int y = static_cast<int>(random() % static_cast<unsigned>(height));
    if (!places.insert({x, y}).second) continue;
    corners.push_back({x, y, static_cast<float>(random() % 40)});  // many ties
  }
  return corners;
}

bool Same(const std::vector<Corner>& a, const std::vector<Corner>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Corner& p, const Corner& q) {
    return p.x == q.x && p.y == q.y && p.response == q.response;
  });
}

TEST(DistributeCorners, GivesExactlyTheBudgetWhereThereAreEnough) {
  const std::vector<Corner> corners = RandomCorners(3000, 700, 430);
  for (const int count : {0, 1, 2, 3, 50, 777, 2999, 3000}) {
    EXPECT_EQ(std::ssize(DistributeCorners(corners, count)), count);
  }
}

TEST(DistributeCorners, GivesEveryCornerWhereThereAreTooFew) {
  EXPECT_EQ(DistributeCorners(RandomCorners(20, 700, 430), 1200).size(), 20u);
  EXPECT_TRUE(DistributeCorners({}, 1200).empty());
}

TEST(DistributeCorners, DoesNotDependOnTheOrderOfItsInput) {
  std::vector<Corner> corners = RandomCorners(2000, 700, 430);
  const std::vector<Corner> chosen = DistributeCorners(corners, 300);
  std::mt19937 random(9);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(corners.begin(), corners.end(), random);
    EXPECT_TRUE(Same(DistributeCorners(corners, 300), chosen));
  }
}

TEST(DistributeCorners, SpreadsWhereStrengthAloneWouldCrowd) {
  // A dense strong cluster beside a sparse weak field: each quarter must keep its share.
  std::vector<Corner> corners;
  for (int i = 0; i < 1000; ++i) corners.push_back({i % 40, i / 40, 100});
  for (int i = 0; i < 100; ++i) corners.push_back({256 + 25 * (i % 10), 256 + 25 * (i / 10), 10});
  const std::vector<Corner> chosen = DistributeCorners(corners, 110);
  const auto weak = std::count_if(chosen.begin(), chosen.end(),
                                  [](const Corner& corner) { return corner.response == 10; });
  EXPECT_GT(weak, 60);
}

TEST(DistributeCorners, KeepsTheStrongestOfAll) {
  const std::vector<Corner> corners = RandomCorners(2000, 700, 430);
  const auto strength = [](const Corner& a, const Corner& b) { return a.response < b.response; };
  const float strongest = std::max_element(corners.begin(), corners.end(), strength)->response;
  const std::vector<Corner> chosen = DistributeCorners(corners, 1);
  EXPECT_EQ(chosen.front().response, strongest);
}

TEST(DistributeCorners, TakesACornerGivenTwice) {
  const std::vector<Corner> corners(10, Corner{5, 6, 1});
  EXPECT_LE(DistributeCorners(corners, 3).size(), 3u);
}

}  // namespace
}  // namespace aisle::slam
