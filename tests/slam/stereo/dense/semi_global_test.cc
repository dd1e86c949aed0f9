#include "slam/stereo/dense/semi_global.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "slam/dynamic/paper/disparity.h"
#include "slam/stereo/dense/census_cost.h"
#include "slam/stereo/dense/choose_disparity.h"
#include "slam/stereo/dense/cost_paths.h"
#include "tests/slam/dynamic/synthetic_stereo.h"
#include "tests/slam/stereo/dense/disparity_agreement.h"

namespace aisle::slam::dynamic {
namespace {

using std::uint8_t;

cv::Mat1b Noise(cv::Size size, unsigned seed, int most = 255) {
  std::mt19937 random(seed);
  cv::Mat1b image(size);
  for (uint8_t& grey : image)
    grey = static_cast<uint8_t>(random() % (static_cast<unsigned>(most) + 1));
  return image;
}

int At(const cv::Mat1b& image, int y, int x) {
  return image(std::clamp(y, 0, image.rows - 1), std::clamp(x, 0, image.cols - 1));
}

/// Whether the k-th pixel of the 5x5 window around (y, x) is darker than its middle.
bool Darker(const cv::Mat1b& image, int y, int x, int k) {
  return At(image, y + k / 5 - 2, x + k % 5 - 2) < At(image, y, x);
}

int BitsThatDiffer(const cv::Mat1b& left, const cv::Mat1b& right, int y, int x, int d) {
  y = std::clamp(y, 0, left.rows - 1);
  x = std::clamp(x, 0, left.cols - 1);
  int bits = 0;
  for (int k = 0; k < 25; ++k) {
    bits += Darker(left, y, x, k) != Darker(right, y, std::max(x - d, 0), k) ? 1 : 0;
  }
  return bits;
}

int CostByDefinition(const cv::Mat1b& left, const cv::Mat1b& right, int y, int x, int d) {
  int sum = 0;
  for (int k = 0; k < 9; ++k) sum += BitsThatDiffer(left, right, y + k / 3 - 1, x + k % 3 - 1, d);
  return sum / 4;
}

TEST(CensusCosts, AreWhatTheDefinitionSays) {
  const cv::Mat1b left = Noise({41, 7}, 1), right = Noise({41, 7}, 2);
  for (const int disparities : {32, 64}) {
    std::vector<uint8_t> costs(static_cast<std::size_t>(3 * 41 * disparities));
    CensusCosts(CensusTransform(left), CensusTransform(right), 4, 7, disparities, costs.data());
    std::size_t at = 0;
    for (int y = 4; y < 7; ++y) {
      for (int x = 0; x < 41; ++x) {
        for (int d = 0; d < disparities; ++d) {
          ASSERT_EQ(costs[at++], CostByDefinition(left, right, y, x, d))
              << y << " " << x << " " << d;
        }
      }
    }
  }
}

/// Equation (13) as it is printed, for one path: L(p, d) = C(p, d) + min(L(p-1, d), L(p-1, d-1) +
/// P1, L(p-1, d+1) + P1, min L(p-1) + P2) - min L(p-1).
std::vector<int> PathByDefinition(const std::vector<uint8_t>& costs, int disparities,
                                  const std::vector<uint8_t>& contrasts, const StepPrices& prices) {
  std::vector<int> path(costs.begin(), costs.end());
  const auto size = static_cast<std::size_t>(disparities);
  for (std::size_t p = 1; p < contrasts.size(); ++p) {
    const int* before = path.data() + (p - 1) * size;
    const int least = *std::min_element(before, before + disparities);
    for (int d = 0; d < disparities; ++d) {
      int best = least + prices.large[contrasts[p]];
      for (int other = 0; other < disparities; ++other) {
        const int step = std::abs(other - d);
        if (step <= 1) best = std::min(best, before[other] + step * prices.small);
      }
      path[p * size + static_cast<std::size_t>(d)] += best - least;
    }
  }
  return path;
}

TEST(CostPaths, AreTheRecursionOfThePaper) {
  constexpr int kPaths = 3, kPixels = 30, kMostCost = 54;
  StepPrices prices{.small = 7};
  for (std::size_t grey = 0; grey < 256; ++grey) {
    prices.large[grey] = static_cast<uint8_t>(73 - grey / 4);
  }
  for (const int disparities : {32, 64, 96, 128}) {
    CostPaths paths(kPaths, disparities, prices);
    std::mt19937 random(5);
    std::vector<std::vector<uint8_t>> costs(kPaths), contrasts(kPaths), sums(kPaths);
    const auto size = static_cast<std::size_t>(disparities);
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      std::vector<uint8_t> cost(kPaths * size), sum(kPaths * size, 100), contrast(kPaths);
      for (uint8_t& one : cost) one = static_cast<uint8_t>(random() % (kMostCost + 1));
      for (uint8_t& one : contrast) one = static_cast<uint8_t>(random() % 256);
      const PathPixels pixels{cost.data(), disparities, contrast.data(), sum.data(), disparities};
      pixel % 2 == 0 ? paths.AdvanceAndAdd(pixels) : paths.AdvanceAndSet(pixels);
      for (std::size_t k = 0; k < kPaths; ++k) {
        const auto from = static_cast<std::ptrdiff_t>(k * size), to = from + disparities;
        costs[k].insert(costs[k].end(), cost.begin() + from, cost.begin() + to);
        sums[k].insert(sums[k].end(), sum.begin() + from, sum.begin() + to);
        contrasts[k].push_back(contrast[k]);
      }
    }
    for (std::size_t k = 0; k < kPaths; ++k) {
      const auto expected = PathByDefinition(costs[k], disparities, contrasts[k], prices);
      for (std::size_t at = 0; at < expected.size(); ++at) {
        const int was = at / size % 2 == 0 ? 100 : 0;  // what the even ones were added to
        ASSERT_EQ(sums[k][at], was + expected[at]) << disparities << " " << k << " " << at;
      }
    }
  }
}

Winner Choose(const std::vector<uint8_t>& some, const std::vector<uint8_t>& others, int percent) {
  Winner winner;
  ChooseDisparities(some.data(), others.data(), 1, static_cast<int>(some.size()), percent, &winner);
  return winner;
}

TEST(ChooseDisparities, TakesTheFirstOfTheLeastUnlessAnotherIsNearlyAsCheap) {
  std::mt19937 random(3);
  for (const std::size_t disparities : {32, 64, 96, 128}) {
    for (int round = 0; round < 200; ++round) {
      std::vector<uint8_t> some(disparities), others(disparities);
      const unsigned range = round % 2 == 0 ? 6 : 250;
      for (uint8_t& one : some) one = static_cast<uint8_t>(random() % range);
      for (uint8_t& one : others) one = static_cast<uint8_t>(random() % range);
      std::vector<int> sums(disparities);
      for (std::size_t d = 0; d < disparities; ++d) sums[d] = some[d] + others[d];
      const auto best = std::min_element(sums.begin(), sums.end()) - sums.begin();
      bool unique = true;
      for (std::ptrdiff_t d = 0; d < std::ssize(sums); ++d) {
        const auto sum = sums[static_cast<std::size_t>(d)];
        if (std::abs(d - best) > 1 && sum * 80 < sums[static_cast<std::size_t>(best)] * 100)
          unique = false;
      }
      const Winner winner = Choose(some, others, 20);
      ASSERT_EQ(winner.disparity, best);
      ASSERT_EQ(winner.cost, sums[static_cast<std::size_t>(best)]);
      ASSERT_EQ(winner.sixteenths >= 0, unique);
      ASSERT_LE(unique ? std::abs(winner.sixteenths - 16 * best) : 0, 8);
    }
  }
}

TEST(ChooseDisparities, LiesBetweenWholeDisparitiesWhereLinesOfOneSlopeMeet) {
  for (int at = 10 * 16; at <= 11 * 16; ++at) {  // |16 d - at|: lines that meet at `at`
    std::vector<uint8_t> some(32), none(32, 0);
    for (int d = 0; d < 32; ++d) {
      some[static_cast<std::size_t>(d)] =
          static_cast<uint8_t>(std::min(std::abs(16 * d - at), 250));
    }
    EXPECT_NEAR(Choose(some, none, 0).sixteenths, at, 1);
  }
}

TEST(CheckRightToLeft, ForgetsWhatTheRightImageSeesOtherwise) {
  std::vector<Winner> winners(8);
  const auto set = [&](std::size_t x, int disparity, int cost) {
    winners[x] = {static_cast<std::uint16_t>(cost), static_cast<std::int16_t>(16 * disparity),
                  static_cast<uint8_t>(disparity)};
  };
  set(7, 5, 10);  // both see the right image's column 2, this one better
  set(4, 2, 20);
  set(3, 1, 30);
  set(6, 1, 10);  // nobody else claims column 5
  set(1, 3, 10);  // beyond the right image
  std::vector<std::int16_t> found(8);
  CheckRightToLeft(winners.data(), 8, 1, -16, found.data());
  EXPECT_EQ(found, (std::vector<std::int16_t>{-16, -16, -16, -16, -16, -16, 16, 80}));
}

test::SyntheticView Hall() {
  return test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0);
}

TEST(MatchSemiGlobally, AgreesWithTheTruthAsWellAsTheLibrary) {
  const auto view = Hall();
  const auto own = test::Compare(MatchSemiGlobally(view.left, view.right, {.max_disparity_px = 96}),
                                 view.disparity);
  const auto library = test::Compare(ComputeDisparity(view.left, view.right, {}), view.disparity);
  EXPECT_GT(own.known, 0.85);
  EXPECT_GT(own.close, library.close - 0.005);
}

TEST(MatchSemiGlobally, NeverPointsBeyondTheRightImage) {
  const cv::Mat1b left = Noise({200, 30}, 4), right = Noise({200, 30}, 5);
  const cv::Mat1f disparity = MatchSemiGlobally(left, right, {.speckle_px = 0});
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) ASSERT_LE(disparity(y, x), static_cast<float>(x));
  }
}

TEST(MatchSemiGlobally, FindsAWholeShiftExactly) {
  const cv::Mat1b wide = Noise({240, 40}, 6);
  const cv::Mat1f disparity =
      MatchSemiGlobally(wide(cv::Rect(0, 0, 200, 40)), wide(cv::Rect(20, 0, 200, 40)), {});
  const cv::Mat1f inner = disparity(cv::Rect(30, 3, 160, 34));
  EXPECT_LT(cv::norm(inner, cv::Mat1f(inner.size(), 20.0F), cv::NORM_INF), 0.5);
}

TEST(MatchSemiGlobally, IsTheSameForAnyNumberOfThreads) {
  const auto view = Hall();
  std::vector<cv::Mat1f> found;
  for (const std::size_t threads : {1, 2, 3, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    found.push_back(MatchSemiGlobally(view.left, view.right, {}));
  }
  for (const cv::Mat1f& one : found) EXPECT_EQ(cv::norm(one, found[0], cv::NORM_INF), 0);
}

TEST(MatchSemiGlobally, IsTheSameUnderOtherGainAndOffsetOfACamera) {
  const cv::Mat1b left = Noise({150, 40}, 7, 120), right = Noise({150, 40}, 8, 120);
  cv::Mat1b brighter;
  right.convertTo(brighter, CV_8U, 2, 10);
  EXPECT_EQ(cv::norm(MatchSemiGlobally(left, right, {}), MatchSemiGlobally(left, brighter, {}),
                     cv::NORM_INF),
            0);
}

TEST(MatchSemiGlobally, TakesImagesSmallerThanWindowAndDisparities) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 2), cv::Size(50, 1), cv::Size(1, 50)}) {
    const cv::Mat1f disparity = MatchSemiGlobally(Noise(size, 9), Noise(size, 10), {});
    ASSERT_EQ(disparity.size(), size);
    for (int x = 0; x < size.width; ++x) EXPECT_LE(disparity(0, x), static_cast<float>(x));
  }
}

TEST(MatchSemiGlobally, SaysTheSameEverywhereOnAPlainImage) {
  const cv::Mat1b plain(60, 120, uint8_t{90});
  const cv::Mat1f disparity = MatchSemiGlobally(plain, plain, {});
  EXPECT_EQ(cv::norm(disparity, cv::Mat1f(plain.size(), disparity(30, 60)), cv::NORM_INF), 0);
}

TEST(SemiGlobalOptions, NameTheBrokenRule) {
  EXPECT_EQ(Validate(SemiGlobalOptions{}), "");
  EXPECT_NE(Validate(SemiGlobalOptions{.max_disparity_px = 48}), "");
  EXPECT_NE(Validate(SemiGlobalOptions{.p2 = 74}), "");
  EXPECT_NE(Validate(SemiGlobalOptions{.p1 = 71}), "");
}

}  // namespace
}  // namespace aisle::slam::dynamic
