#include "slam/dynamic/robust/label_field.h"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "slam/common/parallel.h"

namespace aisle::slam::dynamic {
namespace {

/// Both ends of a row of links.
struct Ends {
  const float *disparity, *other_disparity;
  const unsigned char *grey, *other_grey, *floor, *other_floor;
};

struct Tie {
  float coupling;
  DisparityTolerance tolerance;
  float contrast;

  /// Surfaces first, without branches, so that it is vectorised; then the floor's edge.
  void Row(const Ends& e, int count, float* links) const {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
      const float d1 = e.disparity[x], d2 = e.other_disparity[x];
      const float step = (d1 - d2) / tolerance.At((d1 + d2) / 2);
      const float steps = step * step;
      const float edge = static_cast<float>(std::abs(e.grey[x] - e.other_grey[x])) / contrast;
      links[x] = coupling / ((1 + steps * steps) * (1 + edge));
    }
    for (int x = 0; x < count; ++x) {
      if ((e.floor[x] != 0) != (e.other_floor[x] != 0)) links[x] = 0;
    }
  }
};

/// The neighbour's belief: a straight line at zero that saturates.
float Belief(float log_odds) { return 2 * log_odds / (2 + std::abs(log_odds)); }

/// Images with a border of zeros: at the image's edge nothing is added.
class Sweeper {
 public:
  Sweeper(const cv::Mat1f& evidence, const Links& links)
      : evidence_(evidence), log_odds_(evidence.size()) {
    const auto pad = [](const cv::Mat1f& image) {
      cv::Mat1f padded;
      cv::copyMakeBorder(image, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
      return padded;
    };
    right_ = pad(links.right);
    down_ = pad(links.down);
    belief_ = pad(evidence);
    ParallelFor(1, evidence.rows + 1, [&](int y) {
      float* row = belief_[y];
      for (int x = 1; x <= evidence.cols; ++x) row[x] = Belief(row[x]);
    });
  }

  /// As pixel by pixel in raster order, or the reverse (kStep -1): a row may go on as soon as the
  /// one before is a pixel ahead, so several go side by side and need not wait for each other's
  /// sums.
  template <int kStep>
  void Sweep() {
    constexpr int kBand = 8;
    const int rows = evidence_.rows, columns = evidence_.cols;
    for (int top = 0; top < rows; top += kBand) {
      const int band = std::min(kBand, rows - top);
      std::array<Row, kBand> row;
      for (int r = 0; r < band; ++r) {
        const int y = kStep > 0 ? top + r : rows - 1 - top - r;
        row[static_cast<std::size_t>(r)] = RowAt(y);
      }
      const int begin = kStep > 0 ? 0 : columns - 1;
      for (int t = 0; t < columns + band - 1; ++t) {
        const int last = std::min(t, band - 1);
        for (int r = std::max(0, t - columns + 1); r <= last; ++r) {
          row[static_cast<std::size_t>(r)].Update(begin + kStep * (t - r));
        }
      }
    }
  }

  const cv::Mat1f& log_odds() const { return log_odds_; }

 private:
  /// Beliefs and links from the pixel on that stands before the first one.
  struct Row {
    const float *evidence, *above, *below, *right, *down_above, *down;
    float *belief, *log_odds;

    void Update(int x) const {
      const float sum = evidence[x] + right[x] * belief[x] + down_above[x + 1] * above[x + 1] +
                        right[x + 1] * belief[x + 2] + down[x + 1] * below[x + 1];
      log_odds[x] = sum;
      belief[x + 1] = Belief(sum);
    }
  };

  Row RowAt(int y) {
    return {evidence_[y], belief_[y],   belief_[y + 2], right_[y + 1],
            down_[y],     down_[y + 1], belief_[y + 1], log_odds_[y]};
  }

  cv::Mat1f evidence_, log_odds_;
  cv::Mat1f right_, down_, belief_;
};

}  // namespace

Links LinkPixels(const cv::Mat1f& filled, const cv::Mat1b& image, const cv::Mat1b& floor,
                 const DisparityTolerance& tolerance, const FieldOptions& options) {
  const Tie tie{static_cast<float>(options.coupling), tolerance,
                static_cast<float>(options.contrast)};
  Links links{cv::Mat1f(image.size(), 0.0F), cv::Mat1f(image.size(), 0.0F)};
  ParallelFor(0, image.rows, [&](int y) {
    const auto to = [&](int y2, int dx) {
      return Ends{filled[y], filled[y2] + dx, image[y], image[y2] + dx, floor[y], floor[y2] + dx};
    };
    tie.Row(to(y, 1), image.cols - 1, links.right[y]);
    if (y + 1 < image.rows) tie.Row(to(y + 1, 0), image.cols, links.down[y]);
  });
  return links;
}

cv::Mat1f SolveField(const cv::Mat1f& evidence, const Links& links) {
  Sweeper sweeper(evidence, links);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    sweep % 2 == 0 ? sweeper.Sweep<1>() : sweeper.Sweep<-1>();
  }
  return sweeper.log_odds();
}

cv::Mat1b GrowMoving(const cv::Mat1f& field, const cv::Mat1f& evidence, const Links& links,
                     const cv::Mat1b& floor, const cv::Mat1f& farthest,
                     const FieldOptions& options) {
  cv::Mat1b moving;
  cv::compare(field, options.moving, moving, cv::CMP_GT);
  std::vector<cv::Point> front, next;
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.cols; ++x) {
      if (moving(y, x) != 0 && evidence(y, x) > static_cast<float>(options.moving)) {
        front.emplace_back(x, y);
      }
    }
  }
  const auto least_link = static_cast<float>(options.grow_link * options.coupling);
  const auto reach = [&](int x, int y, float link) {
    if (link < least_link || moving(y, x) != 0 || floor(y, x) != 0) return;
    if (evidence(y, x) < static_cast<float>(options.grow_to)) return;
    moving(y, x) = 255;
    next.emplace_back(x, y);
  };
  for (int ring = 0; !front.empty(); ++ring) {
    next.clear();
    for (const cv::Point& p : front) {
      if (static_cast<float>(ring) >= farthest(p)) continue;
      if (p.x > 0) reach(p.x - 1, p.y, links.right(p.y, p.x - 1));
      if (p.x + 1 < field.cols) reach(p.x + 1, p.y, links.right(p.y, p.x));
      if (p.y > 0) reach(p.x, p.y - 1, links.down(p.y - 1, p.x));
      if (p.y + 1 < field.rows) reach(p.x, p.y + 1, links.down(p.y, p.x));
    }
    std::swap(front, next);
  }
  return moving;
}

}  // namespace aisle::slam::dynamic
