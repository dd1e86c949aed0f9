#include "harness/cli/bench_foreign.h"

#include "harness/bench/foreign.h"
#include "harness/cli/command.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/plugs/light_check.h"

namespace aisle {
namespace {

bool Compare(const cv::Mat3f& ours, const cv::Mat3f& theirs) {
  const ForeignBounds bounds;
  bool good = true;
  for (const ChannelComparison& channel : CompareChannels(ours, theirs, bounds)) {
    fmt::print(
        "{:<6} mean {:.6f}, reference {:.6f}, ratio {:.4f}; {:.1f} % of blocks within {:.0f} %\n",
        channel.name, channel.mean, channel.expected, channel.ratio, 100 * channel.share,
        100 * bounds.block);
    good &= Keeps(channel, bounds);
  }
  fmt::print("bounds: means within {:.1f} %, {:.0f} % of blocks of {} x {} pixels: {}\n",
             100 * bounds.mean, 100 * bounds.least_share, bounds.block_px, bounds.block_px,
             good ? "kept" : "missed");
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
      "{} x {} pixels, {} paths per pixel, up to {} surfaces: mean RGB {:.6f}, {:.6f}, {:.6f}\n",
      picture.cols, picture.rows, options.samples, options.depth, mean[2], mean[1], mean[0]);
  fmt::print("{}\n", file.string());
  if (reference.empty()) return kAllPassed;
  if (reference.size() != picture.size()) {
    throw InputError(
        fmt::format("{}: the image has {} x {} pixels, but the scene's picture has {} x {}",
                    options.reference, reference.cols, reference.rows, picture.cols, picture.rows));
  }
  return Compare(picture, reference) ? kAllPassed : kVerdictFailed;
}

}  // namespace aisle
