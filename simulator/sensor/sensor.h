#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "simulator/sensor/lens.h"
#include "simulator/sensor/tone.h"

namespace aisle::sim {

/// A monochrome camera. Electrons follow the photon transfer law: the variance of the signal is its
/// mean plus the read noise's. These defaults are a sharp, clean camera with round figures, the
/// scene file's preset `ideal`; the figures of a real one, which scenes have by default, stand with
/// their sources in simulator/scene/sensor_spec.h.
struct SensorOptions {
  float exposure = 1.0f;         ///< grey level, as a share of white, of radiance 1
  float full_well_e = 10000.0f;  ///< electrons at white at gain 1
  float gain = 1.0f;             ///< analogue: white is reached at full_well_e / gain
  float read_noise_e = 20.0f;    ///< rms, electrons
  float black_level = 2.0f;      ///< grey levels added before the tone curve
  Tone tone = Tone::kLinear;     ///< from the share of white to grey
  float prnu = 0.01f;            ///< rms of the pixels' sensitivity about their mean, a share
  float dsnu_e = 10.0f;          ///< rms of the pixels' dark signal about their mean, electrons
  bool fixed_pattern = true;     ///< prnu and dsnu
  float vignetting = 0.25f;      ///< share of the light lost in the farthest corner
  bool noise = true;             ///< shot and read noise
  LensOptions lens = {};

  /// The first rule broken, with name, value and bound; empty if none is.
  std::string Validate() const;
};

/// What identifies a picture's noise: the same key and pixel give the same noise.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint32_t frame = 0;
  std::uint32_t camera = 0;
};

/// Fall-off of the lens, a factor a pixel, from each pixel's ray (x, y, 1): the natural law's cos⁴
/// of the field angle, its loss scaled so that the farthest corner loses the share `vignetting`.
cv::Mat1f VignettingMap(int width, int height, const std::vector<float>& ray_x,
                        const std::vector<float>& ray_y, float vignetting);

/// What each pixel of one camera makes of its light, in every frame alike.
struct PixelResponse {
  cv::Mat1f gain;    ///< fall-off of the lens times the pixel's own sensitivity
  cv::Mat1f dark_e;  ///< electrons without light, about the black level; empty: none
};

/// Fixed-pattern noise of camera number `camera` on top of the lens's fall-off: normal deviates of
/// (seed, camera, pixel) alone. Switched off, the response is the fall-off itself.
PixelResponse MakeResponse(const cv::Mat1f& vignetting, const SensorOptions& options,
                           std::uint64_t seed, std::uint32_t camera);

/// Linear radiance to 8-bit grey: exposure, pixel response, shot and read noise, black level, tone
/// curve, rounding. Parallel over rows; each pixel's noise depends on the key and its place alone.
cv::Mat1b Expose(const cv::Mat1f& radiance, const PixelResponse& response,
                 const SensorOptions& options, const NoiseKey& key);

}  // namespace aisle::sim
