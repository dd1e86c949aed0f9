#pragma once

#include <filesystem>
#include <optional>

#include "harness/bag/drive_bag.h"
#include "harness/contract/drive_log.h"
#include "harness/run/drive.h"
#include "harness/score/scorecard.h"

namespace aisle {

/// What one run says, as a bag beside its record: the system's poses, states, masks and events. In
/// a closed drive the frames too, which are that run's alone; else the frames come once for all
/// systems, when the campaign is over (WriteBags).
class RunBag {
 public:
  /// `epoch_ns` as DriveBagOptions has it.
  RunBag(const std::filesystem::path& file, const std::string& system,
         const StereoCalibration& calibration, std::int64_t epoch_ns, bool with_frames);

  void See(const DrivenFrame& frame);
  /// Closes the bag; `drive` may be null. Its contacts become events.
  void Finish(const RunResult& result, const RunScore& score, const DriveLog* drive);

 private:
  const std::filesystem::path file_;
  const std::string system_;
  const bool with_frames_;
  DriveBag bag_;
};

/// Where a run's bag lies: drive.mcap with its frames, estimate.mcap without.
std::filesystem::path RunBagName(bool with_frames);

/// Scores as a bag's metadata: name to value and unit.
std::map<std::string, std::string> ScoresAsMetadata(const Scorecard& scores);

}  // namespace aisle
