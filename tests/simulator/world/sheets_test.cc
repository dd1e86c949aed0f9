#include "simulator/world/sheets.h"

#include <gtest/gtest.h>

#include <random>

#include "simulator/world/canvas.h"

namespace aisle::sim {
namespace {

cv::Mat1b Noise(int width, int height, unsigned seed, double mean, double sigma) {
  std::mt19937 random(seed);
  std::normal_distribution<double> grey(mean, sigma);
  cv::Mat1b picture(height, width);
  for (std::uint8_t& pixel : picture) pixel = cv::saturate_cast<std::uint8_t>(grey(random));
  return picture;
}

int MedianOf(const cv::Mat1b& picture) {
  std::vector<std::uint8_t> greys(picture.begin(), picture.end());
  std::ranges::sort(greys);
  return greys[(greys.size() - 1) / 2];
}

/// It is a rising curve of the grey alone that keeps the median, takes no more than the limit's
/// share off anything, and draws what is near the median together by that share.
TEST(Plainer, DrawsGreysTowardsTheMedianAndKeepsTheirOrder) {
  constexpr float kShare = 0.25f;
  constexpr int kLimit = 40;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const cv::Mat1b picture = Noise(97, 61, seed, 60 + 15.0 * seed, 30);
    const cv::Mat1b plainer = Plainer(picture, kShare, kLimit);
    const int median = MedianOf(picture);
    EXPECT_EQ(MedianOf(plainer), median) << seed;
    std::map<int, std::set<int>> curve;
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) curve[picture(y, x)].insert(plainer(y, x));
    }
    int before = -1;
    for (const auto& [grey, becomes] : curve) {
      ASSERT_EQ(becomes.size(), 1u) << "one grey becomes one grey";
      const int now = *becomes.begin();
      EXPECT_GE(now, before);
      EXPECT_LE(std::abs(now - grey), (1 - kShare) * kLimit + 0.5);
      if (std::abs(grey - median) <= kLimit) {
        EXPECT_NEAR(now - median, kShare * static_cast<float>(grey - median), 0.51);
      }
      before = now;
    }
    EXPECT_EQ(cv::norm(Plainer(picture, 1, kLimit), picture, cv::NORM_INF), 0);
  }
}

/// Sheets tile floors and walls: what a noise adds on one side fits what it adds on the other.
TEST(Canvas, NoiseGoesOnAcrossTheBorders) {
  Canvas canvas(128, 96, 0.5f);
  canvas.Noise(Dice(3, {}), 8, 6, 0.4f);
  const cv::Mat1b picture = canvas.Finish();
  int inside = 0, across = 0;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 1; x < picture.cols; ++x) {
      inside = std::max(inside, std::abs(picture(y, x) - picture(y, x - 1)));
    }
    across = std::max(across, std::abs(picture(y, 0) - picture(y, picture.cols - 1)));
  }
  EXPECT_LE(across, inside);
  EXPECT_GT(inside, 0);
  double least = 0, most = 0;
  cv::minMaxLoc(picture, &least, &most);
  EXPECT_GE(least, std::floor(255 * 0.1));
  EXPECT_LE(most, std::ceil(255 * 0.9));
}

TEST(Canvas, PaintCoversItsShareOfThePictureAtItsOpacity) {
  const auto mean_after = [](const auto& paint) {
    Canvas canvas(400, 300, 0.2f);
    paint(&canvas);
    return cv::mean(canvas.Finish())[0] / 255;
  };
  for (const float opacity : {0.0f, 0.3f, 1.0f}) {
    const double gain = opacity * (0.8 - 0.2);
    EXPECT_NEAR(mean_after([&](Canvas* c) { c->Fill(0.25f, 0.5f, 0.5f, 0.2f, 0.8f, opacity); }),
                0.2 + gain * 0.1, 2e-3);
    // A disc's radius is a share of the width: 400 * 0.1 = 40 pixels.
    EXPECT_NEAR(mean_after([&](Canvas* c) { c->Disc(0.5f, 0.5f, 0.1f, 0.8f, opacity); }),
                0.2 + gain * CV_PI * 40 * 40 / (400.0 * 300), 3e-3);
    EXPECT_NEAR(
        mean_after([&](Canvas* c) { c->Line(0.2f, 0.5f, 0.8f, 0.5f, 0.05f, 0.8f, opacity); }),
        0.2 + gain * (240 + 15) * 20 / (400.0 * 300), 4e-3)
        << "with its round ends";
  }
  EXPECT_NEAR(mean_after([](Canvas* c) { c->Polygon({{0, 0}, {1, 0}, {0, 1}}, 0.8f); }), 0.5, 5e-3);
  EXPECT_NEAR(mean_after([](Canvas* c) { c->Disc(3, 3, 0.1f, 0.8f); }), 0.2, 2e-3) << "outside";
}

TEST(WornFloor, WearsByItsSeedAndMoreWithMoreWear) {
  const cv::Mat1b clean(600, 600, std::uint8_t{128});
  const auto changed = [&](std::uint64_t seed, double wear) {
    const cv::Mat1b worn = WornFloor(clean, Dice(seed, {}), wear);
    return cv::countNonZero(worn != clean);
  };
  // New, it has its two saw-cut joints: one pixel (0.22 %) of each side.
  EXPECT_EQ(changed(1, 0), 2 * 600 - 1);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    EXPECT_LT(changed(seed, 0), changed(seed, 0.3)) << seed;
    EXPECT_LT(changed(seed, 0.3), changed(seed, 1)) << seed;
  }
  EXPECT_EQ(cv::norm(WornFloor(clean, Dice(4, {}), 1), WornFloor(clean, Dice(4, {}), 1)), 0);
  EXPECT_GT(cv::norm(WornFloor(clean, Dice(4, {}), 1), WornFloor(clean, Dice(5, {}), 1)), 0);
}

TEST(HatchSheet, IsHalfPaintAndTiles) {
  const cv::Mat1b sheet = HatchSheet(Dice(1, {}), 0);
  const double painted = cv::countNonZero(sheet > 170) / static_cast<double>(sheet.total());
  EXPECT_NEAR(painted, 0.5, 0.02);
  EXPECT_GT(cv::mean(LinePaintSheet(Dice(1, {}), 0))[0], cv::mean(sheet)[0] + 30);
}

}  // namespace
}  // namespace aisle::sim
