#include "slam/flow/patch_flow.h"

#include <opencv2/imgproc.hpp>

#include "slam/flow/eight.h"
#include "slam/flow/refine_flow.h"

namespace aisle::slam {
namespace {

constexpr int kMargin = 16;  // pixels around an image into which a patch may move

/// A patch of the view at a place between pixels.
class Sampler {
 public:
  Sampler(const cv::Mat1f& padded, float x, float y) {
    const float most_x = static_cast<float>(padded.cols - kFlowPatch - 2),
                most_y = static_cast<float>(padded.rows - kFlowPatch - 2);
    x = std::clamp(x + kMargin, 0.0F, most_x);
    y = std::clamp(y + kMargin, 0.0F, most_y);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float right = x - static_cast<float>(column), lower = y - static_cast<float>(row);
    at_ = padded[row] + column;
    step_ = static_cast<std::ptrdiff_t>(padded.step1());
    weights_ = {(1 - right) * (1 - lower), right * (1 - lower), (1 - right) * lower, right * lower};
  }
  /// What a row of the patch differs by from `image` there.
  void Subtract(int row, const float* image, Eight& off) const {
    const float *upper = at_ + row * step_, *lower = upper + step_;
    Eight upper_left, upper_right, lower_left, lower_right, here;
    Load(upper, upper_left);
    Load(upper + 1, upper_right);
    Load(lower, lower_left);
    Load(lower + 1, lower_right);
    Load(image, here);
    off = weights_[0] * upper_left + weights_[1] * upper_right +
          (weights_[2] * lower_left + weights_[3] * lower_right) - here;
  }

 private:
  const float* at_;
  std::ptrdiff_t step_;
  std::array<float, 4> weights_;
};

struct Shift {
  float u = 0, v = 0;
};

struct PatchDifference {
  float squares = 0;  // without the mean
  float along_x = 0, along_y = 0;
};

PatchDifference Compare(const FlowLevel& level, const FlowPatch& patch, const cv::Mat1f& padded,
                        const Shift& shift) {
  const Sampler sampler(padded, static_cast<float>(patch.x) + shift.u,
                        static_cast<float>(patch.y) + shift.v);
  Eight sum{}, squares{}, along_x{}, along_y{}, off, gradient_x, gradient_y;
  for (int row = 0; row < kFlowPatch; ++row) {
    const int y = patch.y + row;
    sampler.Subtract(row, level.image[y] + patch.x, off);
    Load(level.gradient_x[y] + patch.x, gradient_x);
    Load(level.gradient_y[y] + patch.x, gradient_y);
    sum += off;
    squares += off * off;
    along_x += off * gradient_x;
    along_y += off * gradient_y;
  }
  const float mean = Sum(sum) / (kFlowPatch * kFlowPatch);
  return {Sum(squares) - mean * Sum(sum), Sum(along_x) - mean * patch.sum_x,
          Sum(along_y) - mean * patch.sum_y};
}

/// Gauss-Newton with the derivatives of the image that stays, as long as the fit gets better. What
/// the coarser size found counts as `inertia` for either direction.
Shift Descend(const FlowLevel& level, const FlowPatch& patch, const cv::Mat1f& padded,
              const Shift& start, float inertia, int descents) {
  constexpr float kEnough = 0.02F;  // pixels
  Shift best = start, next = start;
  float least = std::numeric_limits<float>::max();
  for (int k = 0; k <= descents; ++k) {
    const PatchDifference ssd = Compare(level, patch, padded, next);
    const float u = next.u - start.u, v = next.v - start.v;
    const float energy = ssd.squares + inertia * (u * u + v * v);
    if (energy >= least) break;
    least = energy;
    best = next;
    const float x = ssd.along_x + inertia * u, y = ssd.along_y + inertia * v;
    const float du = patch.xx * x + patch.xy * y;
    const float dv = patch.xy * x + patch.yy * y;
    if (du * du + dv * dv < kEnough * kEnough) break;
    next = {next.u - du, next.v - dv};
  }
  const float u = best.u - start.u, v = best.v - start.v;
  return u * u + v * v > kFlowPatch * kFlowPatch ? start : best;
}

/// Flow that its patches' shifts average to, and the weights.
struct Average {
  explicit Average(cv::Size size) : u(size, 0.0F), v(size, 0.0F), weight(size, 0.0F) {}
  cv::Mat1f u, v, weight;
};

void Add(const Eight& what, float* to) {
  Eight sum;
  Load(to, sum);
  Store(sum + what, to);
}

/// A pixel's weight falls with how ill it fits there.
void Spread(const FlowLevel& level, const FlowPatch& patch, const cv::Mat1f& padded,
            const Shift& shift, Average& average) {
  const Sampler sampler(padded, static_cast<float>(patch.x) + shift.u,
                        static_cast<float>(patch.y) + shift.v);
  for (int row = 0; row < kFlowPatch; ++row) {
    const int y = patch.y + row;
    Eight off;
    sampler.Subtract(row, level.image[y] + patch.x, off);
    const Eight size = off < 0 ? -off : off;
    const Eight one = Eight{} + 1;
    const Eight weight = one / (size > one ? size : one);
    Add(weight * shift.u, average.u[y] + patch.x);
    Add(weight * shift.v, average.v[y] + patch.x);
    Add(weight, average.weight[y] + patch.x);
  }
}

/// Where the coarser flow leads the middle of a patch.
Shift StartOf(const FlowPatch& patch, const cv::Mat1f& u, const cv::Mat1f& v) {
  if (u.empty()) return {};
  const int x = std::min(patch.x / 2 + 1, u.cols - 2), y = std::min(patch.y / 2 + 1, u.rows - 2);
  const auto middle = [&](const cv::Mat1f& of) {
    return (of(y, x) + of(y, x + 1) + of(y + 1, x) + of(y + 1, x + 1)) / 4;
  };
  return {2 * middle(u), 2 * middle(v)};
}

}  // namespace

cv::Mat2f FlowTo(const cv::Mat1b& view, const FlowPyramid& image, const DenseFlowOptions& options) {
  cv::Mat2f flow(view.size(), cv::Vec2f(0, 0));
  if (image.empty()) return flow;
  const std::vector<cv::Mat1f> views = HalvedAgainAndAgain(view, options);
  const auto inertia = static_cast<float>(options.inertia);
  cv::Mat1f u, v;
  for (std::size_t k = image.size(); k-- > 0;) {
    const FlowLevel& level = image[k];
    cv::Mat1f padded;
    cv::copyMakeBorder(views[k], padded, kMargin, kMargin, kMargin, kMargin, cv::BORDER_REPLICATE);
    Average average(level.image.size());
    for (const FlowPatch& patch : level.patches) {
      const Shift shift =
          Descend(level, patch, padded, StartOf(patch, u, v), inertia, options.descents);
      Spread(level, patch, padded, shift, average);
    }
    cv::divide(average.u, average.weight, u);
    cv::divide(average.v, average.weight, v);
    RefineFlow(level.image, views[k], options.refinements, u, v);
  }
  cv::Mat2f small;
  cv::merge(std::vector<cv::Mat>{u, v}, small);
  small *= 1 << options.finest_scale;
  cv::resize(small, flow, flow.size(), 0, 0, cv::INTER_LINEAR);
  return flow;
}

}  // namespace aisle::slam
