#pragma once

#include "simulator/scene/mark.h"

namespace aisle::sim {

enum class SensorPreset { kMt9v034, kIdeal };
enum class ToneSpec { kLinear, kCompanded };

/// What lens and sensor do to the light. The defaults are a camera that one can buy: onsemi's
/// MT9V034 (752 × 480, 6 µm, global shutter), the sensor of EuRoC's stereo head, behind a small
/// lens with fixed focus. Its figures:
///  - full_well_e, read_noise_e: photon transfer (EMVA 1288) on 40 still pictures of EuRoC's
///    V1_01_easy. The temporal variance of plain pixels is a straight line in grey from 35 to 175,
///    0.0139 grey levels a level, hence 72 electrons a level and 255 · 72 to white; what it leaves
///    at black but the rounding's 1/12 is 20 electrons. 20 log(18400 / 20) = 59 dB, the datasheet
///    (Rev. G) says above 55.
///  - prnu, dsnu_e: such sensors' usual 1 % and half the read noise; nothing is published.
///  - gain_db: at 3 dB the noise about grey 100 behind the tone curve is 1.2 levels, EuRoC's.
///  - tone: its own 12 to 10 bit companding, which the datasheet offers for scenes like a hall with
///    lamps in view: shadows stay off black while highlights keep their shades.
///  - sensitivity_e_per_ms: half a stop less than `ideal`, to keep highlights.
///  - black_level: 2.5 before the curve, 10 behind it: EuRoC's darkest pixels.
///  - blur_px, field_blur_px: reports/sensor.md has the MTF; glare: ISO 9358 indices of such lenses
///    are some per cent.
struct SensorSpec {
  Mark mark;
  SensorPreset preset = SensorPreset::kMt9v034;
  double exposure_ms = 8;
  double gain_db = 3;
  bool auto_exposure = false;     ///< chooses time and gain itself
  double auto_target_grey = 110;  ///< mean grey it aims at, of the light without the black
  double auto_meter_from = 0;     ///< share of the height above which the picture is not metered
  double auto_longest_ms = 12;    ///< exposure time beyond which it takes gain instead
  double auto_step_ev = 0;        ///< stops between the settings it has; 0: has any
  bool noise = true;              ///< shot and read noise
  bool fixed_pattern = true;      ///< every pixel's own sensitivity and dark signal
  double sensitivity_e_per_ms = 226000;  ///< electrons that radiance 1 frees in a pixel
  double full_well_e = 18400;            ///< electrons at white at 0 dB
  double read_noise_e = 20;              ///< rms
  double prnu = 0.01;                    ///< rms of the pixels' sensitivity, a share
  double dsnu_e = 10;                    ///< rms of the pixels' dark signal
  double black_level = 2.5;              ///< grey levels before the tone curve
  ToneSpec tone = ToneSpec::kCompanded;
  double vignetting = 0.25;      ///< share of light lost in the corners
  double blur_px = 0.38;         ///< standard deviation of the lens blur in the middle
  double field_blur_px = 0.505;  ///< what the farthest corner adds in quadrature
  double glare = 0.04;           ///< share of the light that veils the picture
  bool motion_blur = false;      ///< things move while the shutter is open
  double readout_ms = 0;         ///< of a rolling shutter, first row to last
};

/// The values that a preset stands for; keys of the file override them.
inline SensorSpec MakeSensor(SensorPreset preset) {
  SensorSpec sensor;
  sensor.preset = preset;
  if (preset == SensorPreset::kIdeal) {
    // A sharp lens without stray light on a linear sensor of round figures. Lamps of brightness 1
    // and the default exposure show a hall in middle grey.
    sensor.gain_db = 0;
    sensor.sensitivity_e_per_ms = 320000;
    sensor.full_well_e = 10000;
    sensor.black_level = 2;
    sensor.tone = ToneSpec::kLinear;
    sensor.blur_px = 0.38;
    sensor.field_blur_px = 0;
    sensor.glare = 0;
  }
  return sensor;
}

}  // namespace aisle::sim
