#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/contract/estimator.h"
#include "harness/contract/external.h"

namespace aisle {

struct StreamRun {
  std::filesystem::path folder;               ///< the run's own; the system works below it
  std::vector<std::filesystem::path> hidden;  ///< what the system must not see
  std::uint64_t seed = 1;
  double rate_hz = 20;       ///< of the camera
  double memory_mib = 8192;  ///< of its processes together
  /// Longest time for one answer, and for the end after the last; the system's own `timeout_s`
  /// where that is shorter.
  double answer_s = 60;
};

/// A foreign system behind the Estimator socket: a command that is shown frames on its stdin and
/// answers on its stdout (harness/io/stream_protocol.h), confined as those that read datasets are.
/// Whatever it does ends as a SystemFault of its own: kCrashed where it died or ended in an error,
/// after its final track as before it, kTimeout where it hung, kInvalid where it said what cannot
/// be.
class StreamEstimator : public Estimator {
 public:
  /// Starts the command and greets it. Throws SystemFault.
  StreamEstimator(const ExternalSystem& system, const StereoCalibration& calibration,
                  const StreamRun& run);
  ~StreamEstimator() override;

  FrameEstimate Process(const StereoFrame& frame, const ExternalMask& mask) override;
  Trajectory Finish() override;

  const std::string& version() const;  ///< what it calls itself
  /// What it wrote to stderr so far; written as system.log into the run's folder at the end.
  std::string log() const;
  double peak_rss_mib() const;  ///< of its processes, so far

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace aisle
