#include "harness/io/places.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

fs::path FromEnvironment(const char* variable, const fs::path& otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? fs::path(value) : otherwise;
}

}  // namespace

fs::path SourceDir() { return AISLE_SOURCE_DIR; }

fs::path AssetsDir() {
  const fs::path dir = FromEnvironment("AISLE_ASSETS", SourceDir() / "assets");
  if (!fs::is_directory(dir)) {
    throw InputError(dir.string() + ": no such folder of assets; set AISLE_ASSETS to where it is");
  }
  return dir;
}

fs::path ScenesDir() { return AssetsDir().parent_path() / "scenes"; }

std::string SceneFile(const std::string& file_or_name) {
  std::error_code error;  // names that no file can have among them
  if (fs::exists(file_or_name, error)) return file_or_name;
  return (ScenesDir() / (file_or_name + ".yaml")).string();
}

fs::path CacheDir() { return FromEnvironment("AISLE_CACHE", SourceDir() / ".cache"); }

fs::path OwnExecutable() { return fs::read_symlink("/proc/self/exe"); }

std::string NowIso8601() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace aisle
