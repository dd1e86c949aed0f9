#include "simulator/simulator.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

namespace aisle::sim {
namespace {

const std::string kRoot = AISLE_SOURCE_DIR;

/// Pictures of a scene to look at: AISLE_TEST_PICTURES names a folder, AISLE_TEST_SCENE a scene
/// file. With them come the times.
TEST(Simulator, PicturesOfASceneToLookAt) {
  const char* folder = std::getenv("AISLE_TEST_PICTURES");
  if (!folder) GTEST_SKIP() << "AISLE_TEST_PICTURES is not set";
  const char* file = std::getenv("AISLE_TEST_SCENE");
  const auto start = std::chrono::steady_clock::now();
  const Simulator simulator =
      Simulator::Load(file ? file : kRoot + "/scenes/paper/scene2.yaml", kRoot + "/assets", {});
  const std::chrono::duration<double> built = std::chrono::steady_clock::now() - start;
  fmt::print("loaded in {:.1f} s\n", built.count());
  for (int i = 0; i < 5; ++i) {
    const int frame = simulator.frame_count() * i / 5;
    const std::int64_t stamp = simulator.Stamp(frame);
    const RenderedFrame picture = simulator.Render(frame, stamp, simulator.PlannedPose(stamp));
    cv::imwrite(fmt::format("{}/left_{}.png", folder, i), picture.left);
    cv::imwrite(fmt::format("{}/dynamic_{}.png", folder, i), picture.truth.dynamic);
    fmt::print(
        "frame {}: mean grey {:.1f}, saturated {:.2f} %\n", frame, cv::mean(picture.left)[0],
        100.0 * cv::countNonZero(picture.left == 255) / static_cast<double>(picture.left.total()));
  }
  const VerifyReport verify = simulator.Verify(simulator.frame_count() / 2);
  fmt::print("raster {:.5f} {:.5f}, stereo {:.4f} px, flow {:.4f} px: {}\n",
             verify.raster_agreement_left, verify.raster_agreement_right, verify.stereo_median_px,
             verify.flow_median_px, verify.failure());
  const RenderBench bench = simulator.Bench(12);
  fmt::print("pair {:.1f} ms, bare {:.1f} ms, ratio {:.2f}\n", bench.pair_ms, bench.bare_primary_ms,
             bench.ratio);
  for (const auto& [stage, ms] : bench.stage_ms) fmt::print("  {} {:.2f} ms\n", stage, ms);
}

}  // namespace
}  // namespace aisle::sim
