#pragma once

#include <filesystem>

#include "harness/record/results.h"

namespace aisle {

struct NightOptions {
  std::size_t scenes = 2;
  std::size_t seeds = 1;
  std::size_t frames = 300;
  std::vector<std::string> systems = {"orbslam2", "oracle"};
  bool pictures = false;  ///< four small ones a run
};

/// A run along an aisle in which a mover pushes the estimate aside for a while.
RunResult MakeRun(const std::string& scene, const std::string& system, std::uint64_t seed,
                  double push_m, std::size_t frames = 300);

/// Frames as a run leaves them, small and grey, named in the record.
void AddPictures(const std::filesystem::path& folder, RunRecord* record);

/// A whole night of such runs, written below the folder as `run` writes them. Nothing is judged.
Results MakeNight(const NightOptions& options, const std::filesystem::path& folder);

}  // namespace aisle
