#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>

namespace aisle::slam {

/// A number in [0, 1) that depends on nothing but its arguments.
inline double Uniform(std::uint64_t seed, std::int64_t a, std::int64_t b) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15ULL +
                    static_cast<std::uint64_t>(a) * 0xd6e8feb86659fd93ULL +
                    static_cast<std::uint64_t>(b) * 0xa0761d6478bd642fULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1.0p-53;
}

/// A smooth random texture over the plane, defined everywhere: bright and dark tiles of a grid of
/// `cell` units, jittered, with soft edges, at two scales. Grey levels around 128.
class Texture {
 public:
  explicit Texture(std::uint64_t seed, double cell = 9) : seed_(seed), cell_(cell) {}

  double operator()(double x, double y) const {
    return 128 + 55 * Layer(seed_, x, y, cell_) + 30 * Layer(seed_ + 1, x, y, 3.1 * cell_);
  }

 private:
  static double Smooth(double t) { return t * t * t * (t * (6 * t - 15) + 10); }
  static double Layer(std::uint64_t seed, double x, double y, double cell) {
    const double fx = std::floor(x / cell), fy = std::floor(y / cell);
    const auto i = static_cast<std::int64_t>(fx), j = static_cast<std::int64_t>(fy);
    const double a = Smooth(x / cell - fx), b = Smooth(y / cell - fy);
    const auto value = [&](std::int64_t dx, std::int64_t dy) {
      return 2 * Uniform(seed, i + dx, j + dy) - 1;
    };
    return (1 - b) * ((1 - a) * value(0, 0) + a * value(1, 0)) +
           b * ((1 - a) * value(0, 1) + a * value(1, 1));
  }

  std::uint64_t seed_;
  double cell_;
};

/// An image of `grey(u, v)` with uniform noise of the given amplitude.
inline cv::Mat1b Render(cv::Size size, const std::function<double(double, double)>& grey,
                        double noise = 0, std::uint64_t seed = 7) {
  cv::Mat1b image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double value = grey(x, y) + noise * (2 * Uniform(seed, x, y) - 1);
      image(y, x) = cv::saturate_cast<std::uint8_t>(value);
    }
  }
  return image;
}

}  // namespace aisle::slam
