#include "simulator/scene/mezzanine.h"

#include <algorithm>
#include <cmath>

namespace aisle::sim {
namespace {

constexpr float kBay_m = 3.2f;    ///< at most so far from column to column
constexpr float kInset_m = 0.1f;  ///< of the outer columns
constexpr float kRise_m = 0.19f;  ///< at least, of a step

}  // namespace

std::vector<float> Evenly(float from, float to, int parts) {
  std::vector<float> points;
  for (int i = 0; i <= parts; ++i) {
    points.push_back(from + (to - from) * static_cast<float>(i) / static_cast<float>(parts));
  }
  return points;
}

std::vector<float> Divide(float from, float to, float pitch) {
  return Evenly(from, to, std::max(1, static_cast<int>(std::ceil((to - from) / pitch))));
}

MezzanineFeet FeetOf(const MezzanineSpec& mezzanine) {
  const Eigen::Vector2f low = mezzanine.from.cast<float>(), high = mezzanine.to.cast<float>();
  const auto deck = static_cast<float>(mezzanine.height_m);
  return {Divide(low.x() + kInset_m, high.x() - kInset_m, kBay_m),
          Divide(low.y() + kInset_m, high.y() - kInset_m, kBay_m),
          {high.x() - 1.0f, low.y()},
          std::max(1, static_cast<int>(std::floor(deck / kRise_m)))};
}

}  // namespace aisle::sim
