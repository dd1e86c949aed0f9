#pragma once

#include <filesystem>
#include <memory>

#include "harness/contract/estimator.h"

namespace aisle {

/// How the SLAM itself keeps moving objects out of its features.
enum class Rejection { kNone, kPaper, kRobust };

struct StereoSlamEstimatorOptions {
  int threads = 0;  ///< 0: as many as the machine has; never changes a result
  Rejection rejection = Rejection::kNone;
  std::filesystem::path vocabulary_file = {};  ///< empty: loops are not closed
  std::filesystem::path load_map = {};         ///< empty: a new map; else goes on in this one
  bool localise_only = false;                  ///< load_map stays as it is
  bool free_running = false;  ///< not repeatable: background results are taken when ready
  bool draw_stages = false;   ///< estimates can draw how the movers were found; changes no result
};

/// Our SLAM behind the Estimator socket.
std::unique_ptr<Estimator> MakeStereoSlamEstimator(const StereoCalibration& calibration,
                                                   const StereoSlamEstimatorOptions& options);

}  // namespace aisle
