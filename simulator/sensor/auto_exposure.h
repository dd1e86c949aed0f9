#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "simulator/sensor/tone.h"

namespace aisle::sim {

/// Exposure control in the manner of the MT9V034's own (AEC and AGC, with its weighted
/// tiles): it steers the mean grey of the light in the picture, or in its
/// lower part, by the exposure time first, and by the gain only when the time has reached its
/// limit.
struct AutoExposureOptions {
  bool on = false;
  float target_grey = 110;    ///< mean grey, 0 to 255, that it aims at, of the light alone
  float white_share = 0.08f;  ///< but at most this share of the picture may be white
  float meter_from = 0;       ///< rows above this share of the height, the sky, do not count
  double shortest_ms = 0.1;   ///< exposure time
  double longest_ms = 12;     ///< exposure time
  float highest_gain = 4;     ///< the sensor's analogue gain goes from 1 to 4 in steps of 1/16
  /// Stops between one product of time and gain and the next that it chooses, from `shortest_ms`
  /// on; 0: it chooses any. Controls that step leave pictures of one place that differ in
  /// brightness.
  double step_ev = 0;

  /// The first rule broken, with name, value and bound; empty if none is.
  std::string Validate() const;
};

struct ExposureSetting {
  double time_ms = 8;
  float gain = 1;
};

/// The setting under which `light` has the target mean, or a lower one where more than the allowed
/// share would be white. `light` is a coarse picture of the view
/// that is being taken (of which the rows from `meter_from` on are metered), radiance after the
/// lens's fall-off; `white_per_ms` the share of white that radiance 1 gives after 1 ms at gain 1,
/// `tone` the curve behind which the mean is taken. The mean is that of the light alone,
/// without the sensor's black level. That comes on top: the picture is brighter than the target, by
/// the black level behind a linear tone, and by up to four times as much, in the shadows, behind
/// the companded one. Values above white count as white, as they do in the picture, so a lamp in
/// view does not darken the hall. Pure: it remembers no earlier frame, so a frame alone has the
/// exposure that it has in a sequence; the control has no lag.
ExposureSetting ChooseExposure(const cv::Mat1f& light, double white_per_ms, Tone tone,
                               const AutoExposureOptions& options);

}  // namespace aisle::sim
