#pragma once

#include <memory>

#include "harness/contract/estimator.h"

namespace aisle {

/// How the SLAM itself keeps moving objects out of its features.
enum class Rejection { kNone, kPaper, kRobust };

struct StereoSlamEstimatorOptions {
  int threads = 0;  ///< 0: as many as the machine has; never changes a result
  Rejection rejection = Rejection::kNone;
};

/// Our SLAM behind the Estimator socket.
std::unique_ptr<Estimator> MakeStereoSlamEstimator(const StereoCalibration& calibration,
                                                   const StereoSlamEstimatorOptions& options);

}  // namespace aisle
