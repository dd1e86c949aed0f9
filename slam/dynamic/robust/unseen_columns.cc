#include "slam/dynamic/robust/unseen_columns.h"

#include "slam/common/median.h"

namespace aisle::slam::dynamic {
namespace {

/// The median over some rows above and below, of those not negative.
int MedianAround(const std::vector<int>& of_rows, int y) {
  constexpr int kRows = 8;
  const int rows = static_cast<int>(of_rows.size());
  std::vector<int> around;
  for (int v = std::max(0, y - kRows); v <= std::min(rows - 1, y + kRows); ++v) {
    const int value = of_rows[static_cast<std::size_t>(v)];
    if (value >= 0) around.push_back(value);
  }
  return Median(std::move(around));
}

/// Of each row, the first column that shows the thing which is cut.
std::vector<int> FindOutline(const cv::Mat1f& right_links, const std::vector<int>& unseen,
                             float least_link) {
  constexpr int kNone = -1;
  std::vector<int> ends(unseen.size(), kNone), outline(unseen.size(), 0);
  for (int y = 0; y < right_links.rows; ++y) {
    const auto row = static_cast<std::size_t>(y);
    if (unseen[row] == 0) continue;
    int x = unseen[row];
    while (x > 0 && right_links(y, x - 1) >= least_link) --x;
    ends[row] = x;
  }
  for (int y = 0; y < right_links.rows; ++y) {
    outline[static_cast<std::size_t>(y)] = MedianAround(ends, y);
  }
  return outline;
}

/// Where the last run of disparities begins that the right image shows at its left edge, as close
/// as the matcher gets and as much again. Single ones are chance matches.
int CutByTheEdge(const float* disparity, int columns) {
  constexpr int kRun = 3, kClose = 2 * kMatchReach;
  int run = 0, cut = 0;
  for (int x = 0; x < columns; ++x) {
    run = disparity[x] > 0 ? run + 1 : 0;
    const int start = x + 1 - kRun;
    const bool at_edge = static_cast<float>(start) - disparity[x] <= kClose;
    if (run == kRun && at_edge) cut = start;
  }
  return cut;
}

}  // namespace

std::vector<int> UnseenColumns(const cv::Mat1f& coarse, int rows) {
  std::vector<int> unseen(static_cast<std::size_t>(rows), 0);
  for (int y = 0; y < 2 * coarse.rows; ++y) {
    unseen[static_cast<std::size_t>(y)] = 2 * CutByTheEdge(coarse[y / 2], coarse.cols);
  }
  return AsMostAround(unseen);
}

std::vector<int> AsMostAround(const std::vector<int>& unseen) {
  std::vector<int> most = unseen;
  for (int y = 0; y < static_cast<int>(unseen.size()); ++y) {
    int& columns = most[static_cast<std::size_t>(y)];
    if (columns == 0) columns = MedianAround(unseen, y);
  }
  return most;
}

void LinkUnseen(const cv::Mat1f& disparity, const std::vector<int>& unseen,
                const FieldOptions& options, Links* links) {
  const auto coupling = static_cast<float>(options.coupling);
  const auto least_link = static_cast<float>(options.grow_link * options.coupling);
  const std::vector<int> outline = FindOutline(links->right, unseen, least_link);
  const auto is_unseen = [&](int y, int x) {
    return x < unseen[static_cast<std::size_t>(y)] && disparity(y, x) < 0;
  };
  const auto is_within = [&](int y, int x) { return x >= outline[static_cast<std::size_t>(y)]; };
  const auto link = [&](bool one, bool other, float& tie) {
    if (one && other) tie = coupling;
    if (one != other) tie = 0;
  };
  for (int y = 0; y < disparity.rows; ++y) {
    const int columns = unseen[static_cast<std::size_t>(y)];
    for (int x = 0; x < columns; ++x) {
      if (!is_unseen(y, x)) continue;
      const bool within = is_within(y, x);
      if (x + 1 == columns || is_unseen(y, x + 1)) {
        link(within, is_within(y, x + 1), links->right(y, x));
      }
      if (y + 1 < disparity.rows && is_unseen(y + 1, x)) {
        link(within, is_within(y + 1, x), links->down(y, x));
      }
    }
  }
}

}  // namespace aisle::slam::dynamic
