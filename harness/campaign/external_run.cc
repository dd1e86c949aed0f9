#include "harness/campaign/external_run.h"

#include <thread>

#include "harness/campaign/folder_modes.h"
#include "harness/campaign/guest_dataset.h"
#include "harness/campaign/guest_output.h"
#include "harness/campaign/guest_rooms.h"
#include "harness/campaign/process.h"
#include "harness/campaign/sandbox.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/odometry_files.h"
#include "harness/io/shell_word.h"
#include "harness/io/vslam_lab.h"
#include "harness/run/external_result.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

ProcessResult RunToEnd(const std::string& command, const ProcessLimits& limits,
                       const ExternalSystem& system, const ExternalRun& run,
                       const GuestRooms& rooms) {
  const Sandbox sandbox(RulesOf(system, rooms, run.hidden));
  const FolderModes ours({run.folder});  // put back at the latest once the process below is gone
  Process process({"/bin/sh", "-c", command}, limits, ConfinementOf(system, rooms, sandbox));
  const auto begun = std::chrono::steady_clock::now();
  double told_s = 0;
  while (!process.Poll()) {
    ours.PutBack();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begun;
    if (!run.progress || since.count() < told_s + 1) continue;
    told_s = since.count();
    run.progress(told_s, process.progress().done, process.progress().total);
  }
  return process.result();
}

/// The first line that the system's own command for it prints; a note where it fails.
std::string VersionOf(const ExternalSystem& system, const ExternalRun& run, const GuestRooms& rooms,
                      std::vector<std::string>* notes) {
  if (system.version.empty()) return "";
  ExternalRun quiet = run;
  quiet.progress = {};
  const ProcessLimits limits{.wall_s = 30};
  const ProcessResult said = RunToEnd(system.version, limits, system, quiet, rooms);
  const bool good = said.end == ProcessResult::End::kExited && said.code == 0;
  if (!good) notes->push_back("its version is unknown: " + Describe(said, limits));
  return good ? Printable(said.log.substr(0, said.log.find('\n')), 120) : "";
}

/// How the dataset calls its frames: by stamps on its own clock.
std::vector<std::string> StampNames(const Trajectory& truth, const ExportOptions& options) {
  std::vector<std::string> names;
  for (const StampedPose& pose : truth) {
    const bool euroc = options.format == DatasetFormat::kEuroc;
    names.push_back(std::to_string(pose.stamp_ns + (euroc ? options.epoch_ns : 0)));
  }
  return names;
}

/// Poses of the planned path; KITTI knows no time but the frame's number, relative to the first.
Trajectory Truth(const std::vector<FrameRequest>& schedule) {
  Trajectory truth;
  for (const FrameRequest& request : schedule) {
    truth.push_back({request.stamp_ns, request.T_world_rig});
  }
  return truth;
}

/// What the trajectory is called that the command must leave.
const char* TrajectoryName(const ExternalSystem& system) {
  return system.vslam_lab != VslamLabStyle::kNone ? kVslamLabTrajectory : "output.txt";
}

std::string CommandLine(const ExternalSystem& system, const ExternalRun& run,
                        const GuestRooms& rooms, DatasetFormat format) {
  const std::string command =
      FillIn(system.command, {{"dataset", rooms.dataset.string()},
                              {"calibration", CalibrationPath(rooms.dataset, format).string()},
                              {"output", (rooms.output / TrajectoryName(system)).string()},
                              {"seed", std::to_string(run.seed)},
                              {"source", system.repository}});
  if (system.vslam_lab == VslamLabStyle::kNone) return command;
  return command + " " +
         VslamLabArguments({.dataset = rooms.dataset, .output = rooms.output}, system.vslam_lab);
}

/// Stamps of the frames that the rows of a KITTI file are about. Without numbers before the poses
/// there must be a row for each frame.
void StampByFrame(const Trajectory& truth, const fs::path& file, Trajectory* estimate) {
  const auto last = static_cast<std::size_t>(estimate->back().stamp_ns / kKittiStepNs);
  if (last >= truth.size() || (estimate->size() != truth.size() && last + 1 == estimate->size())) {
    throw InputError(
        file.string(), 0,
        fmt::format(
            "{} poses for {} frames: KITTI's format has no timestamps to show which are missing",
            estimate->size(), truth.size()));
  }
  for (StampedPose& pose : *estimate) {
    pose.stamp_ns = truth[static_cast<std::size_t>(pose.stamp_ns / kKittiStepNs)].stamp_ns;
  }
}

/// By how much the stamps of the dataset are later than ours.
std::int64_t EpochOf(const ExportOptions& options) {
  return options.format == DatasetFormat::kEuroc ? options.epoch_ns : 0;
}

/// Reads what the system left, once it lies among our own files.
Trajectory ReadEstimate(const ExternalSystem& system, const fs::path& file,
                        const ExportOptions& options, const Trajectory& truth) {
  const TrajectoryFormat format = TrajectoryFormatFromName(system.trajectory);
  Trajectory estimate = system.vslam_lab != VslamLabStyle::kNone ? ReadVslamLabTrajectory(file)
                                                                 : ReadTrajectory(file, format);
  if (format == TrajectoryFormat::kKitti) {
    StampByFrame(truth, file, &estimate);
  } else {
    for (StampedPose& pose : estimate) pose.stamp_ns -= EpochOf(options);
  }
  return estimate;
}

RunResult Failure(const Trajectory& truth, RunStatus status, const std::string& why) {
  RunResult result = ResultFromTrajectory(truth, {});
  result.status = status;
  result.status_why = why;
  return result;
}

/// What became of a command that ended well: its trajectory, or why there is none.
RunResult Judge(const ExternalSystem& system, const ExternalRun& run, const GuestRooms& rooms,
                const ExportOptions& options, const Trajectory& truth) {
  constexpr std::size_t kLargestTrajectory = std::size_t{128} << 20;
  const std::string name = TrajectoryName(system);
  const bool lab = system.vslam_lab != VslamLabStyle::kNone;
  std::error_code error;
  if (fs::symlink_status(rooms.output / name, error).type() == fs::file_type::not_found) {
    return Failure(truth, RunStatus::kInvalid,
                   "left no trajectory at " + (lab ? name : std::string("{output}")));
  }
  try {
    WriteFileAtomically(run.folder / name, ReadLeftFile(rooms.output, name, kLargestTrajectory));
    const double min_coverage = lab ? 0 : kMinCoverage;
    return ResultFromTrajectory(truth, ReadEstimate(system, run.folder / name, options, truth),
                                min_coverage, EpochOf(options));
  } catch (const InputError& wrong) {
    return Failure(truth, RunStatus::kInvalid, wrong.what());
  }
}

}  // namespace

std::string FillIn(const std::string& command, const std::map<std::string, std::string>& values) {
  std::string filled;
  for (std::size_t at = 0; at < command.size();) {
    const std::size_t end = command[at] == '{' ? command.find('}', at) : std::string::npos;
    const auto value =
        end == std::string::npos ? values.end() : values.find(command.substr(at + 1, end - at - 1));
    if (value == values.end()) {
      filled += command[at++];
    } else {
      filled += ShellWord(value->second);
      at = end + 1;
    }
  }
  return filled;
}

RunResult RunExternal(const ExternalSystem& system, const Sequence& sequence,
                      const ExternalRun& run) {
  const ExportOptions options{.format = DatasetFormatFromName(system.dataset),
                              .true_trajectory = false};
  const GuestRooms rooms(run.folder / kGuestFolder);
  LayOutDataset(sequence, {.kept = run.dataset, .options = options, .open_path = run.open_path},
                rooms.dataset);
  if (run.odometry) {
    WriteOdometry(rooms.dataset, JoinMotions(sequence.Schedule(), *run.odometry), options);
  }
  if (system.vslam_lab != VslamLabStyle::kNone) LinkVslamLabImages(rooms.dataset);
  const Trajectory truth = Truth(sequence.Schedule());
  const std::string command = CommandLine(system, run, rooms, options.format);
  std::vector<std::string> notes;
  const std::string version = VersionOf(system, run, rooms, &notes);
  const ProcessLimits limits{.wall_s = system.timeout_s, .memory_mib = run.memory_mib};
  const ProcessResult ended = RunToEnd(command, limits, system, run, rooms);
  WriteFileAtomically(run.folder / kSystemLogName,
                      fmt::format("# {}\n{}\n{}", DescribeSandbox(), command, ended.log));

  RunResult result;
  if (ended.end == ProcessResult::End::kTimeout || ended.end == ProcessResult::End::kMemory) {
    result = Failure(truth, RunStatus::kTimeout, Describe(ended, limits));
  } else if (ended.end == ProcessResult::End::kSignalled || ended.code != 0) {
    const std::string line = TellingLine(ended.log);
    result = Failure(truth, RunStatus::kCrashed,
                     Describe(ended, limits) + (line.empty() ? "" : "; last words: " + line));
  } else {
    result = Judge(system, run, rooms, options, truth);
    result.notes = TakeLeftovers(rooms.output, StampNames(truth, options), run.folder);
  }
  result.wall_s = ended.wall_s;
  result.peak_rss_mib = ended.peak_rss_mib;
  result.last_words = LastWords(ended.log);
  result.system_version = version;
  notes.insert(notes.end(), result.notes.begin(), result.notes.end());
  result.notes = notes;
  return result;
}

}  // namespace aisle
