#include "harness/cli/external.h"

#include <thread>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/run/external_result.h"
#include "harness/suite/process.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::string ShellQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Written last: a dataset without it is not whole.
fs::path DoneMark(const fs::path& dataset) { return dataset / "complete"; }

void Export(const Sequence& sequence, const ExternalRun& run, const ExportOptions& options) {
  if (fs::exists(DoneMark(run.dataset))) return;
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  DatasetWriter writer(run.dataset, sequence.calibration(), sequence.rate_hz(), options);
  for (std::size_t i = 0; i < schedule.size(); ++i) {
    if (!writer.Has(schedule[i])) writer.Add(sequence.At(schedule[i]));
    fmt::print("@progress {} {}\n", i + 1, 2 * schedule.size());
    std::fflush(stdout);
  }
  writer.Finish(schedule, run.open_path());
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

Trajectory ReadEstimate(const ExternalSystem& system, const ExternalRun& run,
                        const ExportOptions& options, const Trajectory& truth) {
  const TrajectoryFormat format = TrajectoryFormatFromName(system.trajectory);
  Trajectory estimate = ReadTrajectory(run.output, format);
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
  fs::create_directories(run.output.parent_path());
  fs::remove(run.output);
  const std::string command =
      FillIn(system.command,
             {{"dataset", fs::absolute(run.dataset).string()},
              {"calibration", fs::absolute(CalibrationPath(run.dataset, options.format)).string()},
              {"output", fs::absolute(run.output).string()},
              {"seed", std::to_string(run.seed)}});
  const ProcessLimits limits{.wall_s = system.timeout_s};
  const ProcessResult ended = RunToEnd(command, limits);
  WriteFileAtomically(run.log, command + "\n" + ended.log);

  RunResult result;
  if (ended.end == ProcessResult::End::kTimeout || ended.end == ProcessResult::End::kMemory) {
    result = Failure(truth, RunStatus::kTimeout, Describe(ended, limits));
  } else if (ended.end == ProcessResult::End::kSignalled || ended.code != 0) {
    result = Failure(truth, RunStatus::kCrashed, Describe(ended, limits));
  } else if (!fs::exists(run.output)) {
    result = Failure(truth, RunStatus::kInvalid, "left no trajectory at {output}");
  } else {
    try {
      result = ResultFromTrajectory(truth, ReadEstimate(system, run, options, truth));
    } catch (const InputError& error) {
      result = Failure(truth, RunStatus::kInvalid, error.what());
    }
  }
  result.wall_s = ended.wall_s;
  result.peak_rss_mib = ended.peak_rss_mib;
  return result;
}

}  // namespace aisle
