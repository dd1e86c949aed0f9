#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"
#include "harness/contract/score.h"

namespace aisle {

/// One cell of a suite: which system on which version of which scene.
struct RunSpec {
  std::string scene;       ///< name, e.g. "paper/scene2"
  std::string scene_file;  ///< path
  std::string twin = "live";
  std::string system;
  std::uint64_t seed = 1;
};

enum class RunStatus { kOk, kLost, kCrashed, kTimeout, kInvalid };

/// Truth of one frame as the scores need it (images live only while the frame is driven).
struct FrameFacts {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();  ///< truth
  double movers_share = 0;                                        ///< dynamic pixels / pixels
  double actors_share = 0;     ///< person and vehicle pixels / pixels
  int features_on_movers = 0;  ///< keypoints on dynamic pixels
  int inliers_on_movers = 0;   ///< of them, used in the pose
  double render_ms = 0;
};

/// All that one run left behind.
struct RunResult {
  RunSpec spec;
  RunStatus status = RunStatus::kOk;
  std::string status_why;
  std::vector<FrameFacts> facts;         ///< one per frame of the sequence
  std::vector<FrameEstimate> estimates;  ///< one per frame, masks and keypoints dropped
  Trajectory truth;                      ///< one per frame
  TrajectoryEstimate trajectory;
  double wall_s = 0;
  double peak_rss_mib = 0;
  std::uint64_t scene_hash = 0;
  int threads = 0;
};

}  // namespace aisle
