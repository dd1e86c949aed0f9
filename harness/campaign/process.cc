#include "harness/campaign/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "harness/campaign/guard.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

double NowS() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double ResidentMib(pid_t pid) {
  std::ifstream statm(fmt::format("/proc/{}/statm", pid));
  double total_pages = 0, resident_pages = 0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

bool IsGuard(pid_t pid) {
  std::ifstream comm(fmt::format("/proc/{}/comm", pid));
  std::string name;
  std::getline(comm, name);
  return name == kGuardName;
}

std::vector<pid_t> ChildrenOf(pid_t pid) {
  std::vector<pid_t> children;
  std::error_code error;
  const std::string tasks = fmt::format("/proc/{}/task", pid);
  for (const auto& task : std::filesystem::directory_iterator(tasks, error)) {
    std::ifstream list(task.path() / "children");
    for (pid_t child = 0; list >> child;) children.push_back(child);
  }
  return children;
}

/// Resident memory, of pages that processes share this one's part alone. The kernel looks at every
/// page for it; resident memory where it does not tell.
double ProportionalMib(pid_t pid) {
  std::ifstream rollup(fmt::format("/proc/{}/smaps_rollup", pid));
  for (std::string word; rollup >> word;) {
    double kib = 0;
    if (word == "Pss:" && rollup >> kib) return kib / 1024;
  }
  return ResidentMib(pid);
}

/// Memory of a process and all below it, each measured so.
double TreeMib(pid_t pid, double (*measure)(pid_t)) {
  double sum_mib = IsGuard(pid) ? 0 : measure(pid);
  for (const pid_t child : ChildrenOf(pid)) sum_mib += TreeMib(child, measure);
  return sum_mib;
}

/// Some callers start programs with SIGCHLD ignored, and nobody who ignores it learns how a child
/// has ended. Children inherit what is set here.
void HearOfChildren() {
  struct sigaction now {};
  ::sigaction(SIGCHLD, nullptr, &now);
  if (now.sa_handler == SIG_IGN || (now.sa_flags & SA_NOCLDWAIT) != 0) ::signal(SIGCHLD, SIG_DFL);
}

constexpr int kUnknownEnd = -1;  ///< for a code where somebody else has waited for the child

/// As execve takes them, whose signature is older than const.
std::vector<char*> Pointers(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

std::string SignalName(int signal) {
  const char* name = ::sigabbrev_np(signal);
  return fmt::format("signal {}{} ({})", signal,
                     name == nullptr ? "" : fmt::format(", SIG{}", name), ::strsignal(signal));
}

/// Lines that are not empty, in their order.
std::vector<std::string> LinesOf(const std::string& log) {
  std::vector<std::string> lines;
  std::istringstream stream(log);
  for (std::string line; std::getline(stream, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
  }
  return lines;
}

}  // namespace

std::string LastWords(const std::string& log, std::size_t count) {
  constexpr std::size_t kWidth = 200;
  const std::vector<std::string> lines = LinesOf(log);
  std::string words;
  for (std::size_t i = lines.size() - std::min(count, lines.size()); i < lines.size(); ++i) {
    words += Printable(lines[i], kWidth) + "\n";
  }
  return words;
}

std::string TellingLine(const std::string& log) {
  constexpr std::size_t kWidth = 160;
  const std::vector<std::string> lines = LinesOf(log);
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    for (const char* word : {"ssert", "rror", "xception", "what():", "atal:", "erminate"}) {
      if (line->find(word) != std::string::npos) return Printable(*line, kWidth);
    }
  }
  return lines.empty() ? "" : Printable(lines.back(), kWidth);
}

std::string Describe(const ProcessResult& result, const ProcessLimits& limits) {
  switch (result.end) {
    case ProcessResult::End::kTimeout:
      return fmt::format("killed after {:g} s without an end", limits.wall_s);
    case ProcessResult::End::kMemory:
      return fmt::format("killed for using more than {:g} MiB of memory", limits.memory_mib);
    case ProcessResult::End::kSignalled:
      return SignalName(result.code);
    case ProcessResult::End::kExited:
      break;
  }
  if (result.code == kUnknownEnd) return "ended, but its exit code went to another wait";
  constexpr int kShellSays = 128;  // and adds the number of the signal that ended its command
  const int signal = result.code - kShellSays;
  if (signal > 0 && signal < SIGRTMIN && ::sigabbrev_np(signal) != nullptr) {
    return fmt::format("exit code {}: {}, as reported by the shell", result.code,
                       SignalName(signal));
  }
  return fmt::format("exit code {}", result.code);
}

Process::Process(const std::vector<std::string>& argv, const ProcessLimits& limits,
                 const std::optional<Confinement>& confinement, const Talk& talk)
    : limits_(limits), foreign_(confinement.has_value()) {
  const std::vector<char*> arguments = Pointers(argv);
  const std::vector<char*> own =
      confinement ? Pointers(confinement->environment) : std::vector<char*>{};
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw MachineError(fmt::format("cannot create a pipe: {}", std::strerror(errno)));
  }
  started_s_ = NowS();
  HearOfChildren();
  const pid_t parent = ::getpid();
  const sigset_t guarded = GuardedSignals();
  sigset_t before;
  ::pthread_sigmask(SIG_BLOCK, &guarded, &before);
  pid_ = ::fork();
  if (pid_ == 0) {
    Guard({.argv = arguments.data(),
           .environment = confinement ? own.data() : ::environ,
           .output = ends[1],
           .input = talk.input,
           .talk = talk.output,
           .ruleset = confinement ? confinement->ruleset : -1,
           .own_shared_memory = confinement && confinement->own_shared_memory,
           .shared_memory_access = confinement ? confinement->shared_memory_access : 0,
           .foreign = confinement.has_value()},
          parent, before);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[1]);
  output_ = ends[0];
  if (pid_ < 0) {
    ::close(output_);
    throw MachineError(fmt::format("cannot start {}: {}", argv[0], std::strerror(errno)));
  }
  ::fcntl(output_, F_SETFL, O_NONBLOCK);
  constexpr int kRoomBytes = 1 << 20;  // a flood waits less for us, who look ten times a second
  ::fcntl(output_, F_SETPIPE_SZ, kRoomBytes);
}

Process::~Process() {
  if (!ended_) {
    KillTree();
    for (int round = 0; round < 200 && ::waitpid(pid_, nullptr, WNOHANG) == 0; ++round) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  ::close(output_);
}

bool Process::Poll() {
  if (ended_) return true;
  ReadOutput();
  HoldToLimits();
  int status = 0;
  const pid_t waited = ::waitpid(pid_, &status, WNOHANG);
  const bool is_gone = waited < 0 && errno == ECHILD;
  if (waited != pid_ && !is_gone) return false;
  ended_ = true;
  ReadOutput();
  if (!partial_line_.empty()) TakeLine(std::exchange(partial_line_, {}));
  result_.wall_s = NowS() - started_s_;
  if (!killed_) {
    result_.end =
        WIFSIGNALED(status) ? ProcessResult::End::kSignalled : ProcessResult::End::kExited;
  }
  result_.code = is_gone               ? kUnknownEnd
                 : WIFSIGNALED(status) ? WTERMSIG(status)
                                       : WEXITSTATUS(status);
  return true;
}

void Process::ReadOutput() {
  char buffer[8192];
  // A bounded number of reads: a child that floods its output must not hold up the others.
  for (int round = 0; round < 256; ++round) {
    const ssize_t count = ::read(output_, buffer, sizeof buffer);
    if (count <= 0) return;
    for (const char c : std::string_view(buffer, static_cast<std::size_t>(count))) {
      if (c == '\n') {
        TakeLine(std::exchange(partial_line_, {}));
      } else if (partial_line_.size() < limits_.log_bytes) {
        partial_line_ += c;
      }
    }
  }
}

void Process::TakeLine(const std::string& line) {
  if (foreign_ ? TakeFrameCount(line, &progress_) : TakeProgress(line, &progress_)) return;
  result_.log += line + "\n";
  if (result_.log.size() > 2 * limits_.log_bytes) {
    result_.log.erase(0, result_.log.size() - limits_.log_bytes);
  }
}

double Process::MemoryMib() {
  const double resident_mib = TreeMib(pid_, ResidentMib);
  if (resident_mib <= limits_.memory_mib) return resident_mib;
  constexpr double kCountEvery_s = 0.5;  // of gigabytes it takes milliseconds
  if (NowS() > counted_s_ + kCountEvery_s) {
    shared_once_mib_ = TreeMib(pid_, ProportionalMib);
    counted_s_ = NowS();
  }
  return shared_once_mib_;
}

void Process::HoldToLimits() {
  if (killed_) return;
  const double memory_mib = MemoryMib();
  result_.peak_rss_mib = std::max(result_.peak_rss_mib, memory_mib);
  if (NowS() - started_s_ > limits_.wall_s) {
    result_.end = ProcessResult::End::kTimeout;
  } else if (memory_mib > limits_.memory_mib) {
    result_.end = ProcessResult::End::kMemory;
  } else {
    return;
  }
  killed_ = true;
  KillTree();
}

/// The guard takes all with it that is below, wherever it has gone.
void Process::KillTree() { ::kill(pid_, SIGTERM); }

}  // namespace aisle
