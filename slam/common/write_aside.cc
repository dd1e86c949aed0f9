#include "slam/common/write_aside.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace aisle::slam {
namespace {

namespace fs = std::filesystem;

/// Writes, flushes and closes; the first error's number, or 0.
int Fill(int descriptor, std::initializer_list<std::string_view> parts) {
  int error = 0;
  for (std::string_view part : parts) {
    while (error == 0 && !part.empty()) {
      const ssize_t written = ::write(descriptor, part.data(), part.size());
      if (written >= 0) {
        part.remove_prefix(static_cast<std::size_t>(written));
      } else if (errno != EINTR) {
        error = errno;
      }
    }
  }
  if (error == 0 && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

void WriteAside(const fs::path& file, std::initializer_list<std::string_view> parts) {
  // Two programs that write the same file at once must not write into each other's.
  const fs::path aside = fmt::format("{}.part-{}", file.string(), ::getpid());
  constexpr mode_t kReadByAll = 0644;
  const int descriptor =
      ::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadByAll);
  int error = descriptor < 0 ? errno : Fill(descriptor, parts);
  if (error == 0 && ::rename(aside.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return;
  if (descriptor >= 0) ::unlink(aside.c_str());
  throw std::runtime_error(
      fmt::format("{}: cannot be written: {}", file.string(), std::strerror(error)));
}

}  // namespace aisle::slam
