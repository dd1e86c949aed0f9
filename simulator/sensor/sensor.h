#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace aisle::sim {

/// A monochrome global-shutter camera in the manner of onsemi's MT9V034 (752 × 480, 6 µm pixels),
/// the sensor of EuRoC's stereo head. Electrons follow the photon transfer law: the variance of the
/// signal is its mean plus the read noise's. Figures in the order of that sensor's class (EMVA 1288
/// measurements of MT9V034 cameras by their makers): full well about 10 000 e-, dark noise about
/// 20 e- rms, hence a signal-to-noise ratio of 100 in the lights.
struct SensorOptions {
  float exposure = 1.0f;         ///< grey level, as a share of white, of radiance 1
  float full_well_e = 10000.0f;  ///< electrons at white at gain 1
  float gain = 1.0f;             ///< analogue: white is reached at full_well_e / gain
  float read_noise_e = 20.0f;    ///< rms, electrons
  float black_level = 2.0f;      ///< grey levels added before rounding
  float vignetting = 0.25f;      ///< share of the light lost in the farthest corner
  bool noise = true;             ///< shot and read noise
  float blur_px = 0.45f;         ///< standard deviation of the lens's point spread; 0: none

  /// The first rule broken, with name, value and bound; empty if none is.
  std::string Validate() const;
};

/// What identifies a picture's noise: the same key and pixel give the same noise.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint32_t frame = 0;
  std::uint32_t camera = 0;
};

/// Fall-off of the lens, a factor a pixel, from each pixel's ray (x, y, 1): it loses light with the
/// fourth power of the sine of the field angle, like cos⁴ to second order, `vignetting` in the
/// farthest corner.
cv::Mat1f VignettingMap(int width, int height, const std::vector<float>& ray_x,
                        const std::vector<float>& ray_y, float vignetting);

/// The image as the lens spreads it: a Gaussian of `sigma_px`; 0 returns it as it is.
cv::Mat1f SpreadByLens(const cv::Mat1f& radiance, float sigma_px);

/// Linear radiance to 8-bit grey (gamma 1): exposure, vignetting, shot and read noise, rounding.
/// Parallel over rows; each pixel's noise depends on the key and its place alone.
cv::Mat1b Expose(const cv::Mat1f& radiance, const cv::Mat1f& vignetting,
                 const SensorOptions& options, const NoiseKey& key);

}  // namespace aisle::sim
