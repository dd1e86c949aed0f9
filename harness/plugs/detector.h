#pragma once

#include <map>
#include <memory>
#include <string>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"
#include "harness/contract/system_spec.h"

namespace aisle {

/// What one of our systems rejects by, alone: no map, no pose. Of `paper` that is all there is to
/// it, as it needs two frames and nothing else; `robust` lacks the prediction of the rig's motion
/// that tracking gives it. Frames of one sequence, in order. Same bits for any number of threads.
class Detector {
 public:
  virtual ~Detector() = default;

  struct Found {
    DynamicRegions regions;
    std::map<std::string, double> stage_ms;  ///< wall time, whole and by step
  };
  virtual Found Detect(const StereoFrame& frame) = 0;

  /// For every mover of the frame detected last that is large enough to be asked for, by its
  /// instance: the step at which the method lost it, given that it was not found. Empty where the
  /// method cannot tell, where truth names no instances, and unless stages were to be kept.
  virtual std::map<int, std::string> FindLosses(const FrameTruth& before,
                                                const FrameTruth& now) const = 0;
};

/// Throws InputError for a foreign system and for options that do not fit together.
std::unique_ptr<Detector> MakeDetector(const SystemSpec& spec, const StereoCalibration& calibration,
                                       bool keep_stages = false);

}  // namespace aisle
