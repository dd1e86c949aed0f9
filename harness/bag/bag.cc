#include "harness/bag/bag.h"

#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// The bag files of a folder that rosbag2 made.
std::vector<fs::path> BagsIn(const fs::path& folder) {
  std::set<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file(error) && IsBagFile(entry.path())) files.insert(entry.path());
  }
  return {files.begin(), files.end()};
}

}  // namespace

bool IsBagFile(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".mcap" || ending == ".db3";
}

std::unique_ptr<Bag> OpenBag(const fs::path& path) {
  if (fs::is_directory(path)) {
    const std::vector<fs::path> files = BagsIn(path);
    if (files.size() == 1) return OpenBag(files.front());
    throw InputError(path.string(), 0,
                     files.empty() ? "no .mcap or .db3 file in this folder"
                                   : fmt::format("is a bag split into {} files: join them with "
                                                 "`ros2 bag convert`, or name one of them",
                                                 files.size()));
  }
  if (!fs::exists(path)) throw InputError(path.string(), 0, "no such file");
  if (path.extension() == ".zstd") {
    throw InputError(path.string(), 0,
                     "is compressed as a whole: decompress it with `zstd -d` first");
  }
  if (path.extension() == ".bag") {
    throw InputError(path.string(), 0,
                     "is a ROS 1 bag: convert it, for example with `rosbags-convert`");
  }
  return path.extension() == ".db3" ? OpenDb3(path) : OpenMcap(path);
}

}  // namespace aisle
