#include "simulator/mesh/door/reading_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <thread>

namespace aisle::sim {
namespace {

constexpr std::size_t kMostComplaint = 4096;

[[noreturn]] void Fail(const std::filesystem::path& program, int error) {
  throw std::system_error(error, std::generic_category(), program.string() + " cannot be started");
}

/// Two ends that are closed when they are not needed any more.
struct Pipe {
  explicit Pipe(const std::filesystem::path& program) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) Fail(program, errno);
    out = ends[0];
    in = ends[1];
  }
  ~Pipe() {
    Close(&out);
    Close(&in);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  static void Close(int* end) {
    if (*end >= 0) ::close(std::exchange(*end, -1));
  }
  int out = -1, in = -1;
};

/// As posix_spawn takes them, whose signature is older than const.
std::vector<char*> Pointers(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// What the program must know of the environment: where libraries lie and, in a build that is
/// watched, what ThreadSanitizer is to leave out.
std::vector<std::string> Environment() {
#ifdef __SANITIZE_THREAD__
  constexpr std::array kKnown = {"LD_LIBRARY_PATH", "TSAN_OPTIONS"};
#else
  constexpr std::array kKnown = {"LD_LIBRARY_PATH"};
#endif
  std::vector<std::string> environment;
  for (const char* name : kKnown) {
    if (const char* value = std::getenv(name)) {
      environment.push_back(fmt::format("{}={}", name, value));
    }
  }
  return environment;
}

pid_t Start(const std::filesystem::path& program, const std::vector<std::string>& arguments,
            const Pipe& output, const Pipe& errors) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, output.in, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, errors.in, STDERR_FILENO);
  ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  sigset_t none, all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::vector<std::string> environment = Environment();
  pid_t pid = -1;
  const int error = ::posix_spawn(&pid, program.c_str(), &files, &attributes,
                                  Pointers(words).data(), Pointers(environment).data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  if (error != 0) Fail(program, error);
  return pid;
}

/// Takes what is there to be read; false at its end.
bool Take(int from, std::string* to) {
  char buffer[1 << 16];
  const ssize_t count = ::read(from, buffer, sizeof buffer);
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  to->append(buffer, static_cast<std::size_t>(count));
  return count > 0;
}

using Clock = std::chrono::steady_clock;

/// Reads both pipes until they are closed or a limit is passed; the latter is `reading->end`.
void TakeAll(Pipe* output, Pipe* errors, Clock::time_point end, std::size_t most_bytes,
             Reading* reading) {
  while (output->out >= 0 || errors->out >= 0) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd ends[] = {{output->out, POLLIN, 0}, {errors->out, POLLIN, 0}};
    const int ready = left <= 0 ? 0 : ::poll(ends, 2, static_cast<int>(std::min(left, 1'000'000L)));
    if (ready == 0) {
      reading->end = Reading::End::kTooLong;
      return;
    }
    if (ends[0].revents != 0 && !Take(output->out, &reading->bytes)) Pipe::Close(&output->out);
    if (ends[1].revents != 0 && !Take(errors->out, &reading->complaint)) Pipe::Close(&errors->out);
    if (reading->complaint.size() > kMostComplaint) reading->complaint.resize(kMostComplaint);
    if (reading->bytes.size() > most_bytes) {
      reading->end = Reading::End::kTooMuch;
      return;
    }
  }
}

/// How a process ended, once it has; none while it runs.
std::optional<int> StatusOf(pid_t pid, int options) {
  int status = 0;
  pid_t ended = 0;
  do {
    ended = ::waitpid(pid, &status, options);
  } while (ended < 0 && errno == EINTR);
  return ended == 0 ? std::nullopt : std::optional(status);
}

/// Waits for one that has closed its pipes and may go on all the same; none if it does until `end`.
std::optional<int> WaitUntil(pid_t pid, Clock::time_point end) {
  constexpr auto kFirst = std::chrono::microseconds(100),
                 kLongest = std::chrono::microseconds(20'000);
  for (auto pause = kFirst;; pause = std::min(2 * pause, kLongest)) {
    if (const std::optional<int> status = StatusOf(pid, WNOHANG)) return status;
    if (Clock::now() >= end) return std::nullopt;
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

Reading RunReader(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                  const ReadingLimits& limits, std::size_t most_bytes) {
  Pipe output(program), errors(program);
  const pid_t pid = Start(program, arguments, output, errors);
  Pipe::Close(&output.in);
  Pipe::Close(&errors.in);
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(limits.time_s));
  Reading reading;
  try {
    TakeAll(&output, &errors, end, most_bytes, &reading);
  } catch (...) {  // no memory for what it writes
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
    throw;
  }
  std::optional<int> ended;
  if (reading.end == Reading::End::kExited) {
    ended = WaitUntil(pid, end);
    if (!ended) reading.end = Reading::End::kTooLong;
  }
  if (!ended) {
    ::kill(pid, SIGKILL);
    ended = StatusOf(pid, 0);
  }
  const int status = *ended;
  reading.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  if (reading.end == Reading::End::kExited && WIFSIGNALED(status)) {
    reading.end = Reading::End::kSignalled;
  }
  return reading;
}

}  // namespace aisle::sim
