#include "harness/io/file.h"

#include <dirent.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "harness/io/descriptor.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAside = ".tmp-";  ///< in the name of a file that is being written

[[noreturn]] void Fail(const std::string& what, const fs::path& path) {
  throw MachineError(fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(errno)));
}

constexpr int kFolderFlags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;

void WriteAll(int file, std::string_view bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
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

/// What bytes go into and cannot be kept in: a device, a pipe, a socket.
bool IsStream(fs::file_type type) {
  return type == fs::file_type::character || type == fs::file_type::block ||
         type == fs::file_type::fifo || type == fs::file_type::socket;
}

/// The file that a link leads to, there or not, whose place is then taken by a new one: the link
/// stays. A circle ends where the kernel would give up.
fs::path AtEndOfLinks(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

/// Whether a call failed for want of what the machine has too little of, or by its fault, and not
/// by what it was asked.
bool IsMachineTrouble(int error) {
  return error == EMFILE || error == ENFILE || error == ENOMEM || error == EIO || error == ENOSPC;
}

/// Why a file that was asked for cannot be read: whoever named it, or the machine.
[[noreturn]] void FailToRead(const fs::path& path) {
  const int error = errno;
  if (IsMachineTrouble(error)) Fail("read", path);
  throw InputError(path.string(), 0, fmt::format("cannot read: {}", std::strerror(error)));
}

/// What can be read from where the descriptor stands.
std::string ReadAll(const Descriptor& file, const fs::path& path, std::size_t max_bytes) {
  struct stat status {};
  const bool sized = ::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode);
  const auto claimed = sized ? static_cast<std::size_t>(status.st_size) : 0;
  const auto too_large = [&] {
    return InputError(path.string(), 0, fmt::format("larger than the allowed {} bytes", max_bytes));
  };
  if (claimed > max_bytes) throw too_large();
  constexpr std::size_t kLeastRoom = 65536;
  std::string bytes(std::max(claimed + 1, kLeastRoom), '\0');
  std::size_t size = 0;
  for (;;) {
    if (size == bytes.size()) bytes.resize(2 * size);
    const ssize_t count = ::read(file.get(), bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) FailToRead(path);
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
    if (size > max_bytes) throw too_large();
  }
  bytes.resize(size);
  return bytes;
}

/// Opens a file below a folder without leaving it and without waiting; -1 and errno else.
int OpenBeneath(int folder, const std::string& name) {
  constexpr auto kFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
  struct open_how how {};
  how.flags = kFlags;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  const long file = ::syscall(SYS_openat2, folder, name.c_str(), &how, sizeof how);
  if (file >= 0 || (errno != ENOSYS && errno != EPERM)) return static_cast<int>(file);
  return ::openat(folder, name.c_str(), kFlags | O_NOFOLLOW);  // no link at all
}

}  // namespace

void MakeParentFolder(const fs::path& path) {
  if (!path.has_parent_path()) return;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error == std::errc::not_a_directory || error == std::errc::file_exists ||
      error == std::errc::filename_too_long) {
    throw InputError(path.parent_path().string(), 0,
                     error == std::errc::filename_too_long
                         ? "name too long for a folder"
                         : "is a file or lies below one; expected a folder");
  }
  if (error) {
    throw MachineError(fmt::format("{}: cannot create the folder: {}", path.parent_path().string(),
                                   error.message()));
  }
}

FileAside::FileAside(const fs::path& path) {
  MakeParentFolder(path);
  std::error_code none;
  if (IsStream(fs::status(path, none).type())) {
    path_ = aside_ = path;
    fd_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  } else {
    path_ = AtEndOfLinks(path);
    aside_ = AsideOf(path_);
    fd_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  }
  if (fd_ < 0) Fail("open", aside_);
}

FileAside::~FileAside() {
  if (fd_ < 0) return;
  ::close(fd_);
  if (aside_ != path_) ::unlink(aside_.c_str());
}

void FileAside::Append(std::string_view bytes) {
  WriteAll(fd_, bytes, aside_);
  size_ += bytes.size();
}

void FileAside::Commit(Durability durability) {
  if (aside_ == path_) {
    ::close(fd_);
    fd_ = -1;
    return;
  }
  const bool flush = durability == Durability::kSurvivesPowerLoss;
  if (flush && ::fsync(fd_) != 0) Fail("flush", aside_);
  if (::rename(aside_.c_str(), path_.c_str()) != 0) Fail("rename to", path_);
  ::close(fd_);
  fd_ = -1;
  if (!flush) return;
  const fs::path around = path_.has_parent_path() ? path_.parent_path() : ".";
  const Descriptor folder(::open(around.c_str(), kFolderFlags));
  if (folder.get() < 0) Fail("open", around);
  ::fsync(folder.get());  // some file systems cannot flush a folder; the file itself is safe
}

void WriteFileAtomically(const fs::path& path, std::string_view bytes, Durability durability) {
  FileAside file(path);
  file.Append(bytes);
  file.Commit(durability);
}

void ClearLeftovers(const fs::path& folder) {
  std::vector<fs::path> leftovers;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with('.') && name.find(kAside) != std::string::npos) {
      leftovers.push_back(at->path());
    }
  }
  for (const fs::path& path : leftovers) fs::remove(path, error);
}

namespace {

/// Lists what is below a folder.
class FilesBelowWalk {
 public:
  void Enter(const fs::path& folder) {
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0) return;
    const FolderId id{status.st_dev, status.st_ino};
    if (std::ranges::find(around_, id) != around_.end()) return;  // it would be within itself
    around_.push_back(id);
    std::error_code error;
    std::vector<fs::path> entries;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      entries.push_back(at->path());
    }
    const bool closed = error == std::errc::permission_denied;
    if (error && !closed && IsMachineTrouble(error.value())) Fail("list", folder);
    if (error && !closed) throw InputError(folder.string(), 0, "not readable: " + error.message());
    for (const fs::path& entry : entries) Take(entry);
    around_.pop_back();
  }

  std::set<fs::path> files;

 private:
  using FolderId = std::pair<dev_t, ino_t>;

  void Take(const fs::path& entry) {
    constexpr std::size_t kMostFiles = 1'000'000;  // 13 hours of stereo at 10 Hz
    std::error_code none;                          // a link that leads nowhere is no folder
    if (fs::is_directory(entry, none)) return Enter(entry);
    files.insert(entry);
    if (files.size() <= kMostFiles) return;
    throw InputError(
        entry.parent_path().string(), 0,
        fmt::format("more than {} files around it: name a smaller folder", kMostFiles));
  }

  std::vector<FolderId> around_;  ///< the folders that the present one is in
};

}  // namespace

std::set<fs::path> FilesBelow(const fs::path& folder) {
  FilesBelowWalk walk;
  walk.Enter(folder);
  return std::move(walk.files);
}

namespace {

int OpenToRead(const fs::path& path) {
  std::error_code error;
  const bool there = fs::exists(path, error);
  if (error == std::errc::filename_too_long) {
    throw InputError(Printable(path.string(), 80), 0, "name too long for a file");
  }
  if (!there) throw InputError(path.string(), 0, "no such file");
  if (fs::is_directory(path, error))
    throw InputError(path.string(), 0, "is a folder; expected a file");
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) FailToRead(path);
  return file;
}

}  // namespace

std::string ReadFile(const fs::path& path, std::size_t max_bytes) {
  return ReadAll(Descriptor(OpenToRead(path)), path, max_bytes);
}

void ReadInPieces(const fs::path& path, const std::function<void(std::string_view)>& take) {
  const Descriptor file(OpenToRead(path));
  std::string piece(std::size_t{1} << 20, '\0');
  while (true) {
    const ssize_t count = ::read(file.get(), piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) FailToRead(path);
    if (count == 0) return;
    take(std::string_view(piece).substr(0, static_cast<std::size_t>(count)));
  }
}

std::string ReadLeftFile(const fs::path& folder, const std::string& name, std::size_t max_bytes) {
  const fs::path path = folder / name;
  const Descriptor within(::open(folder.c_str(), kFolderFlags));
  if (within.get() < 0) FailToRead(folder);  // whoever works in it may have closed it
  const int file = OpenBeneath(within.get(), name);
  if (file < 0 && errno == ENOENT) throw InputError(path.string(), 0, "no such file");
  if (file < 0 && (errno == EXDEV || errno == ELOOP)) {
    throw InputError(path.string(), 0, "is a link out of its folder");
  }
  if (file < 0) FailToRead(path);
  const Descriptor opened(file);
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
    throw InputError(path.string(), 0, "not a regular file");
  }
  return ReadAll(opened, path, max_bytes);
}

namespace {

/// The names in an open folder, in no order; none where it cannot be read.
std::vector<std::string> NamesIn(int folder) {
  std::vector<std::string> names;
  const int own = ::openat(folder, ".", kFolderFlags);  // its place in the list is not shared
  DIR* list = own < 0 ? nullptr : ::fdopendir(own);
  if (list == nullptr) {
    if (own >= 0) ::close(own);
    return names;
  }
  while (const dirent* entry = ::readdir(list)) {
    const std::string name = entry->d_name;
    if (name != "." && name != "..") names.push_back(name);
  }
  ::closedir(list);
  return names;
}

bool IsFolderAt(int folder, const std::string& name) {
  struct stat status {};
  return ::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISDIR(status.st_mode);
}

/// Opens a folder to empty it, also where its mode forbids that; -1 where there is none.
int OpenToEmpty(int around, const std::string& name) {
  if (!IsFolderAt(around, name)) return -1;
  ::fchmodat(around, name.c_str(), S_IRWXU, 0);
  return ::openat(around, name.c_str(), kFolderFlags | O_NOFOLLOW);
}

/// Takes away all in an open folder with a handful of descriptors and short names, however deep the
/// tree is: folders are not descended into but moved up, each once, to stand in the open one.
class Emptying {
 public:
  explicit Emptying(int top) : top_(top), names_(NamesIn(top)) {}

  void Run() {
    while (!names_.empty()) {
      const std::string name = std::move(names_.back());
      names_.pop_back();
      if (::unlinkat(top_, name.c_str(), 0) != 0) RemoveFolderIn(name);
    }
  }

 private:
  void RemoveFolderIn(const std::string& name) {
    const Descriptor folder(OpenToEmpty(top_, name));
    for (const std::string& below : NamesIn(folder.get())) {
      if (::unlinkat(folder.get(), below.c_str(), 0) != 0) MoveUp(folder.get(), below);
    }
    ::unlinkat(top_, name.c_str(), AT_REMOVEDIR);
  }

  void MoveUp(int from, const std::string& name) {
    if (!IsFolderAt(from, name)) return;
    ::fchmodat(from, name.c_str(), S_IRWXU, 0);  // to move a folder is to write to it
    std::string free;
    struct stat taken {};
    do {  // what was left may have any name
      free = fmt::format(".moved-up-{}", moved_++);
    } while (::fstatat(top_, free.c_str(), &taken, AT_SYMLINK_NOFOLLOW) == 0);
    if (::renameat(from, name.c_str(), top_, free.c_str()) == 0) names_.push_back(free);
  }

  const int top_;
  std::vector<std::string> names_;  ///< what stands in the open folder and was not looked at
  std::uint64_t moved_ = 0;
};

}  // namespace

bool TryToRemoveFolder(const fs::path& folder) {
  const std::string name = folder.string();
  if (const Descriptor top(OpenToEmpty(AT_FDCWD, name)); top.get() >= 0) {
    Emptying(top.get()).Run();
    return ::rmdir(name.c_str()) == 0 || errno == ENOENT;
  }
  return ::unlink(name.c_str()) == 0 || errno == ENOENT || errno == ENOTDIR;
}

void RemoveFolder(const fs::path& folder) {
  if (TryToRemoveFolder(folder)) return;
  throw MachineError(folder.string() +
                     ": cannot be removed with all in it; what stays could be taken for the result "
                     "of a later run: remove it by hand");
}

}  // namespace aisle
