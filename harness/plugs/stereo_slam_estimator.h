#pragma once

#include <memory>

#include "harness/contract/estimator.h"

namespace aisle {

struct StereoSlamEstimatorOptions {
  int threads = 0;  ///< 0: as many as the machine has; never changes a result
};

/// Our SLAM behind the Estimator socket.
std::unique_ptr<Estimator> MakeStereoSlamEstimator(const StereoCalibration& calibration,
                                                   const StereoSlamEstimatorOptions& options);

}  // namespace aisle
