#include "harness/io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAside = ".tmp-";  ///< in the name of a file that is being written

[[noreturn]] void Fail(const std::string& what, const fs::path& path) {
  throw MachineError(fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(errno)));
}

/// An open file that cannot be forgotten.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {
    if (fd_ < 0) Fail("open", path);
  }
  ~Descriptor() { ::close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

void WriteAll(const Descriptor& file, std::string_view bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) Fail("write", path);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Unique among the threads and processes that may write the same file at once.
fs::path AsideOf(const fs::path& path) {
  static std::atomic<unsigned> count = 0;
  const std::string name = fmt::format(".{}{}{}-{}", path.filename().string().substr(0, 200),
                                       kAside, ::getpid(), count.fetch_add(1));
  return path.parent_path() / name;
}

void MakeParent(const fs::path& path) {
  if (!path.has_parent_path()) return;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) {
    throw MachineError(fmt::format("{}: cannot make the folder: {}", path.parent_path().string(),
                                   error.message()));
  }
}

}  // namespace

void WriteFileAtomically(const fs::path& path, std::string_view bytes, Durability durability) {
  MakeParent(path);
  const fs::path aside = AsideOf(path);
  const bool flush = durability == Durability::kSurvivesPowerLoss;
  try {
    const Descriptor file(aside, O_WRONLY | O_CREAT | O_EXCL);
    WriteAll(file, bytes, aside);
    if (flush && ::fsync(file.get()) != 0) Fail("flush", aside);
    if (::rename(aside.c_str(), path.c_str()) != 0) Fail("rename to", path);
  } catch (...) {
    ::unlink(aside.c_str());
    throw;
  }
  if (!flush) return;
  const Descriptor folder(path.has_parent_path() ? path.parent_path() : fs::path("."),
                          O_RDONLY | O_DIRECTORY);
  ::fsync(folder.get());  // some file systems cannot flush a folder; the file itself is safe
}

void ClearLeftovers(const fs::path& folder) {
  std::vector<fs::path> leftovers;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.find(kAside) != std::string::npos) {
      leftovers.push_back(entry.path());
    }
  }
  for (const fs::path& path : leftovers) fs::remove(path, error);
}

std::string ReadFile(const fs::path& path, std::size_t max_bytes) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(path.string(), 0, "no such file");
  if (fs::is_directory(path, error)) throw InputError(path.string(), 0, "is a folder, not a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string(), 0, "cannot be read");
  std::ostringstream text;
  text << stream.rdbuf();
  std::string bytes = std::move(text).str();
  if (bytes.size() > max_bytes) {
    throw InputError(path.string(), 0,
                     fmt::format("is larger than the allowed {} bytes", max_bytes));
  }
  return bytes;
}

}  // namespace aisle
