#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/contract/external.h"
#include "harness/contract/mask_errors.h"
#include "harness/contract/run.h"
#include "harness/judge/limit.h"

namespace aisle {

struct SuiteScene {
  std::string name;  ///< "paper/scene2": the path below the scenes folder, without its ending
  std::string file;
};

/// A question asked of several systems on several scenes.
struct Suite {
  std::string name;
  std::string question;
  std::vector<SuiteScene> scenes;
  std::vector<std::string> systems;
  std::map<std::string, ExternalSystem> externals;   ///< those of `systems` that are commands
  std::map<std::string, ImperfectSystem> imperfect;  ///< those that are handed spoilt masks
  std::vector<std::string> twins = {"live"};
  /// Nine show a shift of two standard deviations in 97 nights of 100; three never can.
  std::vector<std::uint64_t> seeds = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<Limit> limits;
};

/// What a suite may name.
struct Vocabulary {
  std::vector<std::string> systems;
  std::vector<std::string> twins;
};

/// Reads a suite file:
///
///   suite: quickstart
///   question: Does a person who fills the image spoil the pose?   # or the opening comment
///   scenes: [../paper/scene2.yaml]
///   systems: [orbslam2, oracle]
///   twins: [live]                # optional; empty, frozen and levels too: none, low, mid, high
///   seeds: 1                     # optional: a count, or a list; nine where absent
///   limits:                      # optional
///     - {score: ate_rmse_m, system: oracle, twin: live, max: 0.02}
///
/// A system may also be a command of your own:
///
///   systems:
///     - orbslam2
///     - name: mine
///       command: my_slam {dataset} {calibration} {output}
///       dataset: euroc             # or kitti
///       trajectory: tum            # or kitti, euroc: what it writes to {output}
///       timeout_s: 600
///     - name: wrapped              # a system that was wrapped for VSLAM-LAB, unchanged
///       contract: vslam-lab
///       command: vslamlab_orbslam3_stereo vocabulary:ORBvoc.txt settings_yaml:stereo.yaml
///
/// or one of ours that is told its masks, with the errors of an imperfect network:
///
///     - name: network
///       like: semantic             # or oracle
///       mask_errors: {boundary_px: 3, miss_below_px: 600, miss_share: 0.05, latency_frames: 2}
///
/// Scenes are sought from the suite's folder, then from the scenes folder that holds it; ".yaml"
/// may be left out. Throws InputError with file:line:column, what was expected and an example.
Suite LoadSuite(const std::string& file, const Vocabulary& vocabulary);

/// True where the file's top level has the key `suite`; false for a scene. Throws InputError.
bool IsSuiteFile(const std::string& file);

/// The name under which reports list a scene file.
std::string SceneName(const std::string& scene_file);

/// Every cell of the suite: scenes, then twins, then seeds, then systems; runs that share their
/// frames are neighbours.
std::vector<RunSpec> Plan(const Suite& suite);

}  // namespace aisle
