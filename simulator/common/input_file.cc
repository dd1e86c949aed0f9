#include "simulator/common/input_file.h"

#include <fmt/format.h>

namespace aisle::sim {

std::string InputFileError(const std::filesystem::path& file, std::uintmax_t most_bytes) {
  namespace fs = std::filesystem;
  const std::string name = file.string();
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return name + ": no such file";
  if (!fs::exists(status)) return fmt::format("{}: cannot be read: {}", name, error.message());
  if (fs::is_directory(status)) return name + ": is a folder; name a file in it";
  if (!fs::is_regular_file(status)) return name + ": is a device or a pipe; name a regular file";
  const std::uintmax_t bytes = fs::file_size(file, error);
  if (error) return fmt::format("{}: cannot be read: {}", name, error.message());
  if (bytes <= most_bytes) return "";
  return fmt::format("{}: has {} bytes, and at most {} are read", name, bytes, most_bytes);
}

}  // namespace aisle::sim
