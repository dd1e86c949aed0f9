#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/progress.h"

namespace aisle {

struct ProcessLimits {
  double wall_s = 3600;  ///< then the whole process group is killed
  /// Resident, of the process and all below it, watched: address space would hit sanitizers. Pages
  /// that they share count once.
  double memory_mib = 8192;
  std::size_t log_bytes = 65536;  ///< of its output, the last so many are kept
};

struct ProcessResult {
  enum class End { kExited, kSignalled, kTimeout, kMemory };
  End end = End::kExited;
  int code = 0;  ///< exit code, or the signal's number
  double wall_s = 0;
  double peak_rss_mib = 0;  ///< as watched, and as the limit counts; 0 where it ended at once
  std::string log;          ///< tail of stdout and stderr
};

/// How a program of others is started: with nothing of ours but these.
struct Confinement {
  std::vector<std::string> environment;  ///< "NAME=VALUE" each
  int ruleset = -1;                      ///< of a Sandbox; -1: none
  /// Whether it gets a /dev/shm of its own, and what a Sandbox allows it there.
  bool own_shared_memory = false;
  std::uint64_t shared_memory_access = 0;
};

/// "exit code 3", "exit code 139: signal 11, SIGSEGV (Segmentation fault), as a shell tells it",
/// "signal 11, SIGSEGV (Segmentation fault)", "no end after 600 s: killed", …
std::string Describe(const ProcessResult& result, const ProcessLimits& limits);

/// The last lines of an output, at most `count`, each made harmless and cut at a screen's width.
std::string LastWords(const std::string& log, std::size_t count = 12);

/// The line of an output that says most about its end: the last one that speaks of an error, else
/// the last one. Made harmless; empty where nothing was said.
std::string TellingLine(const std::string& log);

/// Ends of pipes that a child talks by instead of being silent: the child's, the caller's to close
/// once it is started.
struct Talk {
  int input = -1;   ///< its stdin
  int output = -1;  ///< its stdout; what goes to stderr is its log
};

/// A child under a guard, in a session of its own: it and all it ever starts end with it, and with
/// its parent, however that ends. Whatever it does (crash, hang, flood its output, eat memory) ends
/// as a ProcessResult. Not thread-safe.
class Process {
 public:
  /// argv[0] is a path. With our environment and rights where it is not confined. Throws
  /// MachineError when it cannot be started.
  Process(const std::vector<std::string>& argv, const ProcessLimits& limits,
          const std::optional<Confinement>& confinement = {}, const Talk& talk = {});
  ~Process();  ///< kills what is still running
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Looks after the child: reads its output, holds it to its limits. True once it has ended; call
  /// it some ten times a second.
  bool Poll();
  /// What its output told last, of frames alone where it is confined; such lines are not in its
  /// log.
  const Progress& progress() const { return progress_; }
  const ProcessResult& result() const { return result_; }

 private:
  void ReadOutput();
  void TakeLine(const std::string& line);
  void HoldToLimits();
  double MemoryMib();
  void KillTree();

  const ProcessLimits limits_;
  const bool foreign_;  ///< its stages are words to its user, not to us
  pid_t pid_ = -1;
  int output_ = -1;
  double started_s_ = 0;
  double counted_s_ = 0, shared_once_mib_ = 0;  ///< when its memory was last counted, and the count
  bool ended_ = false;
  bool killed_ = false;
  std::string partial_line_;
  Progress progress_;
  ProcessResult result_;
};

}  // namespace aisle
