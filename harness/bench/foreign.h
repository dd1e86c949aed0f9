#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace aisle {

/// How near a picture must come to another renderer's. Other renderers filter their pixels; means
/// over blocks do not feel it.
struct ForeignBounds {
  int block_px = 8;
  double mean = 0.005;        ///< of each channel, relative
  double block = 0.03;        ///< of a block's mean, relative
  double least_share = 0.95;  ///< of the blocks that must be so near
  float black = 1e-3f;        ///< darker blocks are compared as if they were so bright
};

/// One channel of two pictures of the same size.
struct ChannelComparison {
  const char* name = "";
  double mean = 0, expected = 0;
  double ratio = 0;  ///< mean / expected
  double share = 0;  ///< of the blocks within the bound
};

/// Red, green and blue of linear pictures (B, G, R in memory).
std::array<ChannelComparison, 3> CompareChannels(const cv::Mat3f& ours, const cv::Mat3f& theirs,
                                                 const ForeignBounds& bounds = {});

bool Keeps(const ChannelComparison& channel, const ForeignBounds& bounds = {});

}  // namespace aisle
