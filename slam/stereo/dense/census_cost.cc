#include "slam/stereo/dense/census_cost.h"

#include <opencv2/imgproc.hpp>

#include "slam/common/parallel.h"

namespace aisle::slam {
namespace {

using std::uint64_t;
using std::uint8_t;

constexpr int kReach = 2;  // of the window of the transform

/// Eight pixels or disparities at once, a byte each; no sum here carries into the next byte.
constexpr uint64_t Eight(uint64_t byte) { return byte * 0x0101010101010101U; }

uint64_t Load(const uint8_t* from) {
  uint64_t bytes;
  std::memcpy(&bytes, from, sizeof bytes);
  return bytes;
}

/// Bits set in each pair of nibbles, at most 4 in each nibble.
uint64_t CountInNibbles(uint64_t bits) {
  bits -= (bits >> 1) & Eight(0x55);
  return (bits & Eight(0x33)) + ((bits >> 2) & Eight(0x33));
}

/// The right image's planes from right to left, so that the disparities of a pixel follow each
/// other; the first column repeated beyond it.
std::array<std::vector<uint8_t>, 3> Reversed(const CensusPlanes& right, int y, int disparities) {
  std::array<std::vector<uint8_t>, 3> planes;
  const int columns = right[0].cols;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const uint8_t* row = right[k][y];
    planes[k].assign(static_cast<std::size_t>(columns + disparities), row[0]);
    std::reverse_copy(row, row + columns, planes[k].begin());
  }
  return planes;
}

/// Bits that differ, 0 to 24, of one row of pixels alone.
void DifferRow(const CensusPlanes& left, const CensusPlanes& right, int y, int disparities,
               uint8_t* bits) {
  const auto reversed = Reversed(right, y, disparities);
  const int columns = left[0].cols;
  for (int x = 0; x < columns; ++x, bits += disparities) {
    const uint64_t a = Eight(left[0](y, x)), b = Eight(left[1](y, x)), c = Eight(left[2](y, x));
    const int at = columns - 1 - x;
    const uint8_t *other_a = reversed[0].data() + at, *other_b = reversed[1].data() + at,
                  *other_c = reversed[2].data() + at;
#pragma GCC ivdep
    for (int d = 0; d < disparities; d += 8) {
      const uint64_t nibbles = CountInNibbles(a ^ Load(other_a + d)) +
                               CountInNibbles(b ^ Load(other_b + d)) +
                               CountInNibbles(c ^ Load(other_c + d));
      const uint64_t sum = (nibbles & Eight(0x0f)) + ((nibbles >> 4) & Eight(0x0f));
      std::memcpy(bits + d, &sum, sizeof sum);
    }
  }
}

/// Sums over three columns of the sum of three rows, which is at most 72.
void SumAcross(const uint8_t* rows, int columns, int disparities, uint8_t* costs) {
  for (int x = 0; x < columns; ++x) {
    const uint8_t* here = rows + x * disparities;
    const uint8_t *before = x > 0 ? here - disparities : here,
                  *after = x + 1 < columns ? here + disparities : here;
    uint8_t* cost = costs + x * disparities;
#pragma GCC ivdep
    for (int d = 0; d < disparities; ++d) {
      cost[d] = static_cast<uint8_t>(static_cast<uint8_t>(before[d] + here[d] + after[d]) >> 2);
    }
  }
}

/// A bit for each of the others, set where it is darker.
void CompareRow(const uint8_t* centre, const std::array<const uint8_t*, 8>& others, int columns,
                uint8_t* bits) {
  const auto [a, b, c, d, e, f, g, h] = others;
#pragma GCC ivdep
  for (int x = 0; x < columns; ++x) {
    const uint8_t grey = centre[x];
    bits[x] = static_cast<uint8_t>((a[x] < grey ? 1 : 0) | (b[x] < grey ? 2 : 0) |
                                   (c[x] < grey ? 4 : 0) | (d[x] < grey ? 8 : 0) |
                                   (e[x] < grey ? 16 : 0) | (f[x] < grey ? 32 : 0) |
                                   (g[x] < grey ? 64 : 0) | (h[x] < grey ? 128 : 0));
  }
}

}  // namespace

CensusPlanes CensusTransform(const cv::Mat1b& image) {
  cv::Mat1b padded;
  cv::copyMakeBorder(image, padded, kReach, kReach, kReach, kReach, cv::BORDER_REPLICATE);
  CensusPlanes planes;
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    planes[plane] = cv::Mat1b(image.size());
    ParallelFor(0, image.rows, [&](int y) {
      std::array<const uint8_t*, 8> others;
      for (std::size_t k = 0; k < others.size(); ++k) {
        const int bit = static_cast<int>(8 * plane + k);
        const int cell = bit < 12 ? bit : bit + 1;  // of the 25, without the centre
        others[k] = padded[y + cell / 5] + cell % 5;
      }
      CompareRow(image[y], others, image.cols, planes[plane][y]);
    });
  }
  return planes;
}

void CensusCosts(const CensusPlanes& left, const CensusPlanes& right, int top, int bottom,
                 int disparities, uint8_t* costs) {
  const int rows = left[0].rows, columns = left[0].cols;
  const auto row_bytes = static_cast<std::size_t>(columns) * static_cast<std::size_t>(disparities);
  std::array<std::vector<uint8_t>, 3> differ;  // row y in slot (y + 1) % 3
  for (auto& row : differ) row.resize(row_bytes);
  const auto slot = [&](int y) -> uint8_t* {
    return differ[static_cast<std::size_t>(y + 1) % differ.size()].data();
  };
  const auto fill = [&](int y) {
    DifferRow(left, right, std::clamp(y, 0, rows - 1), disparities, slot(y));
  };
  std::vector<uint8_t> sums(row_bytes);
  fill(top - 1);
  fill(top);
  for (int y = top; y < bottom; ++y, costs += row_bytes) {
    fill(y + 1);
    const uint8_t *above = slot(y - 1), *here = slot(y), *below = slot(y + 1);
#pragma GCC ivdep
    for (std::size_t k = 0; k < row_bytes; ++k) {
      sums[k] = static_cast<uint8_t>(above[k] + here[k] + below[k]);
    }
    SumAcross(sums.data(), columns, disparities, costs);
  }
}

}  // namespace aisle::slam
