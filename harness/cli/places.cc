#include "harness/cli/places.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

fs::path FromEnvironment(const char* variable, const fs::path& otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? fs::path(value) : otherwise;
}

/// The value after `key` in a file of "key separator value" lines.
std::string LookUp(const fs::path& file, const std::string& key, const std::string& separator) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line)) {
    if (!line.starts_with(key)) continue;
    std::string value = line.substr(std::min(line.find(separator) + separator.size(), line.size()));
    const std::size_t first = value.find_first_not_of(" \t\""),
                      last = value.find_last_not_of(" \"");
    if (first != std::string::npos) return value.substr(first, last - first + 1);
  }
  return "unknown";
}

/// Short commit of the source tree, with "+" where files were changed since.
std::string SourceCommit() {
  const std::string command =
      "git -C '" AISLE_SOURCE_DIR "' describe --always --dirty=+ --exclude '*' 2>/dev/null";
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return "unknown";
  char buffer[64] = "";
  const bool read = std::fgets(buffer, sizeof buffer, pipe) != nullptr;
  ::pclose(pipe);
  std::string commit = read ? buffer : "unknown";
  if (!commit.empty() && commit.back() == '\n') commit.pop_back();
  return commit;
}

}  // namespace

fs::path AssetsDir() {
  const fs::path dir = FromEnvironment("AISLE_ASSETS", fs::path(AISLE_SOURCE_DIR) / "assets");
  if (!fs::is_directory(dir)) {
    throw InputError(dir.string() + ": no such folder of assets; set AISLE_ASSETS to where it is");
  }
  return dir;
}

std::string SceneFile(const std::string& file_or_name) {
  if (fs::exists(file_or_name)) return file_or_name;
  return (AssetsDir().parent_path() / "scenes" / (file_or_name + ".yaml")).string();
}

fs::path CacheDir() {
  return FromEnvironment("AISLE_CACHE", fs::path(AISLE_SOURCE_DIR) / ".cache");
}

fs::path BaselinePath(const std::string& suite) {
  return fs::path(AISLE_SOURCE_DIR) / "reports" / "baselines" / (SafeName(suite) + ".json");
}

fs::path OwnExecutable() { return fs::read_symlink("/proc/self/exe"); }

Provenance OwnProvenance() {
  return {.version = AISLE_VERSION,
          .commit = SourceCommit(),
          .cpu = LookUp("/proc/cpuinfo", "model name", ":"),
          .os = LookUp("/etc/os-release", "PRETTY_NAME", "="),
          .threads = static_cast<int>(std::thread::hardware_concurrency())};
}

std::string NowIso8601() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace aisle
