#include "simulator/sensor/sensor.h"

#include <array>
#include <cmath>

#include "simulator/common/mix.h"
#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

/// Standard normal deviates at the middle of 4096 equally likely intervals: a table look-up costs a
/// tenth of a logarithm and a cosine, and a 12-bit normal is far finer than an 8-bit pixel.
constexpr int kTableBits = 12;

/// Keeps the fixed pattern's random numbers apart from the noise's.
constexpr std::uint64_t kPatternStream = 0x5851f42d4c957f2d;

/// Inverse of the normal distribution (Acklam's rational approximation, 1e-9 relative).
double InverseNormal(double p) {
  constexpr std::array a = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                            1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr std::array b = {-5.447609879822406e+01, 1.615858368580409e+02, -1.556989798598866e+02,
                            6.680131188771972e+01, -1.328068155288572e+01};
  constexpr std::array c = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                            -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr std::array d = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                            3.754408661907416e+00};
  if (p < 0.02425) {
    const double q = std::sqrt(-2 * std::log(p));
    return (((((c[0] * q + c[1]) * q + c[2]) * q + c[3]) * q + c[4]) * q + c[5]) /
           ((((d[0] * q + d[1]) * q + d[2]) * q + d[3]) * q + 1);
  }
  if (p > 1 - 0.02425) return -InverseNormal(1 - p);
  const double q = p - 0.5, r = q * q;
  return (((((a[0] * r + a[1]) * r + a[2]) * r + a[3]) * r + a[4]) * r + a[5]) * q /
         (((((b[0] * r + b[1]) * r + b[2]) * r + b[3]) * r + b[4]) * r + 1);
}

std::vector<float> NormalTable() {
  constexpr int kSize = 1 << kTableBits;
  std::vector<float> table(kSize);
  for (int i = 0; i < kSize; ++i) {
    table[static_cast<std::size_t>(i)] = static_cast<float>(InverseNormal((i + 0.5) / kSize));
  }
  return table;
}

/// A hash of a 32-bit counter under a key (Wellons' low-bias mixer), cheap enough for a loop that
/// runs eight lanes wide.
std::uint32_t Mix32(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x21f0aaadu;
  x = (x ^ (x >> 15)) * 0xd35a2d97u;
  return x ^ (x >> 15);
}

}  // namespace

std::string SensorOptions::Validate() const {
  const auto positive = [](const char* name, float value) {
    return value > 0 ? "" : fmt::format("{} is {}, must be above 0", name, value);
  };
  for (const auto& error : {positive("exposure", exposure), positive("full_well_e", full_well_e),
                            positive("gain", gain)}) {
    if (!error.empty()) return error;
  }
  const std::array not_negative = {std::pair("read_noise_e", read_noise_e), std::pair("prnu", prnu),
                                   std::pair("dsnu_e", dsnu_e)};
  for (const auto& [name, value] : not_negative) {
    if (!(value >= 0)) return fmt::format("{} is {}, must be ≥ 0", name, value);
  }
  if (!(vignetting >= 0 && vignetting <= 1)) {
    return fmt::format("vignetting is {}, must be in [0, 1]", vignetting);
  }
  return lens.Validate();
}

cv::Mat1f VignettingMap(int width, int height, const std::vector<float>& ray_x,
                        const std::vector<float>& ray_y, float vignetting) {
  cv::Mat1f map(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      const float squared = ray_x[i] * ray_x[i] + ray_y[i] * ray_y[i];
      const float sine_squared = squared / (1 + squared);
      map(y, x) = sine_squared * (2 - sine_squared);  // 1 - cos⁴
    }
  }
  double farthest = 0;
  cv::minMaxLoc(map, nullptr, &farthest);
  return cv::Mat1f(1 - map * (vignetting / std::max(farthest, 1e-12)));
}

PixelResponse MakeResponse(const cv::Mat1f& vignetting, const SensorOptions& options,
                           std::uint64_t seed, std::uint32_t camera) {
  if (!options.fixed_pattern) return {vignetting, {}};
  static const std::vector<float> normal = NormalTable();
  const std::uint64_t stream = Mix(Mix(seed + kPatternStream) ^ camera);
  PixelResponse response{vignetting.clone(), cv::Mat1f(vignetting.size())};
  for (int y = 0; y < vignetting.rows; ++y) {
    for (int x = 0; x < vignetting.cols; ++x) {
      const std::uint64_t random =
          Mix(stream ^ (static_cast<std::uint64_t>(y) << 32 | static_cast<std::uint32_t>(x)));
      response.gain(y, x) *= 1 + options.prnu * normal[random >> (64 - kTableBits)];
      response.dark_e(y, x) = options.dsnu_e * normal[random & ((1u << kTableBits) - 1)];
    }
  }
  return response;
}

cv::Mat1b Expose(const cv::Mat1f& radiance, const PixelResponse& response,
                 const SensorOptions& options, const NoiseKey& key) {
  static const std::vector<float> normal = NormalTable();
  const std::uint64_t stream =
      Mix(Mix(key.seed + kGolden) ^ (static_cast<std::uint64_t>(key.frame) << 32 | key.camera));
  const float white_e = options.full_well_e / options.gain;
  const float electrons_per_radiance = options.exposure * white_e;
  const float grey_per_electron = 255 / white_e;
  const float read_variance = options.noise ? options.read_noise_e * options.read_noise_e : 0;
  const float shot = options.noise ? 1.0f : 0.0f;
  const bool companded = options.tone == Tone::kCompanded;

  const std::vector<float> nothing(
      response.dark_e.empty() ? static_cast<std::size_t>(radiance.cols) : 0, 0.0f);
  cv::Mat1b image(radiance.size());
  ParallelFor(0, radiance.rows, [&](int y) {
    const float* light = radiance[y];
    const float* gain = response.gain[y];
    const float* dark = response.dark_e.empty() ? nothing.data() : response.dark_e[y];
    std::uint8_t* grey = image[y];
    const auto row = static_cast<std::uint32_t>(Mix(stream + static_cast<std::uint64_t>(y)));
    for (int x = 0; x < radiance.cols; ++x) {
      const float mean = light[x] * gain[x] * electrons_per_radiance;
      const std::uint32_t random = Mix32(row ^ Mix32(static_cast<std::uint32_t>(x)));
      const float deviate = normal[random >> (32 - kTableBits)];
      const float electrons = mean + dark[x] + std::sqrt(shot * mean + read_variance) * deviate;
      const float level = electrons * grey_per_electron + options.black_level;
      const float value = (companded ? 255 * Compand(level / 255) : level) + 0.5f;
      grey[x] = static_cast<std::uint8_t>(std::min(std::max(value, 0.0f), 255.0f));
    }
  });
  return image;
}

}  // namespace aisle::sim
