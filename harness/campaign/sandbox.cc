#include "harness/campaign/sandbox.h"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <set>

#include "harness/campaign/landlock.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kWriteFile = 1 << 1, kReadFile = 1 << 2, kRemoveFolder = 1 << 4,
                        kRemoveFile = 1 << 5, kMakeDevices = 1 << 6 | 1 << 11, kMakeFolder = 1 << 7,
                        kMakeFile = 1 << 8, kMakeSocket = 1 << 9, kMakeFifo = 1 << 10,
                        kMakeLink = 1 << 12, kMoveAcross = 1 << 13, kTruncate = 1 << 14;
constexpr std::uint64_t kScopeSignals = 1 << 1;
constexpr unsigned kAskVersion = 1;

/// All that is regulated; running and listing are not.
std::uint64_t Regulated(int level) {
  std::uint64_t access = kWriteFile | kReadFile | kRemoveFolder | kRemoveFile | kMakeDevices |
                         kMakeFolder | kMakeFile | kMakeSocket | kMakeFifo | kMakeLink;
  if (level >= 2) access |= kMoveAcross;
  if (level >= 3) access |= kTruncate;
  return access;
}

/// All but to make devices.
std::uint64_t Writing(int level) { return Regulated(level) & ~kMakeDevices; }

std::size_t AttributeBytes(int level) {
  return sizeof(std::uint64_t) * (level >= 6 ? 3 : level >= 4 ? 2 : 1);
}

bool IsAtOrBelow(const fs::path& path, const fs::path& folder) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end();
}

/// The machine's fault: a system that is held to the wrong rules would be blamed for it.
[[noreturn]] void Fail(const std::string& path, int error) {
  throw MachineError(fmt::format("{}: cannot set up the sandbox: {}", path, std::strerror(error)));
}

/// Not of what was asked, but of what the machine has too little of.
bool IsShortage(int error) { return error == EMFILE || error == ENFILE || error == ENOMEM; }

/// Adds rules to a set.
class Rules {
 public:
  Rules(int ruleset, int level, std::vector<fs::path> hidden)
      : ruleset_(ruleset), level_(level), hidden_(std::move(hidden)) {}

  /// What cannot be opened gets no rule and stays closed: false, and errno.
  bool Allow(const fs::path& path, std::uint64_t access) const {
    const Descriptor parent(::open(path.c_str(), O_PATH | O_CLOEXEC));
    struct stat status {};
    const bool there = parent.get() >= 0 && ::fstat(parent.get(), &status) == 0;
    if (!S_ISDIR(status.st_mode)) access &= kReadFile | kWriteFile | kTruncate;
    const bool good = there && AddPathRule(ruleset_, parent.get(), access & Regulated(level_));
    if (!good && IsShortage(errno)) Fail(path.string(), errno);
    return good;
  }

  /// Reading, of all below the folder but what is hidden: rules can allow, not forbid, so the
  /// folders on the way to what is hidden are opened entry by entry.
  void AllowReading(const fs::path& folder) const {
    if (IsANight(folder)) return;  // around the run, as around its second attempt, or beside it
    if (std::find(hidden_.begin(), hidden_.end(), folder) != hidden_.end()) return;
    const bool whole = std::none_of(hidden_.begin(), hidden_.end(), [&](const fs::path& hidden) {
      return IsAtOrBelow(hidden, folder);
    });
    if (whole) {
      Allow(folder, kReadFile);
      return;
    }
    for (const fs::path& entry : EntriesOf(folder)) {
      std::error_code gone;
      const fs::file_status status = fs::symlink_status(entry, gone);
      const bool history = entry.filename().string().starts_with("history.sqlite");
      if (gone || fs::is_symlink(status) || history || entry == "/dev") continue;
      AllowReading(entry);
    }
  }

  /// Those that hold nothing: neither disks nor the machine's memory.
  void AllowDevices() const {
    static const std::set<std::string> kClosed{"mem", "kmem", "port", "kmsg", "nvram", "mcelog"};
    for (const fs::path& entry : EntriesOf("/dev")) {
      std::error_code gone;
      const fs::file_status status = fs::symlink_status(entry, gone);
      if (fs::is_character_file(status) && !kClosed.contains(entry.filename().string())) {
        Allow(entry, kReadFile | kWriteFile | kTruncate);
      }
    }
    for (const char* folder : {"/dev/pts", "/dev/dri", "/dev/nvidia-caps", "/dev/bus"}) {
      Allow(folder, kReadFile | kWriteFile);
    }
    Allow("/dev/shm", Writing(level_));  // memory that processes share
  }

  /// Also of a folder that is not there or may not be opened: it was asked for.
  void RequireWriting(const fs::path& folder) const {
    if (!Allow(folder, Writing(level_))) Fail(folder.string(), errno);
  }

 private:
  /// None of one that may not be listed.
  static std::vector<fs::path> EntriesOf(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      entries.push_back(at->path());
    }
    if (IsShortage(error.value())) Fail(folder.string(), error.value());
    return entries;
  }

  /// A report's folder, finished or not.
  static bool IsANight(const fs::path& folder) {
    std::error_code error;
    const auto holds = [&](const char* name) { return fs::exists(folder / name, error); };
    return (holds("plan.json") && holds("runs")) || (holds("results.json") && holds("junit.xml"));
  }

  const int ruleset_;
  const int level_;
  const std::vector<fs::path> hidden_;
};

}  // namespace

int SandboxLevel() {
  const long level = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, kAskVersion);
  return level < 0 ? 0 : static_cast<int>(level);
}

std::string DescribeSandbox(int level) {
  if (level == 0) return "the kernel has no Landlock: external commands are not confined";
  std::vector<const char*> open;
  if (level < 3) open.push_back("cutting files short");
  if (level < 6) open.push_back("sending signals to other processes of the user");
  return fmt::format(
      "Landlock {}: external commands can read neither truth nor other runs' results, and can only "
      "write to their own folders; it does not regulate modes and times of files (those of the "
      "report and the cache are put back){}{}",
      level, open.empty() ? "" : "; this kernel cannot keep them from ",
      fmt::join(open, " nor from "));
}

Sandbox::Sandbox(const SandboxRules& rules) {
  const int level = SandboxLevel();
  if (level == 0) return;
  const LandlockRuleset attributes{
      .file_access = Regulated(level), .network_access = 0, .scopes = kScopeSignals};
  ruleset_ = Descriptor(static_cast<int>(
      ::syscall(SYS_landlock_create_ruleset, &attributes, AttributeBytes(level), 0)));
  if (ruleset_.get() < 0) Fail("Landlock", errno);
  writing_ = Writing(level);
  std::vector<fs::path> hidden;
  for (const fs::path& path : rules.hidden) hidden.push_back(fs::weakly_canonical(path));
  const Rules into(ruleset_.get(), level, hidden);
  into.AllowReading("/");
  into.AllowDevices();
  for (const fs::path& folder : rules.writable) into.RequireWriting(folder);
}

std::vector<std::string> ScrubbedEnvironment(const fs::path& tmpdir,
                                             const std::vector<std::string>& more) {
  static const std::set<std::string> kUsual{"PATH", "HOME",       "USER",     "LOGNAME",
                                            "TZ",   "SHELL",      "LANGUAGE", "LD_LIBRARY_PATH",
                                            "LANG", "VIRTUAL_ENV"};
  static const char* const kFamilies[] = {"LC_",  "PYTHON", "CONDA_", "PIXI_",  "CUDA_",
                                          "OMP_", "MKL_",   "ROS_",   "AMENT_", "OPENBLAS_"};
  std::vector<std::string> scrubbed{"TMPDIR=" + tmpdir.string()};
  for (char** entry = ::environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    const bool usual = kUsual.contains(name) ||
                       std::find(more.begin(), more.end(), name) != more.end() ||
                       std::any_of(std::begin(kFamilies), std::end(kFamilies),
                                   [&](const char* family) { return name.starts_with(family); });
    if (usual && name != "TMPDIR") scrubbed.push_back(text);
  }
  return scrubbed;
}

}  // namespace aisle
