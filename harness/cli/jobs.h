#pragma once

#include <filesystem>
#include <vector>

#include "harness/suite/schedule.h"
#include "harness/suite/suite.h"

namespace aisle {

/// Content hashes of all that decides a run, hexadecimal: this program, the assets, the scene file,
/// twin and seed, and the system with the command it may be. Two runs of equal hash give equal
/// bits; a finished run of another hash is no answer to tonight's question.
class Fingerprints {
 public:
  Fingerprints();
  /// Of the frames alone: shared by all systems.
  std::string Frames(const RunSpec& spec) const;
  std::string Run(const RunSpec& spec, const Suite& suite) const;

 private:
  std::uint64_t program_;
};

struct JobOptions {
  std::filesystem::path out;  ///< the report's folder
  int threads = 0;            ///< per run; 0: all
  bool frame_cache = true;
  bool video = true;           ///< where there is an ffmpeg
  bool debug_dynamic = false;  ///< draw how each system found what moves
};

/// The processes that will make the runs.
std::vector<Job> MakeJobs(const Suite& suite, const std::vector<RunSpec>& specs,
                          const Fingerprints& fingerprints, const JobOptions& options);

}  // namespace aisle
