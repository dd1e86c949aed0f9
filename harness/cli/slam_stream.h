#pragma once

#include <functional>
#include <memory>

#include "harness/contract/estimator.h"

namespace aisle {

/// Makes the system once the calibration is known.
using MakeEstimatorFor = std::function<std::unique_ptr<Estimator>(const StereoCalibration&)>;

/// Called once the final track is told.
using FinishEstimator = std::function<void(Estimator*)>;

/// Answers the frames of a harness on stdin over stdout, until it says that this is the end; see
/// reports/docs/stream.md. Nothing else goes to stdout meanwhile: what is printed goes to stderr.
/// Throws InputError for a stream that is none. The number of frames answered.
std::size_t AnswerStream(const std::string& name, const MakeEstimatorFor& make,
                         const FinishEstimator& finish);

}  // namespace aisle
