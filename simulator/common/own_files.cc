#include "simulator/common/own_files.h"

#include <dlfcn.h>
#include <link.h>

#include <fstream>

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

/// The first that `look` finds in a folder around the file, from inside out.
fs::path FromInsideOut(const fs::path& file, const std::function<fs::path(const fs::path&)>& look) {
  for (fs::path folder = file.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    if (fs::path found = look(folder); !found.empty()) return found;
    if (folder == folder.root_path()) break;
  }
  return {};
}

bool Exists(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

}  // namespace

fs::path FindOwnFolder(const fs::path& executable) {
  return FromInsideOut(executable, [](const fs::path& folder) -> fs::path {
    if (Exists(folder / "share/aisle/assets")) return folder / "share/aisle";
    std::ifstream built(folder / kBuiltFrom);
    std::string tree;
    return std::getline(built, tree) ? fs::path(tree) : fs::path();
  });
}

fs::path FindOwnHelper(const fs::path& executable, const std::string& name, const fs::path& built) {
  return FromInsideOut(executable, [&](const fs::path& folder) -> fs::path {
    const fs::path installed = folder / "libexec/aisle" / name;
    if (Exists(installed)) return installed;
    return Exists(folder / kBuiltFrom) ? folder / built : fs::path();
  });
}

fs::path OwnFile() {
  Dl_info info{};
  link_map* loaded = nullptr;
  const auto here = reinterpret_cast<const void*>(&OwnFile);
  const bool known = dladdr1(here, &info, reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP) != 0;
  // The program itself is loaded without a name.
  if (known && loaded != nullptr && *loaded->l_name != '\0') return fs::absolute(loaded->l_name);
  return fs::read_symlink("/proc/self/exe");
}

}  // namespace aisle::sim
