#include "slam/map/align_patch.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace aisle::slam {
namespace {

constexpr int kLargestSide = 2 * kLargestPatchRadius + 1;
using Pixels = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kLargestSide * kLargestSide, 1>;

/// Bilinear; NaN outside.
double Sample(const FeaturePatch& patch, const Eigen::Vector2d& at) {
  constexpr int kReach = FeaturePatch::kReach;
  const double left = std::floor(at.x()), top = std::floor(at.y());
  if (!(left >= -kReach && top >= -kReach && left < kReach && top < kReach)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const int x = static_cast<int>(left), y = static_cast<int>(top);
  const double a = at.x() - left, b = at.y() - top;
  return (1 - b) * ((1 - a) * patch.At(x, y) + a * patch.At(x + 1, y)) +
         b * ((1 - a) * patch.At(x, y + 1) + a * patch.At(x + 1, y + 1));
}

void RemoveMean(Pixels& pixels) { pixels.array() -= pixels.mean(); }

/// What is looked for, and how it changes with a shift.
struct Template {
  Pixels grey, by_x, by_y;  ///< free of brightness, the derivatives of contrast too
  double contrast = 0;      ///< sum of squares
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();  ///< of the derivatives' products
};

std::optional<Template> MakeTemplate(const FeaturePatch& before, const Eigen::Vector2d& before_px,
                                     const Eigen::Matrix2d& J_before_now, int radius) {
  const int side = 2 * radius + 1, count = side * side;
  const auto at = [&](int x, int y) {
    return Sample(before, before_px + J_before_now * Eigen::Vector2d(x, y));
  };
  Template model{Pixels(count), Pixels(count), Pixels(count)};
  int k = 0;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x, ++k) {
      model.grey[k] = at(x, y);
      model.by_x[k] = (at(x + 1, y) - at(x - 1, y)) / 2;
      model.by_y[k] = (at(x, y + 1) - at(x, y - 1)) / 2;
    }
  }
  if (!model.by_x.allFinite() || !model.by_y.allFinite()) return std::nullopt;
  for (Pixels* pixels : {&model.grey, &model.by_x, &model.by_y}) RemoveMean(*pixels);
  model.contrast = model.grey.squaredNorm();
  if (model.contrast < count) return std::nullopt;
  for (Pixels* slope : {&model.by_x, &model.by_y}) {
    *slope -= model.grey * (model.grey.dot(*slope) / model.contrast);
  }
  Eigen::Matrix2d H;
  H << model.by_x.squaredNorm(), model.by_x.dot(model.by_y), model.by_x.dot(model.by_y),
      model.by_y.squaredNorm();
  // An edge tells nothing along itself.
  constexpr double kLeastRatio = 1e-3;
  if (H.trace() < count || H.determinant() < kLeastRatio * H.trace() * H.trace()) {
    return std::nullopt;
  }
  model.inverse = H.inverse();
  return model;
}

}  // namespace

std::optional<AlignedPoint> AlignPatch(const FeaturePatch& before, const Eigen::Vector2d& before_px,
                                       const Eigen::Matrix2d& J_before_now, const FeaturePatch& now,
                                       const PatchOptions& options) {
  constexpr double kSettled_px = 0.02, kMostGain = 3;
  const int radius = options.radius_px;
  const auto model = MakeTemplate(before, before_px, J_before_now, radius);
  if (!model) return std::nullopt;
  const auto count = static_cast<double>(model->grey.size());
  AlignedPoint found;
  Pixels off(model->grey.size());
  for (int i = 0; i < options.iterations; ++i) {
    int k = 0;
    for (int y = -radius; y <= radius; ++y) {
      for (int x = -radius; x <= radius; ++x, ++k) {
        off[k] = Sample(now, found.shift_px + Eigen::Vector2d(x, y));
      }
    }
    if (!off.allFinite()) return std::nullopt;
    RemoveMean(off);
    const double gain = model->grey.dot(off) / model->contrast;
    if (gain < 1 / kMostGain || gain > kMostGain) return std::nullopt;
    off = off / gain - model->grey;
    const Eigen::Vector2d step =
        -model->inverse * Eigen::Vector2d(model->by_x.dot(off), model->by_y.dot(off));
    found.shift_px += step;
    if (found.shift_px.lpNorm<Eigen::Infinity>() > options.most_shift_px) return std::nullopt;
    if (step.norm() >= kSettled_px) continue;
    const double left = off.squaredNorm();
    if (model->contrast < options.least_correlation * (model->contrast + left)) return std::nullopt;
    const double noise = options.image_noise * options.image_noise * (1 + 1 / (gain * gain));
    found.sigma_px = std::sqrt(std::max(noise, left / count) * model->inverse.trace() / 2);
    return found;
  }
  return std::nullopt;
}

}  // namespace aisle::slam
