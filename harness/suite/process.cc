#include "harness/suite/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

double NowS() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// In the child, between fork and exec: nothing here may allocate or lock.
[[noreturn]] void BecomeChild(char* const* argv, int output, pid_t parent) {
  ::setsid();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // the parent died before the line above
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  const int null = ::open("/dev/null", O_RDONLY);
  ::dup2(null, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::execv(argv[0], argv);
  ::_exit(127);
}

double ResidentMib(pid_t pid) {
  std::ifstream statm(fmt::format("/proc/{}/statm", pid));
  double total_pages = 0, resident_pages = 0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

pid_t ParentOf(const std::filesystem::path& process) {
  std::ifstream stat(process / "stat");
  std::string line;
  std::getline(stat, line);
  const std::size_t name_end = line.rfind(')');  // the name may hold anything, brackets too
  int parent = 0;
  char state = 0;
  if (name_end != std::string::npos) {
    std::sscanf(line.c_str() + name_end + 1, " %c %d", &state, &parent);
  }
  return parent;
}

std::vector<pid_t> Descendants(pid_t root) {
  std::multimap<pid_t, pid_t> children;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid > 0) children.emplace(ParentOf(entry.path()), pid);
  }
  std::vector<pid_t> found{root};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [begin, end] = children.equal_range(found[i]);
    for (auto child = begin; child != end; ++child) found.push_back(child->second);
  }
  found.erase(found.begin());
  return found;
}

}  // namespace

std::string Describe(const ProcessResult& result, const ProcessLimits& limits) {
  switch (result.end) {
    case ProcessResult::End::kTimeout:
      return fmt::format("no end after {:g} s: killed", limits.wall_s);
    case ProcessResult::End::kMemory:
      return fmt::format("more than {:g} MiB of memory: killed", limits.memory_mib);
    case ProcessResult::End::kSignalled:
      return fmt::format("signal {} ({})", result.code, ::strsignal(result.code));
    case ProcessResult::End::kExited:
      break;
  }
  return fmt::format("exit code {}", result.code);
}

Process::Process(const std::vector<std::string>& argv, const ProcessLimits& limits)
    : limits_(limits) {
  std::vector<char*> arguments;
  for (const std::string& argument : argv) {
    arguments.push_back(
        const_cast<char*>(argument.c_str()));  // execv's signature is older than const
  }
  arguments.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw MachineError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  started_s_ = NowS();
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) BecomeChild(arguments.data(), ends[1], parent);
  ::close(ends[1]);
  output_ = ends[0];
  if (pid_ < 0) {
    ::close(output_);
    throw MachineError(fmt::format("cannot start {}: {}", argv[0], std::strerror(errno)));
  }
  ::fcntl(output_, F_SETFL, O_NONBLOCK);
}

Process::~Process() {
  if (!ended_) {
    KillTree();
    ::waitpid(pid_, nullptr, 0);
  }
  ::close(output_);
}

bool Process::Poll() {
  if (ended_) return true;
  ReadOutput();
  HoldToLimits();
  int status = 0;
  rusage usage{};
  if (::wait4(pid_, &status, WNOHANG, &usage) != pid_) return false;
  ended_ = true;
  ::kill(-pid_, SIGKILL);  // what the child left behind goes with it
  ReadOutput();
  result_.wall_s = NowS() - started_s_;
  result_.peak_rss_mib =
      std::max(result_.peak_rss_mib, static_cast<double>(usage.ru_maxrss) / 1024);
  if (!killed_) {
    result_.end =
        WIFSIGNALED(status) ? ProcessResult::End::kSignalled : ProcessResult::End::kExited;
  }
  result_.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  return true;
}

void Process::ReadOutput() {
  char buffer[8192];
  // A bounded number of reads: a child that floods its output must not hold up the others.
  for (int round = 0; round < 64; ++round) {
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
  int done = 0, total = 0;
  if (std::sscanf(line.c_str(), "@progress %d %d", &done, &total) == 2) {
    progress_done_ = done;
    progress_total_ = total;
    return;
  }
  result_.log += line + "\n";
  if (result_.log.size() > 2 * limits_.log_bytes) {
    result_.log.erase(0, result_.log.size() - limits_.log_bytes);
  }
}

void Process::HoldToLimits() {
  if (killed_) return;
  const double resident_mib = ResidentMib(pid_);
  result_.peak_rss_mib = std::max(result_.peak_rss_mib, resident_mib);
  if (NowS() - started_s_ > limits_.wall_s) {
    result_.end = ProcessResult::End::kTimeout;
  } else if (resident_mib > limits_.memory_mib) {
    result_.end = ProcessResult::End::kMemory;
  } else {
    return;
  }
  killed_ = true;
  KillTree();
}

void Process::KillTree() {
  // Listed before the first dies: orphans forget whose they were. A grandchild may lead a group of
  // its own, as the systems of others do.
  const std::vector<pid_t> below = Descendants(pid_);
  ::kill(-pid_, SIGKILL);
  for (const pid_t pid : below) ::kill(pid, SIGKILL);
}

}  // namespace aisle
