#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/bench/source.h"
#include "harness/contract/run.h"
#include "harness/contract/system_spec.h"
#include "harness/score/masks.h"

namespace aisle {

/// The frames of one stretch with their truth, held in memory: what many variants are tried on.
/// The first is shown and not counted: a detector needs a past.
struct Clip {
  std::string name;   ///< as it was asked for
  std::string scene;  ///< its name; of a recording the folder
  StereoCalibration calibration;
  std::vector<SequenceFrame> frames;
};

/// Frames from the one before the view's first on. Throws InputError, also for a view whose frames
/// have no truth of what moves.
Clip LoadClip(const BenchView& view, const BenchSource& source, const BenchProgress& progress = {});

/// What a detector rejected on some clips, beside what moved.
struct DetectorOutcome {
  int frames = 0;
  double pixels = 0;                       ///< of all frames
  MaskFacts masks;                         ///< summed
  ObjectCount large, large_across;         ///< movers asked for (IsLargeMover), and found
  std::map<std::string, double> stage_ms;  ///< sums
  /// Large movers by the step at which they were lost, "found" among them; empty unless asked for.
  /// Along the optical axis, and at 30 degrees or more to it.
  std::map<std::string, int> losses_along, losses_across;

  DetectorOutcome& operator+=(const DetectorOutcome& more);

  double object_f1() const;     ///< of objects by rectangle; 0 where none was found
  double pixel_iou() const;     ///< 0 where nothing moved and nothing was rejected
  double static_wrong() const;  ///< share of the pixels at rest that were rejected
  double mean_ms() const;       ///< of the whole detector, a frame
};

/// Whether a mover goes across the optical axis: at 30 degrees to it or more. What goes along it
/// stays near its epipolar lines while the rig drives straight on.
bool GoesAcross(const FrameTruth& truth, int instance);

/// A system's detector alone over one clip. Same bits, times apart, for any number of threads.
/// Throws InputError.
DetectorOutcome MeasureDetector(const Clip& clip, const SystemSpec& system,
                                bool find_losses = false);

}  // namespace aisle
