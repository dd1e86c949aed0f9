#include "harness/campaign/external_run.h"

#include <thread>

#include "harness/campaign/process.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/vslam_lab.h"
#include "harness/run/external_result.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr double kMinCoverage = 0.5;  ///< below this share of frames with a pose a run is lost

std::string ShellQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Written last: a dataset without it is not whole.
fs::path DoneMark(const fs::path& dataset) { return dataset / "complete"; }

void Export(const Sequence& sequence, const ExternalRun& run, const ExportOptions& options) {
  if (fs::exists(DoneMark(run.dataset))) {
    std::error_code error;
    fs::last_write_time(run.dataset, fs::file_time_type::clock::now(), error);  // in use
    return;
  }
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  DatasetWriter writer(run.dataset, sequence.calibration(), sequence.rate_hz(), schedule, options);
  for (std::size_t i = 0; i < schedule.size(); ++i) {
    if (!writer.Has(schedule[i])) writer.Add(sequence.At(schedule[i]));
    fmt::print("@progress {} {}\n", i + 1, 2 * schedule.size());
    std::fflush(stdout);
  }
  writer.Finish(run.open_path());
  if (options.format == DatasetFormat::kEuroc) {
    WriteVslamLabFiles(run.dataset, sequence.calibration(), sequence.rate_hz(), schedule,
                       options.epoch_ns);
  }
  WriteFileAtomically(DoneMark(run.dataset), "");
}

ProcessResult RunToEnd(const std::string& command, const ProcessLimits& limits) {
  Process process({"/bin/sh", "-c", command}, limits);
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return process.result();
}

/// Poses of the planned path; KITTI knows no time but the frame's number, relative to the first.
Trajectory Truth(const std::vector<FrameRequest>& schedule) {
  Trajectory truth;
  for (const FrameRequest& request : schedule) {
    truth.push_back({request.stamp_ns, request.T_world_rig});
  }
  return truth;
}

VslamLabRun LabRun(const ExternalRun& run) {
  return {.dataset = run.dataset, .output = run.output.parent_path() / "vslam_lab"};
}

/// Where the trajectory must stand when the command has ended.
fs::path TrajectoryPath(const ExternalSystem& system, const ExternalRun& run) {
  return system.vslam_lab ? VslamLabTrajectoryPath(LabRun(run)) : run.output;
}

std::string CommandLine(const ExternalSystem& system, const ExternalRun& run,
                        DatasetFormat format) {
  const std::string command = FillIn(
      system.command, {{"dataset", fs::absolute(run.dataset).string()},
                       {"calibration", fs::absolute(CalibrationPath(run.dataset, format)).string()},
                       {"output", fs::absolute(run.output).string()},
                       {"seed", std::to_string(run.seed)}});
  return system.vslam_lab ? command + " " + VslamLabArguments(LabRun(run)) : command;
}

Trajectory ReadEstimate(const ExternalSystem& system, const ExternalRun& run,
                        const ExportOptions& options, const Trajectory& truth) {
  const TrajectoryFormat format = TrajectoryFormatFromName(system.trajectory);
  Trajectory estimate = system.vslam_lab
                            ? ReadVslamLabTrajectory(VslamLabTrajectoryPath(LabRun(run)))
                            : ReadTrajectory(run.output, format);
  if (format == TrajectoryFormat::kKitti) {
    if (estimate.size() != truth.size()) {
      throw InputError(run.output.string(), 0,
                       fmt::format("{} poses for {} frames: KITTI's format has no stamps to tell "
                                   "which are missing",
                                   estimate.size(), truth.size()));
    }
    for (std::size_t i = 0; i < truth.size(); ++i) estimate[i].stamp_ns = truth[i].stamp_ns;
  } else if (options.format == DatasetFormat::kEuroc) {
    for (StampedPose& pose : estimate) pose.stamp_ns -= options.epoch_ns;
  }
  return estimate;
}

RunResult Failure(const Trajectory& truth, RunStatus status, const std::string& why) {
  RunResult result = ResultFromTrajectory(truth, {});
  result.status = status;
  result.status_why = why;
  return result;
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
      filled += ShellQuoted(value->second);
      at = end + 1;
    }
  }
  return filled;
}

RunResult RunExternal(const ExternalSystem& system, const Sequence& sequence,
                      const ExternalRun& run) {
  const ExportOptions options{.format = DatasetFormatFromName(system.dataset)};
  Export(sequence, run, options);
  const Trajectory truth = Truth(sequence.Schedule());
  const fs::path left_there = TrajectoryPath(system, run);
  fs::create_directories(left_there.parent_path());
  fs::remove(left_there);
  const std::string command = CommandLine(system, run, options.format);
  const ProcessLimits limits{.wall_s = system.timeout_s};
  const ProcessResult ended = RunToEnd(command, limits);
  WriteFileAtomically(run.log, command + "\n" + ended.log);

  RunResult result;
  if (ended.end == ProcessResult::End::kTimeout || ended.end == ProcessResult::End::kMemory) {
    result = Failure(truth, RunStatus::kTimeout, Describe(ended, limits));
  } else if (ended.end == ProcessResult::End::kSignalled || ended.code != 0) {
    result = Failure(truth, RunStatus::kCrashed, Describe(ended, limits));
  } else if (!fs::exists(left_there)) {
    result = Failure(truth, RunStatus::kInvalid,
                     "left no trajectory at " + (system.vslam_lab ? left_there.filename().string()
                                                                  : std::string("{output}")));
  } else {
    try {
      const double min_coverage = system.vslam_lab ? 0 : kMinCoverage;
      result = ResultFromTrajectory(truth, ReadEstimate(system, run, options, truth), min_coverage);
    } catch (const InputError& error) {
      result = Failure(truth, RunStatus::kInvalid, error.what());
    }
  }
  result.wall_s = ended.wall_s;
  result.peak_rss_mib = ended.peak_rss_mib;
  return result;
}

}  // namespace aisle
