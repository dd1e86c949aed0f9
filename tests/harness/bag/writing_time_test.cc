// A measurement, by hand: a bag costs no more than a fifth above what EuRoC's folder of the same
// frames does. Processor time of both writers in one process, frame by frame in turn, so that both
// meet the same machine.
#include <gtest/gtest.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>

#include "harness/bag/drive_bag.h"
#include "harness/io/dataset.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 752, kHeight = 480;

double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A picture as compressors meet them: shades, edges, and a sensor's noise of a grey level.
cv::Mat1b Picture(std::uint64_t seed) {
  cv::RNG rng(seed);
  cv::Mat1b picture(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int shade = 60 + x / 9 + ((x / 40 + y / 30 + static_cast<int>(seed)) % 3) * 35;
      picture(y, x) = cv::saturate_cast<std::uint8_t>(shade + rng.gaussian(1.2));
    }
  }
  return picture;
}

SequenceFrame FrameNumber(int id) {
  SequenceFrame frame;
  frame.images.id = id;
  frame.images.stamp_ns = id * 50'000'000LL;
  frame.images.left = Picture(static_cast<std::uint64_t>(2 * id));
  frame.images.right = Picture(static_cast<std::uint64_t>(2 * id + 1));
  FrameTruth truth;
  truth.T_world_rig.translation().x() = 0.05 * id;
  truth.depth = cv::Mat1f(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      truth.depth(y, x) = 2 + 0.01f * static_cast<float>(y) + static_cast<float>((x / 150) % 2);
    }
  }
  truth.dynamic = cv::Mat1b(kHeight, kWidth, std::uint8_t{0});
  truth.dynamic_right = truth.dynamic;
  truth.depth_right = truth.depth;
  truth.actor = truth.actor_right = truth.dynamic;
  frame.truth = truth;
  return frame;
}

class WritingTime : public testing::TestWithParam<bool> {};

TEST_P(WritingTime, OfABagIsThatOfAFolderAndAFifth) {
  const bool with_truth = GetParam();
  const char* given = std::getenv("AISLE_WRITTEN_FRAMES");
  if (given == nullptr) GTEST_SKIP() << "a measurement: set AISLE_WRITTEN_FRAMES=360 to take it";
  const int frames = std::atoi(given);
  const fs::path folder = fs::path(testing::TempDir()) / fmt::format("writing-time-{}", getpid());
  fs::create_directories(folder / "bag");
  StereoCalibration calibration;
  calibration.width = kWidth;
  calibration.height = kHeight;
  calibration.fx = calibration.fy = 435.2;
  calibration.cx = 367.2;
  calibration.cy = 252.2;
  calibration.baseline_m = 0.12;
  std::vector<FrameRequest> schedule;
  for (int id = 0; id < frames; ++id) {
    FrameRequest request;
    request.id = id;
    request.stamp_ns = id * 50'000'000LL;
    request.T_world_rig.translation().x() = 0.05 * id;
    schedule.push_back(request);
  }
  ExportOptions options;
  options.truth.depth = options.truth.dynamic = with_truth;
  DatasetWriter euroc(folder / "euroc", calibration, 20, schedule, options);
  euroc.Begin();
  DriveBag bag(folder / "bag/drive.mcap", calibration, {});
  double euroc_s = 0, bag_s = 0;
  for (int id = 0; id < frames; ++id) {
    SequenceFrame frame = FrameNumber(id);
    if (!with_truth) frame.truth->depth = cv::Mat1f(), frame.truth->dynamic = cv::Mat1b();
    const double begin = ProcessorSeconds();
    euroc.Add(frame);
    const double between = ProcessorSeconds();
    bag.AddFrame(frame);
    euroc_s += between - begin;
    bag_s += ProcessorSeconds() - between;
  }
  double at = ProcessorSeconds();
  euroc.Finish([](std::int64_t) { return Eigen::Isometry3d::Identity(); });
  euroc_s += ProcessorSeconds() - at;
  at = ProcessorSeconds();
  bag.Finish();
  bag_s += ProcessorSeconds() - at;
  fs::remove_all(folder);
  fmt::print("{} stereo frames{}: EuRoC {:.2f} s, bag {:.2f} s of processor time, ratio {:.2f}\n",
             frames, with_truth ? " with depth and what moves" : "", euroc_s, bag_s,
             bag_s / euroc_s);
  EXPECT_LE(bag_s, 1.2 * euroc_s);
}

INSTANTIATE_TEST_SUITE_P(PicturesAloneAndWithTruth, WritingTime, testing::Bool());

}  // namespace
}  // namespace aisle
