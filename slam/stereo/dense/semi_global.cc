#include "slam/stereo/dense/semi_global.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "slam/common/parallel.h"
#include "slam/stereo/dense/census_cost.h"
#include "slam/stereo/dense/choose_disparity.h"
#include "slam/stereo/dense/cost_paths.h"

namespace aisle::slam {
namespace {

using std::int16_t;
using std::uint16_t;
using std::uint8_t;

constexpr int kBandRows = 8, kStripColumns = 16;
constexpr int kSixteenths = 16;
constexpr int16_t kUnknown = -kSixteenths;

/// A byte per pixel and disparity; disparities innermost, then columns.
class Volume {
 public:
  Volume(cv::Size size, int disparities)
      : disparities_(disparities),
        row_(static_cast<std::ptrdiff_t>(size.width) * disparities),
        bytes_(std::make_unique_for_overwrite<uint8_t[]>(
            static_cast<std::size_t>(row_ * size.height))) {}
  uint8_t* At(int y, int x) { return bytes_.get() + y * row_ + x * disparities_; }
  int disparities() const { return disparities_; }
  std::ptrdiff_t row() const { return row_; }

 private:
  int disparities_;
  std::ptrdiff_t row_;
  std::unique_ptr<uint8_t[]> bytes_;
};

StepPrices PricesOf(const SemiGlobalOptions& options) {
  StepPrices prices;
  prices.small = static_cast<uint8_t>(options.p1);
  for (int grey = 0; grey < 256; ++grey) {
    const int falling = options.p2 * options.p2_contrast / (options.p2_contrast + grey);
    prices.large[static_cast<std::size_t>(grey)] =
        static_cast<uint8_t>(std::max(falling, options.least_p2));
  }
  return prices;
}

/// By how much each pixel differs from its left and from its upper neighbour; 0 without one.
struct Contrasts {
  explicit Contrasts(const cv::Mat1b& image) {
    cv::Mat1b padded;
    cv::copyMakeBorder(image, padded, 1, 0, 1, 0, cv::BORDER_REPLICATE);
    const cv::Rect left({0, 1}, image.size()), above({1, 0}, image.size());
    cv::absdiff(image, padded(left), across);
    cv::absdiff(image, padded(above), down);
  }
  cv::Mat1b across, down;
};

/// The path costs of a band of rows from the left and from the right, summed.
void FollowRows(const cv::Mat1b& across, int top, int bottom, const StepPrices& prices,
                Volume& costs, Volume& sums) {
  const int rows = bottom - top, columns = across.cols;
  std::array<uint8_t, kBandRows> contrasts = {};
  const auto pixels = [&](int x, int contrasts_x) {
    for (int k = 0; k < rows; ++k) {
      contrasts[static_cast<std::size_t>(k)] = across(top + k, contrasts_x);
    }
    return PathPixels{costs.At(top, x), costs.row(), contrasts.data(), sums.At(top, x), sums.row()};
  };
  CostPaths rightwards(rows, costs.disparities(), prices);
  for (int x = 0; x < columns; ++x) rightwards.AdvanceAndSet(pixels(x, x));
  CostPaths leftwards(rows, costs.disparities(), prices);
  for (int x = columns - 1; x >= 0; --x) {
    leftwards.AdvanceAndAdd(pixels(x, std::min(x + 1, columns - 1)));
  }
}

/// The path costs of a strip of columns from above and from below, summed.
void FollowColumns(const cv::Mat1b& down, int left, int right, const StepPrices& prices,
                   Volume& costs, Volume& sums) {
  const int columns = right - left, disparities = costs.disparities();
  const auto pixels = [&](int y, int contrasts_y) {
    return PathPixels{costs.At(y, left), disparities, down[contrasts_y] + left, sums.At(y, 0),
                      disparities};
  };
  CostPaths downwards(columns, disparities, prices);
  for (int y = 0; y < down.rows; ++y) downwards.AdvanceAndSet(pixels(y, y));
  CostPaths upwards(columns, disparities, prices);
  for (int y = down.rows - 1; y >= 0; --y) {
    upwards.AdvanceAndAdd(pixels(y, std::min(y + 1, down.rows - 1)));
  }
}

std::vector<Winner> FindWinners(const cv::Mat1b& left, const cv::Mat1b& right,
                                const SemiGlobalOptions& options) {
  const StepPrices prices = PricesOf(options);
  const Contrasts contrasts(left);
  const CensusPlanes left_planes = CensusTransform(left), right_planes = CensusTransform(right);
  const int disparities = options.max_disparity_px;
  Volume costs(left.size(), disparities), by_rows(left.size(), disparities);
  ParallelFor(0, (left.rows + kBandRows - 1) / kBandRows, [&](int band) {
    const int top = band * kBandRows, bottom = std::min(top + kBandRows, left.rows);
    CensusCosts(left_planes, right_planes, top, bottom, disparities, costs.At(top, 0));
    FollowRows(contrasts.across, top, bottom, prices, costs, by_rows);
  });
  std::vector<Winner> winners(left.total());
  ParallelFor(0, (left.cols + kStripColumns - 1) / kStripColumns, [&](int strip) {
    const int from = strip * kStripColumns, to = std::min(from + kStripColumns, left.cols);
    Volume by_columns({kStripColumns, left.rows}, disparities);
    FollowColumns(contrasts.down, from, to, prices, costs, by_columns);
    for (int y = 0; y < left.rows; ++y) {
      ChooseDisparities(by_rows.At(y, from), by_columns.At(y, 0), to - from, disparities,
                        options.uniqueness_percent, winners.data() + y * left.cols + from);
    }
  });
  return winners;
}

/// The middle of 3x3, where all of what it says is known.
void TakeMedians(cv::Mat1s& sixteenths) {
  cv::Mat1s medians;
  cv::medianBlur(sixteenths, medians, 3);
  for (int y = 0; y < sixteenths.rows; ++y) {
    const int16_t* median = medians[y];
    int16_t* found = sixteenths[y];
    for (int x = 0; x < sixteenths.cols; ++x) {
      if (found[x] >= 0 && median[x] >= 0) found[x] = median[x];
    }
  }
}

}  // namespace

cv::Mat1f MatchSemiGlobally(const cv::Mat1b& left, const cv::Mat1b& right,
                            const SemiGlobalOptions& options) {
  CV_Assert(left.size() == right.size() && !left.empty());
  const std::vector<Winner> winners = FindWinners(left, right, options);
  cv::Mat1s sixteenths(left.size());
  ParallelFor(0, left.rows, [&](int y) {
    CheckRightToLeft(winners.data() + y * left.cols, left.cols, options.left_right_px, kUnknown,
                     sixteenths[y]);
  });
  TakeMedians(sixteenths);
  cv::filterSpeckles(sixteenths, kUnknown, options.speckle_px,
                     kSixteenths * options.speckle_step_px);
  cv::Mat1f disparity(left.size());
  for (int y = 0; y < left.rows; ++y) {
    for (int x = 0; x < left.cols; ++x) {
      const int16_t found = sixteenths(y, x);
      // The middle may point beyond the right image where this pixel's own did not.
      const bool known = found >= 0 && found <= kSixteenths * x;
      disparity(y, x) = known ? static_cast<float>(found) / kSixteenths : kNoDisparity;
    }
  }
  return disparity;
}

}  // namespace aisle::slam
