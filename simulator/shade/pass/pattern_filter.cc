#include "simulator/shade/pass/pattern_filter.h"

#include <Eigen/Core>
#include <utility>

namespace aisle::sim {
namespace {

// Half weights at the ends: each of the sixteen pattern positions then counts the same.
constexpr std::array<float, 5> kWeights = {0.5f, 1, 1, 1, 0.5f};
constexpr int kReach = 2;  // pixels
constexpr float kSameDepth = 0.05f;
constexpr float kSameWay = 0.9f;  // cosine between normals

}  // namespace

void PatternFilter::Packet(int x, int y, I8 wanted, std::vector<float>* means) const {
  const std::size_t i = image_.Index(x, y);
  if (Inside(x, y)) {
    Store(Select(wanted, Mean8(i), LoadF(&(*means)[i])), &(*means)[i]);
    return;
  }
  for (int k = 0; k < kLanes && x + k < image_.width; ++k) {
    const std::size_t at = i + static_cast<std::size_t>(k);
    if (wanted[k]) (*means)[at] = Mean(x + k, y);
  }
}

bool PatternFilter::OnesAround(int x, int y) const {
  if (!Inside(x, y)) return false;
  const auto stride = static_cast<std::size_t>(image_.stride);
  const float* first = &raw_[image_.Index(x, y) - kReach * stride - kReach];
  I8 other{};
  for (std::size_t row = 0; row < 2 * kReach + 1; ++row, first += stride) {
    other |= (LoadF(first) != 1) | (LoadF(first + 2 * kReach) != 1);
  }
  return !Any(other);
}

bool PatternFilter::Inside(int x, int y) const {
  return x > 0 && y >= kReach && x + 2 * kLanes <= image_.width && y + kReach < image_.height;
}

bool PatternFilter::SameSurface(std::size_t i, std::size_t j) const {
  if (image_.geometry[j] != image_.geometry[i]) return false;
  if (std::abs(image_.t[j] - image_.t[i]) > kSameDepth * image_.t[i]) return false;
  if (image_.geometry[i] != 0 || image_.primitive[j] == image_.primitive[i]) return true;
  const Eigen::Map<const Eigen::Vector3f> n(statics_[image_.primitive[i]].normal);
  const Eigen::Map<const Eigen::Vector3f> m(statics_[image_.primitive[j]].normal);
  return n.dot(m) > kSameWay;
}

float PatternFilter::Mean(int x, int y) const {
  const std::size_t i = image_.Index(x, y);
  float sum = 0, weights = 0;
  for (int py = std::max(0, y - 2); py <= std::min(image_.height - 1, y + 2); ++py) {
    for (int px = std::max(0, x - 2); px <= std::min(image_.width - 1, x + 2); ++px) {
      const std::size_t j = image_.Index(px, py);
      if (!SameSurface(i, j)) continue;
      const float w = kWeights[static_cast<std::size_t>(px - x + 2)] *
                      kWeights[static_cast<std::size_t>(py - y + 2)];
      sum += w * raw_[j];
      weights += w;
    }
  }
  return std::max(0.0f, sum / weights);
}

F8x3 PatternFilter::Normals(I8 primitive, I8 valid) const {
  const I8 offset =
      (valid ? primitive : I8{}) * static_cast<int>(sizeof(SurfaceRecord) / sizeof(float));
  const float* base = statics_.data()->normal;
  return {Gather(base, offset), Gather(base, offset + 1), Gather(base, offset + 2)};
}

F8 PatternFilter::Mean8(std::size_t i) const {
  const F8 depth = LoadF(&image_.t[i]);
  const I8 primitive = LoadI(&image_.primitive[i]), geometry = LoadI(&image_.geometry[i]);
  const I8 is_static = geometry == 0;
  F8x3 normal;
  bool has_normal = false;
  F8 sum = Wide(0), weights = Wide(0);
  for (std::size_t row = 0; row < 5; ++row) {
    for (std::size_t column = 0; column < 5; ++column) {
      const std::size_t j = i + row * static_cast<std::size_t>(image_.stride) + column -
                            (2 * static_cast<std::size_t>(image_.stride) + 2);
      I8 same = LoadI(&image_.geometry[j]) == geometry;
      same &= Abs(LoadF(&image_.t[j]) - depth) <= kSameDepth * depth;
      const I8 other = LoadI(&image_.primitive[j]);
      const I8 in_doubt = same & is_static & (other != primitive);
      if (Any(in_doubt)) {
        if (!std::exchange(has_normal, true)) normal = Normals(primitive, is_static);
        same &= ~in_doubt | (Dot(Normals(other, in_doubt), normal) > kSameWay);
      }
      const F8 w = Select(same, Wide(kWeights[row] * kWeights[column]), Wide(0));
      sum += w * LoadF(&raw_[j]);
      weights += w;
    }
  }
  return Max(Wide(0), sum / Max(weights, Wide(1e-6f)));
}

}  // namespace aisle::sim
