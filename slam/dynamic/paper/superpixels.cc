#include "slam/dynamic/paper/superpixels.h"

#include <numeric>

#include "slam/common/parallel.h"

namespace aisle::slam::dynamic {
namespace {

/// Sums over the pixels of a superpixel. Integers, so that pixels may join and leave in any order
/// and the means stay exact.
struct ClusterSums {
  std::int64_t x = 0, y = 0, grey = 0, pixels = 0;

  void Change(int px, int py, int pgrey, int sign) {
    x += sign * px;
    y += sign * py;
    grey += sign * pgrey;
    pixels += sign;
  }
};

/// A centre as the search meets it.
struct BinnedCentre {
  double x, y, grey;
  int index;
};

/// Everything an iteration needs and changes.
struct Segmentation {
  const cv::Mat1b& image;
  double colour_weight;  // 1 / N_c^2
  double space_weight;   // 1 / N_s^2
  double step;
  int columns = 0, rows = 0;  // of the initial grid
  cv::Mat1i labels = {};
  std::vector<ClusterSums> sums = {};
  std::vector<ClusterCentre> centres = {};
  std::vector<BinnedCentre> binned = {};    // by grid square, ascending within each
  std::vector<std::size_t> bin_begin = {};  // in `binned`, per square and one past the last
  std::int64_t distances = 0;

  int BinOf(double x, double y) const {
    const int column = std::clamp(static_cast<int>(x / step), 0, columns - 1);
    const int row = std::clamp(static_cast<int>(y / step), 0, rows - 1);
    return row * columns + column;
  }
};

Segmentation InitialSquares(const cv::Mat1b& image, double colour_scale, double step) {
  Segmentation s{image, 1 / (colour_scale * colour_scale), 1 / (step * step), step};
  s.columns = std::max(1, cvCeil(image.cols / step - 1e-9));
  s.rows = std::max(1, cvCeil(image.rows / step - 1e-9));
  s.labels.create(image.size());
  s.sums.resize(static_cast<std::size_t>(s.columns * s.rows));
  s.centres.resize(s.sums.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      s.labels(y, x) = s.BinOf(x, y);
      s.sums[static_cast<std::size_t>(s.labels(y, x))].Change(x, y, image(y, x), 1);
    }
  }
  return s;
}

/// Sorts the centres that have pixels into the squares of the grid.
void FillBins(Segmentation& s) {
  const auto bin_of = [&](const ClusterCentre& c) {
    return static_cast<std::size_t>(s.BinOf(c.x, c.y));
  };
  s.bin_begin.assign(s.centres.size() + 1, 0);
  for (const ClusterCentre& c : s.centres) s.bin_begin[bin_of(c) + 1] += c.pixels > 0 ? 1 : 0;
  std::partial_sum(s.bin_begin.begin(), s.bin_begin.end(), s.bin_begin.begin());
  s.binned.resize(s.bin_begin.back());
  std::vector<std::size_t> next = s.bin_begin;
  for (std::size_t j = 0; j < s.centres.size(); ++j) {
    const ClusterCentre& c = s.centres[j];
    if (c.pixels > 0) s.binned[next[bin_of(c)]++] = {c.x, c.y, c.grey, static_cast<int>(j)};
  }
}

void MoveCentres(Segmentation& s) {
  for (std::size_t j = 0; j < s.centres.size(); ++j) {
    const ClusterSums& sum = s.sums[j];
    ClusterCentre& centre = s.centres[j];
    centre.pixels = static_cast<int>(sum.pixels);
    if (sum.pixels > 0) {
      const auto n = static_cast<double>(sum.pixels);
      centre.x = static_cast<double>(sum.x) / n;
      centre.y = static_cast<double>(sum.y) / n;
      centre.grey = static_cast<double>(sum.grey) / n;
    }
  }
  FillBins(s);
}

/// The nearest centre by equation (5) of those within S_step in x and in y; of equals the one with
/// the smallest index. The square root is left out: it changes no order. Adds to `distances`.
int NearestCentre(const Segmentation& s, int x, int y, std::int64_t& distances) {
  const int grey = s.image(y, x);
  int best = s.labels(y, x);
  double best_distance = std::numeric_limits<double>::infinity();
  const int column = std::min(static_cast<int>(x / s.step), s.columns - 1);
  const int row = std::min(static_cast<int>(y / s.step), s.rows - 1);
  const int left = std::max(0, column - 1), right = std::min(s.columns - 1, column + 1);
  for (int r = std::max(0, row - 1); r <= std::min(s.rows - 1, row + 1); ++r) {
    // The squares beside each other, and so their centres, are one range.
    const std::size_t end = s.bin_begin[static_cast<std::size_t>(r * s.columns + right) + 1];
    for (std::size_t k = s.bin_begin[static_cast<std::size_t>(r * s.columns + left)]; k < end;
         ++k) {
      const BinnedCentre& centre = s.binned[k];
      const double dx = centre.x - x, dy = centre.y - y, dg = centre.grey - grey;
      if (std::abs(dx) > s.step || std::abs(dy) > s.step) continue;
      ++distances;
      const double distance =  // Equation (5)
          dg * dg * s.colour_weight + (dx * dx + dy * dy) * s.space_weight;
      if (distance < best_distance || (distance == best_distance && centre.index < best)) {
        best = centre.index;
        best_distance = distance;
      }
    }
  }
  return best;
}

/// The nearest centre of each listed pixel.
std::vector<int> NearestCentres(Segmentation& s, const std::vector<int>& pixels) {
  constexpr std::size_t kBlock = 2048;
  const std::size_t blocks = (pixels.size() + kBlock - 1) / kBlock;
  std::vector<int> nearest(pixels.size());
  std::vector<std::int64_t> distances(blocks, 0);
  ParallelFor(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t end = std::min(pixels.size(), (block + 1) * kBlock);
    std::int64_t count = 0;
    for (std::size_t k = block * kBlock; k < end; ++k) {
      nearest[k] = NearestCentre(s, pixels[k] % s.image.cols, pixels[k] / s.image.cols, count);
    }
    distances[block] = count;
  });
  s.distances = std::accumulate(distances.begin(), distances.end(), s.distances);
  return nearest;
}

template <typename Visit>
void ForFourNeighbours(const cv::Mat1i& image, int index, const Visit& visit) {
  const int x = index % image.cols, y = index / image.cols;
  if (y > 0) visit(index - image.cols);
  if (x > 0) visit(index - 1);
  if (x + 1 < image.cols) visit(index + 1);
  if (y + 1 < image.rows) visit(index + image.cols);
}

/// Gives each listed pixel its nearest centre; returns which of them changed superpixel. The
/// centres stand still meanwhile, so the order of the pixels does not matter.
std::vector<bool> Reassign(Segmentation& s, const std::vector<int>& pixels) {
  const std::vector<int> nearest = NearestCentres(s, pixels);
  std::vector<bool> changed(pixels.size(), false);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const int x = pixels[k] % s.image.cols, y = pixels[k] / s.image.cols;
    const int from = s.labels(y, x), to = nearest[k];
    if (from == to) continue;
    s.sums[static_cast<std::size_t>(from)].Change(x, y, s.image(y, x), -1);
    s.sums[static_cast<std::size_t>(to)].Change(x, y, s.image(y, x), 1);
    s.labels(y, x) = to;
    changed[k] = true;
  }
  return changed;
}

std::vector<int> EdgePixels(const cv::Mat1i& labels) {
  std::vector<int> edges;
  const int* label = labels[0];
  for (int p = 0; p < static_cast<int>(labels.total()); ++p) {
    bool edge = false;
    ForFourNeighbours(labels, p, [&](int q) { edge = edge || label[p] != label[q]; });
    if (edge) edges.push_back(p);
  }
  return edges;
}

/// Equation (7): the pixels to look at in the next iteration. `flags` is all zero before and after.
std::vector<int> NextUnstable(const Segmentation& s, const std::vector<int>& unstable,
                              const std::vector<bool>& changed, std::vector<char>& flags) {
  std::vector<int> next;
  const int* label = s.labels[0];
  const auto mark = [&](int p) {
    if (flags[static_cast<std::size_t>(p)] != 0) return;
    flags[static_cast<std::size_t>(p)] = 1;
    next.push_back(p);
  };
  for (std::size_t k = 0; k < unstable.size(); ++k) {
    const int q = unstable[k];
    if (changed[k]) mark(q);
    ForFourNeighbours(s.labels, q, [&](int p) {
      if (changed[k] || label[p] != label[q]) mark(p);
    });
  }
  for (const int p : next) flags[static_cast<std::size_t>(p)] = 0;
  return next;
}

Superpixels Segment(const cv::Mat1b& image, double colour_scale, const SuperpixelOptions& options,
                    bool only_unstable) {
  Superpixels result;
  if (image.empty()) return result;
  Segmentation s = InitialSquares(image, colour_scale, options.step_px);
  MoveCentres(s);
  std::vector<int> pixels(image.total());
  std::iota(pixels.begin(), pixels.end(), 0);
  if (only_unstable) pixels = EdgePixels(s.labels);
  std::vector<char> flags(image.total(), 0);

  for (bool moving = true; moving && result.iterations < options.iterations; ++result.iterations) {
    const std::vector<bool> changed = Reassign(s, pixels);
    result.pixels_classified += static_cast<std::int64_t>(pixels.size());
    if (only_unstable) pixels = NextUnstable(s, pixels, changed, flags);
    MoveCentres(s);
    moving = std::find(changed.begin(), changed.end(), true) != changed.end();
  }
  result.labels = s.labels;
  result.centres = std::move(s.centres);
  result.distances = s.distances;
  return result;
}

}  // namespace

double ColourScale(const cv::Mat1b& image, const SuperpixelOptions& options) {
  std::array<std::int64_t, 256> histogram{};
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) ++histogram[image(y, x)];
  }
  const auto percentile = [&](double share) {
    const double wanted = share * static_cast<double>(image.total());
    std::int64_t below = 0;
    int grey = 0;
    while (grey < 255 &&
           static_cast<double>(below += histogram[static_cast<std::size_t>(grey)]) < wanted) {
      ++grey;
    }
    return grey;
  };
  return std::max(1.0, options.colour_share * (percentile(0.95) - percentile(0.05)));
}

Superpixels SegmentFully(const cv::Mat1b& image, double colour_scale,
                         const SuperpixelOptions& options) {
  return Segment(image, colour_scale, options, false);
}

Superpixels SegmentUnstable(const cv::Mat1b& image, double colour_scale,
                            const SuperpixelOptions& options) {
  return Segment(image, colour_scale, options, true);
}

}  // namespace aisle::slam::dynamic
