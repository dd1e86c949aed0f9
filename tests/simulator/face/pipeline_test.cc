#include "simulator/pipeline.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

PipelineOptions QuickOptions() {
  PipelineOptions options;
  options.shade.statics = {.texel_m = 0.15f, .coarse_texel_m = 1.0f, .directions = 32};
  options.sensor.exposure = 5.0f;
  return options;
}

Pipeline SmallHall(const PipelineOptions& options) {
  return Pipeline(World(test::Hall({.boxes = 200})), {}, options);
}

bool SameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

void ExpectSame(const RenderedFrame& a, const RenderedFrame& b) {
  EXPECT_TRUE(SameBytes(a.left, b.left));
  EXPECT_TRUE(SameBytes(a.right, b.right));
  EXPECT_TRUE(SameBytes(a.truth.depth, b.truth.depth));
  EXPECT_TRUE(SameBytes(a.truth.instance, b.truth.instance));
  EXPECT_TRUE(SameBytes(a.truth.dynamic, b.truth.dynamic));
  EXPECT_TRUE(SameBytes(a.truth.dynamic_right, b.truth.dynamic_right));
}

const Eigen::Isometry3d kPose = test::LookAlong({1.5, 0, 1.2}, 0.02);

TEST(Pipeline, BytesDoNotDependOnThreadsOrTileOrder) {
  PipelineOptions options = QuickOptions();
  options.threads = 1;
  const RenderedFrame reference = SmallHall(options).Render(7, 2 * kSecond, kPose);
  for (const int threads : {2, 4}) {
    options.threads = threads;
    options.tile_shuffle = static_cast<std::uint64_t>(threads) * 77;
    ExpectSame(reference, SmallHall(options).Render(7, 2 * kSecond, kPose));
  }
}

TEST(Pipeline, AFrameAloneIsTheFrameInSequence) {
  const Pipeline alone = SmallHall(QuickOptions());
  const RenderedFrame reference = alone.Render(3, 3 * kSecond, kPose);
  const Pipeline sequence = SmallHall(QuickOptions());
  for (int i = 0; i < 3; ++i) sequence.Render(i, i * kSecond, kPose);
  ExpectSame(reference, sequence.Render(3, 3 * kSecond, kPose));
}

TEST(Pipeline, ShadingAndSensorOptionsNeverChangeTruth) {
  const RenderedFrame reference = SmallHall(QuickOptions()).Render(0, kSecond, kPose);
  PipelineOptions options = QuickOptions();
  options.shade.antialias = options.shade.mover_shadows = options.sensor.noise = false;
  const RenderedFrame other = SmallHall(options).Render(0, kSecond, kPose);
  EXPECT_FALSE(SameBytes(reference.left, other.left));
  EXPECT_TRUE(SameBytes(reference.truth.depth, other.truth.depth));
  EXPECT_TRUE(SameBytes(reference.truth.instance, other.truth.instance));
  EXPECT_TRUE(SameBytes(reference.truth.dynamic, other.truth.dynamic));
}

TEST(Pipeline, TruthProvesItselfByRasteriserAndWarps) {
  const VerifyReport report = SmallHall(QuickOptions())
                                  .Verify(2 * kSecond, kPose, 2 * kSecond + kSecond / 20,
                                          test::LookAlong({1.55, 0, 1.2}, 0.03));
  EXPECT_EQ(report.failure(), "");
  EXPECT_GT(report.raster_compared, 300'000);
  EXPECT_GT(report.stereo_compared, 200'000);
  EXPECT_GT(report.flow_compared, 200'000);
}

/// Pictures to look at: AISLE_TEST_PICTURES names a folder. With it come the times of a hall of
/// 200 000 triangles.
TEST(Pipeline, PicturesToLookAt) {
  const char* folder = std::getenv("AISLE_TEST_PICTURES");
  if (!folder) GTEST_SKIP() << "AISLE_TEST_PICTURES is not set";
  PipelineOptions options;
  options.sensor.exposure = 5.0f;
  const auto start = std::chrono::steady_clock::now();
  const Pipeline pipeline(World(test::Hall({.boxes = 16000})), {}, options);
  const std::chrono::duration<double> built = std::chrono::steady_clock::now() - start;
  const RenderedFrame frame = pipeline.Render(0, 2 * kSecond, kPose);
  cv::imwrite(std::string(folder) + "/left.png", frame.left);
  cv::imwrite(std::string(folder) + "/dynamic.png", frame.truth.dynamic);
  std::vector<std::int64_t> stamps;
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 12; ++i) {
    stamps.push_back(i * kSecond / 4);
    poses.push_back(test::LookAlong({1.0 + 0.3 * i, 0, 1.2}, 0.02));
  }
  const RenderBench bench = pipeline.Bench(stamps, poses);
  fmt::print("built in {:.1f} s; mean grey {:.1f}\n", built.count(), cv::mean(frame.left)[0]);
  fmt::print("pair {:.1f} ms, bare {:.1f} ms, ratio {:.2f}\n", bench.pair_ms, bench.bare_primary_ms,
             bench.ratio);
  for (const auto& [stage, ms] : bench.stage_ms) fmt::print("  {} {:.2f} ms\n", stage, ms);
}

}  // namespace
}  // namespace aisle::sim
