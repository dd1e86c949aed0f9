#include "harness/campaign/stream_system.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <thread>

#include "harness/campaign/external_run.h"
#include "harness/campaign/folder_modes.h"
#include "harness/campaign/guest_output.h"
#include "harness/campaign/guest_rooms.h"
#include "harness/campaign/process.h"
#include "harness/campaign/sandbox.h"
#include "harness/common/stopwatch.h"
#include "harness/contract/map_id.h"
#include "harness/contract/system_fault.h"
#include "harness/io/descriptor.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/stream_protocol.h"

namespace aisle {
namespace {

struct PipeEnds {
  Descriptor read, write;
};
PipeEnds MakePipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw MachineError(fmt::format("cannot create a pipe: {}", std::strerror(errno)));
  }
  constexpr int kRoomBytes = 1 << 20;  // a frame fits
  ::fcntl(ends[1], F_SETPIPE_SZ, kRoomBytes);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

RunStatus StatusOf(StreamError::Kind kind) {
  switch (kind) {
    case StreamError::Kind::kTimeout:
      return RunStatus::kTimeout;
    case StreamError::Kind::kNonsense:
      return RunStatus::kInvalid;
    case StreamError::Kind::kClosed:
      break;
  }
  return RunStatus::kCrashed;
}

}  // namespace

struct StreamEstimator::Impl {
  Impl(const ExternalSystem& system, const StreamRun& stream_run)
      : run(stream_run), rooms(run.folder / kGuestFolder), ours({run.folder}) {
    // A system that died is told by its answer, not by a signal to us.
    ::signal(SIGPIPE, SIG_IGN);
    sandbox.emplace(RulesOf(system, rooms, run.hidden));
    command = FillIn(system.command, {{"seed", std::to_string(run.seed)},
                                      {"output", rooms.output.string()},
                                      {"source", system.repository}});
    PipeEnds in = MakePipe(), out = MakePipe();
    limits.wall_s = 1e9;  // each answer has a time of its own
    limits.memory_mib = run.memory_mib;
    process.emplace(std::vector<std::string>{"/bin/sh", "-c", command}, limits,
                    ConfinementOf(system, rooms, *sandbox), Talk{in.read.get(), out.write.get()});
    to_system = std::move(in.write);
    from_system = std::move(out.read);
    answer_s = std::min(run.answer_s, system.timeout_s);
    pipe.emplace(from_system.get(), to_system.get(), answer_s, [this] {
      process->Poll();
      ours.PutBack();
    });
  }

  ~Impl() {
    // Also of a system that never answered the greeting: then one wants to read it most.
    process->Poll();
    ours.PutBack();
    try {
      WriteFileAtomically(
          run.folder / kSystemLogName,
          fmt::format("# {}\n{}\n{}", DescribeSandbox(), command, process->result().log));
    } catch (const std::exception&) {
      // A log that cannot be written is no reason to lose the run.
    }
  }

  /// Asks; whoever has spoken before is out of turn, also if its answer would have fitted.
  void Ask(StreamType type, const std::string& payload) {
    if (pipe->HasUnread()) {
      throw StreamError(StreamError::Kind::kNonsense, "it sent data before the first frame");
    }
    pipe->Send(type, payload);
  }

  /// Why the process ended, once it has: its end comes a moment after its pipe's.
  std::string EndInWords() {
    for (int round = 0; round < 50 && !process->Poll(); ++round) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (!process->Poll()) return "closed its end of the stream but continues to run";
    return (EndedWell() ? "ended before it answered: " : "") + EndOfProcess();
  }

  bool EndedWell() const {
    const ProcessResult& result = process->result();
    return result.end == ProcessResult::End::kExited && result.code == 0;
  }

  std::string EndOfProcess() const {
    const ProcessResult& result = process->result();
    const std::string line = TellingLine(result.log);
    return Describe(result, limits) + (line.empty() ? "" : "; last words: " + line);
  }

  RunStatus StatusOfEnd() const {
    const bool for_memory = process->result().end == ProcessResult::End::kMemory;
    return for_memory ? RunStatus::kTimeout : RunStatus::kCrashed;
  }

  /// Waits for its end after its last answer: how a program ends says as much of it as that it
  /// answered. A sanitizer, say, tells what it found by the exit code.
  void AwaitEnd() {
    constexpr double kGrace_ms = 3000;  // a closed stdin may disturb one that is about to end
    const Stopwatch waited;
    while (!process->Poll()) {
      if (waited.ElapsedMs() > kGrace_ms) to_system.Close();  // one that reads on sees the end
      if (waited.ElapsedMs() > 1e3 * answer_s) {
        throw SystemFault(RunStatus::kTimeout,
                          fmt::format("did not exit within {:g} s of its final track", answer_s));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!EndedWell()) throw SystemFault(StatusOfEnd(), EndOfProcess());
  }

  [[noreturn]] void Blame(const StreamError& error) {
    if (error.kind != StreamError::Kind::kClosed) {
      throw SystemFault(StatusOf(error.kind), error.what());
    }
    const std::string words = EndInWords();
    throw SystemFault(StatusOfEnd(), words);
  }

  StreamMessage Answer() {
    std::optional<StreamMessage> message = pipe->Receive();
    if (!message) throw StreamError(StreamError::Kind::kClosed, "the stream is closed");
    return *std::move(message);
  }

  const StreamRun run;
  GuestRooms rooms;
  FolderModes ours;  ///< put back at the latest once the process is gone, which stands below
  std::optional<Sandbox> sandbox;
  std::string command, version;
  double answer_s = 0;  ///< longest time for one answer, and for the end after the last
  ProcessLimits limits;
  Descriptor to_system, from_system;
  std::optional<StreamPipe> pipe;
  std::optional<aisle::Process> process;
};

StreamEstimator::StreamEstimator(const ExternalSystem& system, const StereoCalibration& calibration,
                                 const StreamRun& run)
    : impl_(std::make_unique<Impl>(system, run)) {
  try {
    impl_->pipe->Send(StreamType::kHello,
                      FormatHello({.calibration = calibration, .rate_hz = run.rate_hz}));
    const StreamMessage answer = impl_->Answer();
    if (answer.type != StreamType::kHello) {
      throw StreamError(StreamError::Kind::kNonsense, "its first message is not a hello");
    }
    impl_->version = ReadName(answer.payload);
  } catch (const StreamError& error) {
    impl_->Blame(error);
  }
}

StreamEstimator::~StreamEstimator() = default;

FrameEstimate StreamEstimator::Process(const StereoFrame& frame, const ExternalMask&) {
  try {
    if (frame.motion) impl_->Ask(StreamType::kMotion, FormatMotion(frame.id, *frame.motion));
    impl_->Ask(StreamType::kFrame, FormatFrame(frame));
    const StreamAnswer answer = ReadAnswer(impl_->Answer(), frame.id);
    FrameEstimate estimate;
    estimate.id = frame.id;
    estimate.stamp_ns = frame.stamp_ns;
    estimate.state = answer.pose ? TrackingState::kTracking : TrackingState::kLost;
    estimate.T_world_rig = answer.pose;
    if (answer.map_id != 0) estimate.counts[kMapId] = answer.map_id;
    return estimate;
  } catch (const StreamError& error) {
    impl_->Blame(error);
  }
}

Trajectory StreamEstimator::Finish() {
  try {
    impl_->Ask(StreamType::kEnd, "");
    const StreamMessage answer = impl_->Answer();
    if (answer.type != StreamType::kTrack) {
      throw StreamError(StreamError::Kind::kNonsense, "its answer to the end is not a track");
    }
    Trajectory track = ReadTrack(answer.payload);
    impl_->AwaitEnd();
    return track;
  } catch (const StreamError& error) {
    impl_->Blame(error);
  }
}

const std::string& StreamEstimator::version() const { return impl_->version; }
double StreamEstimator::peak_rss_mib() const {
  impl_->process->Poll();
  return impl_->process->result().peak_rss_mib;
}
std::string StreamEstimator::log() const { return impl_->process->result().log; }

}  // namespace aisle
