#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/contract/run.h"

namespace aisle {

/// All that a process needs to make one run. It is written as job.json into the run's folder and is
/// the only thing that the process reads; fingerprint, resume and rerun come from it as well.
struct Job {
  RunSpec spec;
  std::filesystem::path out;  ///< the report's folder
  /// Where rendered frames are shared; empty: none are kept, as of a scene that is steered through.
  std::filesystem::path frames;
  /// Where pictures are shared that a vehicle is led past, not steered; empty: none are kept.
  std::filesystem::path led_frames = {};
  /// Where what the system was taught by being led is shared with its other drives through the
  /// scene; empty: it is kept nowhere.
  std::filesystem::path teaching = {};
  std::filesystem::path dataset;  ///< what is exported for a foreign system; empty: it is ours
  /// Jobs with the same frames. The first makes them, the others start when it has ended, where any
  /// of it is kept.
  std::string frames_key;
  std::string inputs_hash;     ///< of all that decides the run; filed with its result
  int threads = 0;             ///< 0: all; never changes a result
  bool video = true;           ///< where there is an ffmpeg
  bool debug_dynamic = false;  ///< draw how the system found what moves; changes no result
  bool mcap = false;           ///< leave a bag of what the system said; changes no result
  double memory_mib = 8192;    ///< of a foreign system's processes together
  std::string frames_in_report = "worst";  ///< or all, none: whose pictures are kept
  /// Folders besides `out` that guests must not see: of a cluster's task the report that the run is
  /// copied into, and the node's scratch with its first attempt and its neighbours' runs.
  std::vector<std::filesystem::path> hidden = {};
};

std::string ToJson(const Job& job);
/// Throws InputError when the text is no job.
Job JobFromJson(const std::string& text, const std::string& file);

/// Where a run's job.json stands in a report's folder.
std::filesystem::path JobPath(const std::filesystem::path& out, const RunSpec& spec);
void WriteJob(const Job& job);
Job ReadJob(const std::filesystem::path& file);

/// Content hashes of all that decides a run, hexadecimal: this program, the assets, what
/// can be seen of the scene's twin, the seed, and the system with its options or its command, the
/// files that names and the variables it is given. Two runs of equal hash give equal bits; a
/// finished run of another hash is no answer to tonight's question. Of the program, frames know
/// what renders them alone.
class Fingerprints {
 public:
  Fingerprints();
  /// Of the frames alone: shared by all systems, and by scenes that look the same in this twin.
  std::string Frames(const RunSpec& spec) const;
  std::string Run(const RunSpec& spec) const;
  /// Of what a system is taught by being led through the scene: however it steers afterwards, with
  /// whomever in its way.
  std::string Teaching(const RunSpec& spec) const;

 private:
  std::uint64_t renderer_;
  std::uint64_t program_;
  mutable std::map<std::string, std::uint64_t> systems_;  ///< by name: their files may be large
  /// By file and twin: a recording may have many files.
  mutable std::map<std::pair<std::string, std::string>, std::uint64_t> sources_;
};

/// Where frames are kept, by their key.
std::filesystem::path FramesFolder(const std::string& key);

struct JobOptions {
  std::filesystem::path out;
  int threads = 0;
  bool frame_cache = true;
  bool video = true;
  bool debug_dynamic = false;
  bool mcap = false;
  double memory_mib = 8192;
  std::string frames_in_report = "worst";
};

/// The jobs that make the runs. Throws InputError where they shall leave bags in which systems
/// would share topics (RequireOwnTopics).
std::vector<Job> MakeJobs(const std::vector<RunSpec>& specs, const Fingerprints& fingerprints,
                          const JobOptions& options);

}  // namespace aisle
