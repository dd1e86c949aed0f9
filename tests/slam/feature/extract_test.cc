#include "slam/feature/extract.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "slam/feature/corners.h"
#include "tests/slam/stereo/synthetic_view.h"

namespace aisle::slam {
namespace {

cv::Mat1b TexturedImage() {
  const Texture texture(11);
  return Render(
      {752, 480}, [&](double u, double v) { return texture(u, v); }, 4);
}

TEST(ExtractFeatures, SpendsItsBudget) {
  const ImageFeatures image = ExtractFeatures(TexturedImage(), {}, {});
  EXPECT_EQ(image.features.size(), 1200);
  EXPECT_EQ(image.features.keypoints.size(), image.features.descriptors.size());
  EXPECT_EQ(image.pyramid.size(), 8);
}

TEST(ExtractFeatures, PutsNothingOnTheMaskAndSpendsTheBudgetElsewhere) {
  cv::Mat1b mask(480, 752, std::uint8_t{0});
  cv::rectangle(mask, cv::Rect(100, 0, 350, 480), 255, cv::FILLED);
  const FeatureOptions options;
  const ImageFeatures image = ExtractFeatures(TexturedImage(), mask, options);
  EXPECT_EQ(image.features.size(), 1200);
  for (const Keypoint& keypoint : image.features.keypoints) {
    const double margin =
        options.mask_margin_px * image.pyramid.scales[static_cast<std::size_t>(keypoint.level)];
    const double x = keypoint.pixel.x;
    EXPECT_TRUE(x < 100 - 0.9 * margin || x > 449 + 0.9 * margin) << "x " << x;
  }
}

TEST(ExtractFeatures, AFullMaskLeavesNothing) {
  const cv::Mat1b mask(480, 752, std::uint8_t{255});
  EXPECT_EQ(ExtractFeatures(TexturedImage(), mask, {}).features.size(), 0);
}

TEST(ExtractFeatures, TakesImagesWithoutAnyFeature) {
  for (const int grey : {0, 128, 255}) {
    const cv::Mat1b image(480, 752, static_cast<std::uint8_t>(grey));
    EXPECT_EQ(ExtractFeatures(image, {}, {}).features.size(), 0);
  }
}

/// A line on the floor along which the rig drives: its corners are the pixels' own, and go with it.
TEST(DetectCorners, NoneLiesOnAStraightEdge) {
  cv::Mat1b image(480, 752, std::uint8_t{60});
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      if (v > 150 + 0.37 * u) image(v, u) = 220;
    }
  }
  const cv::Rect box(500, 60, 60, 60);
  cv::rectangle(image, box, 220, cv::FILLED);
  cv::GaussianBlur(image, image, {}, 1);
  cv::Mat1b noise(image.size());
  cv::RNG(3).fill(noise, cv::RNG::NORMAL, 20, 4);
  image += noise;
  FeatureOptions options;
  const auto on_the_line = [&] {
    int on_line = 0, at_box = 0;
    for (const Corner& corner : DetectCorners(image, options)) {
      const auto near = [&](int u, int v) { return std::hypot(corner.x - u, corner.y - v) < 4; };
      const bool of_box = near(500, 60) || near(559, 60) || near(500, 119) || near(559, 119);
      at_box += of_box;
      on_line += std::abs(corner.y - (150 + 0.37 * corner.x)) < 3;
    }
    EXPECT_GE(at_box, 4);
    return on_line;
  };
  EXPECT_EQ(on_the_line(), 0);
  options.least_corner_ratio = 0;
  EXPECT_GT(on_the_line(), 20);
}

/// Cameras often deliver both images in one, side by side.
TEST(ExtractFeatures, OfPartOfAnImageAreThoseOfThatPartAlone) {
  FeatureOptions options;
  options.features = 8000;  // so many that some lie at the edge
  const cv::Mat1b pair = TexturedImage();
  const cv::Mat1b left = pair(cv::Rect(0, 0, 376, 480)), inner = pair(cv::Rect(100, 60, 500, 360));
  for (const cv::Mat1b& part : {left, inner}) {
    const Features within = ExtractFeatures(part, {}, options).features;
    const Features alone = ExtractFeatures(part.clone(), {}, options).features;
    ASSERT_EQ(within.size(), alone.size());
    for (std::size_t i = 0; i < alone.keypoints.size(); ++i) {
      EXPECT_EQ(within.keypoints[i].pixel, alone.keypoints[i].pixel);
      EXPECT_EQ(within.keypoints[i].angle_deg, alone.keypoints[i].angle_deg);
      EXPECT_EQ(within.descriptors[i], alone.descriptors[i]) << alone.keypoints[i].pixel;
    }
  }
}

TEST(ExtractFeatures, TakesSmallAndNarrowImages) {
  const cv::Mat1b image = TexturedImage();
  for (const cv::Size size : {cv::Size(64, 64), cv::Size(64, 480), cv::Size(752, 40)}) {
    const ImageFeatures found = ExtractFeatures(image(cv::Rect({0, 0}, size)).clone(), {}, {});
    EXPECT_GT(found.pyramid.size(), 0);
    EXPECT_GT(found.features.size(), 0);
  }
}

TEST(ExtractFeatures, FindsFaintCornersWhereThereAreNoStrongOnes) {
  const Texture texture(11);
  const auto faint = [&](double u, double v) {
    return u < 376 ? texture(u, v) : 128 + 0.15 * (texture(u, v) - 128);
  };
  const ImageFeatures image = ExtractFeatures(Render({752, 480}, faint), {}, {});
  const auto& keypoints = image.features.keypoints;
  EXPECT_GT(std::count_if(keypoints.begin(), keypoints.end(),
                          [](const Keypoint& keypoint) { return keypoint.pixel.x > 392; }),
            30);
}

TEST(ExtractFeatures, DescriptorsRecogniseTheShiftedImage) {
  const Texture texture(11);
  const cv::Mat1b a = Render(
      {752, 480}, [&](double u, double v) { return texture(u, v); }, 4, 1);
  const cv::Mat1b b = Render(
      {752, 480}, [&](double u, double v) { return texture(u + 20, v); }, 4, 2);
  const Features from = ExtractFeatures(a, {}, {}).features;
  const Features to = ExtractFeatures(b, {}, {}).features;
  int matched = 0, right = 0;
  for (int i = 0; i < from.size(); ++i) {
    int best = 257, found = -1;
    for (int j = 0; j < to.size(); ++j) {
      const int distance = HammingDistance(from.descriptors[static_cast<std::size_t>(i)],
                                           to.descriptors[static_cast<std::size_t>(j)]);
      if (distance < best) best = distance, found = j;
    }
    if (best > 30) continue;
    ++matched;
    const cv::Point2f shift = from.keypoints[static_cast<std::size_t>(i)].pixel -
                              to.keypoints[static_cast<std::size_t>(found)].pixel;
    const double scale = std::pow(1.2, from.keypoints[static_cast<std::size_t>(i)].level);
    right += std::hypot(shift.x - 20, shift.y) < 3 * scale;
  }
  // The best of 1200 under 30 bits: mostly right without any ratio or cross check.
  EXPECT_GT(matched, 200);
  EXPECT_GT(right, 0.9 * matched);
}

TEST(Pyramid, LevelsShowTheSamePlaces) {
  const Pyramid pyramid = BuildPyramid(TexturedImage(), {});
  for (int level = 0; level < pyramid.size(); ++level) {
    const cv::Mat1b& image = pyramid.levels[static_cast<std::size_t>(level)];
    const cv::Point2d first = pyramid.ToFull({-0.5, -0.5}, level);
    const cv::Point2d last = pyramid.ToFull({image.cols - 0.5, image.rows - 0.5}, level);
    EXPECT_NEAR(first.x, -0.5, 1e-9);  // image edges meet image edges
    EXPECT_NEAR(last.x, 751.5, 1e-9);
    EXPECT_NEAR(last.y, 479.5, 1e-9);
    const cv::Point2d there_and_back = pyramid.ToLevel(pyramid.ToFull({17.25, 3}, level), level);
    EXPECT_NEAR(there_and_back.x, 17.25, 1e-9);
  }
}

TEST(ShareBudget, IsSpentWhollyAndNeverExceedsALevel) {
  for (const std::vector<int>& available :
       {std::vector<int>{5000, 4000, 3000}, {10, 4000, 3000}, {10, 20, 30}, {0, 0, 1200}, {}}) {
    const std::vector<int> share = ShareBudget(available, 1200, 1.2);
    const int total = std::accumulate(available.begin(), available.end(), 0);
    EXPECT_EQ(std::accumulate(share.begin(), share.end(), 0), std::min(1200, total));
    for (std::size_t i = 0; i < share.size(); ++i) EXPECT_LE(share[i], available[i]);
  }
}

}  // namespace
}  // namespace aisle::slam
