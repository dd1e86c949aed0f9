#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/contract/estimator.h"
#include "harness/contract/sequence.h"

namespace aisle {

struct ConformanceOptions {
  std::size_t frames = 40;  ///< of the sequence, from its first on
  /// Hold it to equal bits as well: over two drives, beside another instance, and when the caller
  /// writes to its images after Process has returned.
  bool repeatable = true;
};

/// Holds an estimator to what harness/contract/estimator.h asks of it. Each broken rule comes back
/// as a sentence with the frame where it first showed; empty: it conforms.
///
///   TEST(MySlam, Conforms) {
///     EXPECT_THAT(CheckEstimator([] { return std::make_unique<MySlam>(); }, *sequence),
///     IsEmpty());
///   }
///
/// Drives four instances through the frames, so take a short sequence that the system can track.
std::vector<std::string> CheckEstimator(const std::function<std::unique_ptr<Estimator>()>& make,
                                        const Sequence& sequence,
                                        const ConformanceOptions& options = {});

}  // namespace aisle
