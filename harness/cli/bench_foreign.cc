#include "harness/cli/bench_foreign.h"

#include <opencv2/imgproc.hpp>

#include "harness/cli/command.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/plugs/light_check.h"

namespace aisle {
namespace {

// Other renderers filter their pixels; means over blocks do not feel it.
constexpr int kBlock_px = 8;
constexpr double kMeanBound = 0.005, kBlockBound = 0.03, kLeastShare = 0.95;
constexpr float kBlack = 1e-3f;  // below this blocks are compared as if they were so bright

/// Means over whole blocks.
cv::Mat3f Blocks(const cv::Mat3f& image) {
  cv::Mat3f small;
  const cv::Size size(std::max(1, image.cols / kBlock_px), std::max(1, image.rows / kBlock_px));
  cv::resize(image, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

bool Compare(const cv::Mat3f& ours, const cv::Mat3f& theirs) {
  const cv::Mat3f a = Blocks(ours), b = Blocks(theirs);
  const cv::Scalar mean = cv::mean(ours), expected = cv::mean(theirs);
  bool good = true;
  for (const auto& [name, channel] :
       {std::pair("red", 2), std::pair("green", 1), std::pair("blue", 0)}) {
    int close = 0;
    for (int y = 0; y < a.rows; ++y) {
      for (int x = 0; x < a.cols; ++x) {
        const float reference = b(y, x)[channel];
        close += std::abs(a(y, x)[channel] - reference) <=
                 static_cast<float>(kBlockBound) * std::max(reference, kBlack);
      }
    }
    const double ratio = mean[channel] / std::max(expected[channel], 1e-12);
    const double share = close / static_cast<double>(a.total());
    fmt::print(
        "{:<6} mean {:.6f}, reference {:.6f}, ratio {:.4f}; {:.1f} % of blocks within {:.0f} %\n",
        name, mean[channel], expected[channel], ratio, 100 * share, 100 * kBlockBound);
    good &= std::abs(ratio - 1) <= kMeanBound && share >= kLeastShare;
  }
  fmt::print("bounds: means within {:.1f} %, {:.0f} % of blocks of {} x {} pixels: {}\n",
             100 * kMeanBound, 100 * kLeastShare, kBlock_px, kBlock_px, good ? "kept" : "missed");
  return good;
}

}  // namespace

int BenchForeign(const ForeignOptions& options) {
  // Read first: a mistake should show before minutes of tracing.
  cv::Mat3f reference;
  if (!options.reference.empty()) reference = ReadLinearImage(options.reference);
  const cv::Mat3f picture = TraceForeignPicture(
      options.scene,
      {.samples = options.samples, .depth = options.depth, .threads = options.threads});
  const std::filesystem::path file =
      options.out / (std::filesystem::path(options.scene).stem().string() + ".pfm");
  WriteImage(file, picture);
  const cv::Scalar mean = cv::mean(picture);
  fmt::print(
      "{} x {} pixels, {} paths a pixel, up to {} surfaces: mean RGB {:.6f}, {:.6f}, {:.6f}\n",
      picture.cols, picture.rows, options.samples, options.depth, mean[2], mean[1], mean[0]);
  fmt::print("{}\n", file.string());
  if (reference.empty()) return kAllPassed;
  if (reference.size() != picture.size()) {
    throw InputError(fmt::format("{}: is {} x {} pixels, the scene's picture {} x {}",
                                 options.reference, reference.cols, reference.rows, picture.cols,
                                 picture.rows));
  }
  return Compare(picture, reference) ? kAllPassed : kVerdictFailed;
}

}  // namespace aisle
