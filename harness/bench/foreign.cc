#include "harness/bench/foreign.h"

#include <opencv2/imgproc.hpp>

namespace aisle {
namespace {

/// Means over whole blocks.
cv::Mat3f Blocks(const cv::Mat3f& image, int block_px) {
  cv::Mat3f small;
  const cv::Size size(std::max(1, image.cols / block_px), std::max(1, image.rows / block_px));
  cv::resize(image, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

/// Share of the blocks whose means are near each other.
double ShareWithin(const cv::Mat3f& ours, const cv::Mat3f& theirs, int channel,
                   const ForeignBounds& bounds) {
  int close = 0;
  for (int y = 0; y < ours.rows; ++y) {
    for (int x = 0; x < ours.cols; ++x) {
      const float reference = theirs(y, x)[channel];
      close += std::abs(ours(y, x)[channel] - reference) <=
               static_cast<float>(bounds.block) * std::max(reference, bounds.black);
    }
  }
  return close / static_cast<double>(ours.total());
}

}  // namespace

std::array<ChannelComparison, 3> CompareChannels(const cv::Mat3f& ours, const cv::Mat3f& theirs,
                                                 const ForeignBounds& bounds) {
  const cv::Mat3f a = Blocks(ours, bounds.block_px), b = Blocks(theirs, bounds.block_px);
  const cv::Scalar mean = cv::mean(ours), expected = cv::mean(theirs);
  std::array<ChannelComparison, 3> channels;
  for (const auto& [at, name, channel] :
       {std::tuple(0u, "red", 2), std::tuple(1u, "green", 1), std::tuple(2u, "blue", 0)}) {
    channels[at] = {.name = name,
                    .mean = mean[channel],
                    .expected = expected[channel],
                    .ratio = mean[channel] / std::max(expected[channel], 1e-12),
                    .share = ShareWithin(a, b, channel, bounds)};
  }
  return channels;
}

bool Keeps(const ChannelComparison& channel, const ForeignBounds& bounds) {
  return std::abs(channel.ratio - 1) <= bounds.mean && channel.share >= bounds.least_share;
}

}  // namespace aisle
