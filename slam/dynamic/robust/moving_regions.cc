#include "slam/dynamic/robust/moving_regions.h"

#include <set>

namespace aisle::slam::dynamic {
namespace {

struct Component {
  cv::Point low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max()}, high{-1, -1};
  int pixels = 0, core = 0;
  int speaking = 0;          // pixels that say something, for motion or against
  double sum = 0;            // of log-odds
  std::vector<int> overlap;  // pixels, by the previous region's index
};

/// Sets that merge, named by their smallest member.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) {
    for (std::size_t k = 0; k < size; ++k) parent_[k] = static_cast<int>(k);
  }
  int Find(int k) {
    while (parent_[At(k)] != k) k = parent_[At(k)] = parent_[At(parent_[At(k)])];
    return k;
  }
  void Join(int a, int b) {
    a = Find(a);
    b = Find(b);
    parent_[At(std::max(a, b))] = std::min(a, b);
  }

 private:
  static std::size_t At(int k) { return static_cast<std::size_t>(k); }
  std::vector<int> parent_;
};

/// Per pixel the number of its component, from 1; 0 where nothing moves. Returns their count.
int LabelComponents(const cv::Mat1b& moving, const Links& links, float least_link,
                    cv::Mat1i& labels) {
  CV_Assert(moving.isContinuous());
  const int pixels = moving.rows * moving.cols;
  Sets sets(static_cast<std::size_t>(pixels));
  for (int y = 0; y < moving.rows; ++y) {
    for (int x = 0; x < moving.cols; ++x) {
      if (moving(y, x) == 0) continue;
      const int k = y * moving.cols + x;
      if (x + 1 < moving.cols && moving(y, x + 1) != 0 && links.right(y, x) >= least_link) {
        sets.Join(k, k + 1);
      }
      if (y + 1 < moving.rows && moving(y + 1, x) != 0 && links.down(y, x) >= least_link) {
        sets.Join(k, k + moving.cols);
      }
    }
  }
  labels.create(moving.size());
  const unsigned char* moves = moving[0];
  int *label = labels[0], count = 0;
  for (int k = 0; k < pixels; ++k) {
    if (moves[k] == 0) {
      label[k] = 0;
      continue;
    }
    const int root = sets.Find(k);  // is the first of its set in raster order
    label[k] = root == k ? ++count : label[root];
  }
  return count;
}

std::vector<Component> Describe(const cv::Mat1i& labels, int count, const cv::Mat1f& log_odds,
                                const PixelRegions& previous, const FieldOptions& field,
                                const RegionOptions& options) {
  Component none;
  none.overlap.resize(previous.regions.size(), 0);
  std::vector<Component> components(static_cast<std::size_t>(count) + 1, none);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      if (labels(y, x) == 0) continue;
      Component& component = components[static_cast<std::size_t>(labels(y, x))];
      component.low = {std::min(component.low.x, x), std::min(component.low.y, y)};
      component.high = {std::max(component.high.x, x), std::max(component.high.y, y)};
      ++component.pixels;
      component.sum += log_odds(y, x);
      component.speaking += std::abs(log_odds(y, x)) >= static_cast<float>(field.moving) ? 1 : 0;
      component.core += log_odds(y, x) > static_cast<float>(options.core_log_odds) ? 1 : 0;
      const int before = previous.labels.empty() ? 0 : previous.labels(y, x);
      if (before > 0) ++component.overlap[static_cast<std::size_t>(before - 1)];
    }
  }
  return components;
}

/// The previous region that most of a component was, of those not taken by a larger one; -1 if it
/// has too little in common with it.
int Predecessor(const Component& component, const PixelRegions& previous,
                const std::set<int>& taken, const RegionOptions& options) {
  int best = -1, most = 0;
  for (int before = 0; before < static_cast<int>(component.overlap.size()); ++before) {
    const int pixels = component.overlap[static_cast<std::size_t>(before)];
    if (pixels <= most || taken.contains(before)) continue;
    most = pixels;
    best = before;
  }
  if (best < 0) return -1;
  const int smaller =
      std::min(component.pixels, previous.regions[static_cast<std::size_t>(best)].pixels);
  return most >= options.overlap * smaller ? best : -1;
}

/// The plain cloth of someone who fills the view says nothing, and does not refute his seams once
/// they have been seen to move; around what has not been seen before it does.
bool IsMoving(const Component& component, bool known, double least_mean,
              const RegionOptions& options) {
  const int voting = known ? component.speaking : component.pixels;
  return component.sum >= least_mean * voting &&
         component.core >= (known ? options.keep_core_px : options.birth_core_px);
}

std::vector<std::size_t> LargestFirst(const std::vector<Component>& components) {
  std::vector<std::size_t> order;
  for (std::size_t c = 1; c < components.size(); ++c) order.push_back(c);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return components[a].pixels > components[b].pixels;
  });
  return order;
}

}  // namespace

PixelRegions FindRegions(const cv::Mat1b& moving, const cv::Mat1f& log_odds, const Links& links,
                         const PixelRegions& previous, const FieldOptions& field,
                         const RegionOptions& options) {
  PixelRegions found{.labels = {}, .regions = {}, .next_id = previous.next_id};
  const int count = LabelComponents(
      moving, links, static_cast<float>(options.link * field.coupling), found.labels);
  const auto components = Describe(found.labels, count, log_odds, previous, field, options);
  std::vector<int> label_of(components.size(), 0);
  std::set<int> taken;
  for (const std::size_t c : LargestFirst(components)) {
    const Component& component = components[c];
    const int before = Predecessor(component, previous, taken, options);
    if (!IsMoving(component, before >= 0, field.moving, options)) continue;
    if (before >= 0) taken.insert(before);
    const int id =
        before >= 0 ? previous.regions[static_cast<std::size_t>(before)].id : found.next_id++;
    found.regions.push_back({id, cv::Rect(component.low, component.high + cv::Point(1, 1)),
                             component.pixels, component.sum / component.pixels});
    label_of[c] = static_cast<int>(found.regions.size());
  }
  for (int& label : std::span(found.labels[0], found.labels.total())) {
    label = label_of[static_cast<std::size_t>(label)];
  }
  return found;
}

}  // namespace aisle::slam::dynamic
