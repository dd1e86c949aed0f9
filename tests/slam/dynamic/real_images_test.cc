// Real stereo pictures of static scenes: nothing may crash and next to nothing may be masked.

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "slam/dynamic/paper/paper_method.h"
#include "slam/dynamic/robust/robust_method.h"
#include "tests/support/test_data.h"

namespace aisle::slam::dynamic {
namespace {

StereoPair KittiPair(int k) {
  const std::string folder = TestData("kitti/sequences/06/");
  const std::string name = fmt::format("{:06d}.png", k);
  return {cv::imread(folder + "image_0/" + name, cv::IMREAD_GRAYSCALE),
          cv::imread(folder + "image_1/" + name, cv::IMREAD_GRAYSCALE)};
}

StereoPair EurocPair(int k) {
  const std::string folder = TestData("euroc-loop-pairs/");
  return {cv::imread(fmt::format("{}left_img_{}.png", folder, k), cv::IMREAD_GRAYSCALE),
          cv::imread(fmt::format("{}right_img_{}.png", folder, k), cv::IMREAD_GRAYSCALE)};
}

double MaskedShare(const StereoPair& previous, const StereoPair& current) {
  const cv::Mat1b mask = DetectDynamicRegions(previous, current, {}).dynamic.mask;
  return static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
}

TEST(PaperOnRealImages, Kitti06IsLeftAlmostUntouched) {
  if (KittiPair(0).left.empty()) GTEST_SKIP() << "no KITTI 06 at " << TestData("kitti");
  double sum = 0;
  int pairs = 0;
  for (int k = 5; k < 51; k += 5, ++pairs) sum += MaskedShare(KittiPair(k - 1), KittiPair(k));
  std::cout << "KITTI 06: " << 100 * sum / pairs << " % of the pixels masked on average\n";
  EXPECT_LT(sum / pairs, 0.05);
}

TEST(PaperOnRealImages, RevisitsFarApartDoNotCrash) {
  if (EurocPair(0).left.empty()) GTEST_SKIP() << "no pairs at " << TestData("euroc-loop-pairs");
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l < 4; ++l) {
      const double share = MaskedShare(EurocPair(k), EurocPair(l));
      std::cout << "EuRoC " << k << " -> " << l << ": " << 100 * share << " % masked\n";
      EXPECT_LT(share, 1.0);
    }
  }
}

StereoCamera KittiCamera() { return {1226, 370, 707.0912, 707.0912, 601.8873, 183.1104, 0.5372}; }

TEST(RobustOnRealImages, Kitti06IsLeftAloneAndItsMotionFound) {
  if (KittiPair(0).left.empty()) GTEST_SKIP() << "no KITTI 06 at " << TestData("kitti");
  RobustState state;
  double sum = 0, travelled_m = 0;
  const int frames = 30;
  for (int k = 0; k < frames; ++k) {
    RobustResult result = StepRobust(state, KittiPair(k), k * 100'000'000LL, {}, KittiCamera(), {});
    sum += static_cast<double>(cv::countNonZero(result.dynamic.mask)) /
           static_cast<double>(result.dynamic.mask.total());
    if (k > 0 && result.state.motion) {
      travelled_m += result.state.motion->T_now_before.translation().norm();
    }
    state = std::move(result.state);
  }
  std::cout << "KITTI 06: " << 100 * sum / frames << " % of the pixels masked on average, "
            << travelled_m << " m travelled\n";
  EXPECT_LT(sum / frames, 0.01);
  EXPECT_NEAR(travelled_m, 59.86 * (frames - 1) / 49, 0.1 * travelled_m);
}

TEST(RobustOnRealImages, RevisitsFarApartDoNotCrash) {
  if (EurocPair(0).left.empty()) GTEST_SKIP() << "no pairs at " << TestData("euroc-loop-pairs");
  RobustState state;
  for (int k = 0; k < 8; ++k) {
    RobustResult result = StepRobust(state, EurocPair(k % 4), k * 50'000'000LL, {}, {}, {});
    const double share = static_cast<double>(cv::countNonZero(result.dynamic.mask)) /
                         static_cast<double>(result.dynamic.mask.total());
    std::cout << "EuRoC jump " << k << ": " << 100 * share << " % masked\n";
    EXPECT_LT(share, 0.01);
    state = std::move(result.state);
  }
}

}  // namespace
}  // namespace aisle::slam::dynamic
