#include "harness/io/places.h"

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

fs::path FromEnvironment(const char* variable, const fs::path& otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? fs::path(value) : otherwise;
}

fs::path Home() { return FromEnvironment("HOME", "."); }

/// Of this very code; it does not move while it runs.
const OwnPlace& Here() {
  static const OwnPlace place = FindOwnPlace(OwnFile());
  return place;
}

}  // namespace

OwnPlace FindOwnPlace(const fs::path& executable) {
  std::error_code error;
  for (fs::path folder = executable.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    const fs::path shared = folder / "share" / "aisle";
    if (fs::exists(shared / "assets", error)) return {shared, true};
    std::ifstream built(folder / "aisle-built-from");
    std::string tree;
    if (std::getline(built, tree)) return {tree, false};
    if (folder == folder.root_path()) break;
  }
  return {};
}

fs::path OwnFolder() {
  if (!Here().folder.empty()) return Here().folder;
  throw InputError(OwnFile().string() +
                   ": found neither share/aisle nor a source tree around it; set AISLE_ASSETS to "
                   "the folder of assets, with scenes beside it");
}

bool IsInstalled() { return Here().installed; }

std::string OwnCommand() { return IsInstalled() ? "aisle" : "./aisle"; }

fs::path AssetsDir() {
  const char* given = std::getenv("AISLE_ASSETS");
  const bool elsewhere = given != nullptr && *given != '\0';
  const fs::path dir = elsewhere ? fs::path(given) : OwnFolder() / "assets";
  if (!fs::is_directory(dir)) {
    throw InputError(dir.string() + ": no such folder of assets; set AISLE_ASSETS to its path");
  }
  return dir;
}

fs::path ScenesDir() { return AssetsDir().parent_path() / "scenes"; }

std::string SceneFile(const std::string& file_or_name) {
  std::error_code error;  // names that no file can have among them
  if (file_or_name.empty() || fs::exists(file_or_name, error)) return file_or_name;
  const fs::path scenes = ScenesDir();
  for (const fs::path& file :
       {scenes / (file_or_name + ".yaml"), scenes / file_or_name,
        scenes / "suites" / (file_or_name + ".yaml"), scenes.parent_path() / file_or_name}) {
    if (fs::exists(file, error)) return file.lexically_normal().string();
  }
  return file_or_name;
}

std::vector<std::string> NamesOfScenes() {
  const fs::path scenes = ScenesDir();
  std::set<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator at(scenes, error), end; at != end; at.increment(error)) {
    if (at->path().extension() != ".yaml") continue;
    const fs::path name = at->path().lexically_relative(scenes).replace_extension();
    names.insert(*name.begin() == "suites" ? name.filename().string() : name.string());
  }
  return {names.begin(), names.end()};
}

fs::path CacheDir() {
  const bool in_tree = !Here().folder.empty() && !Here().installed;
  return FromEnvironment("AISLE_CACHE",
                         in_tree ? Here().folder / ".cache"
                                 : FromEnvironment("XDG_CACHE_HOME", Home() / ".cache") / "aisle");
}

fs::path UserDataDir() {
  return FromEnvironment("XDG_DATA_HOME", Home() / ".local/share") / "aisle";
}

fs::path OwnExecutable() { return fs::read_symlink("/proc/self/exe"); }

fs::path OwnFile() {
  Dl_info info{};
  link_map* loaded = nullptr;
  const auto here = reinterpret_cast<const void*>(&OwnFile);
  const bool known = dladdr1(here, &info, reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP) != 0;
  // The program itself is loaded without a name.
  if (known && loaded != nullptr && *loaded->l_name != '\0') return fs::absolute(loaded->l_name);
  return fs::read_symlink("/proc/self/exe");
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
