#include "harness/cli/files_below.h"

#include <set>

#include "harness/cli/bag_notes.h"
#include "harness/common/first_of_many.h"
#include "harness/suite/suite.h"

namespace aisle {

namespace fs = std::filesystem;

std::string WhatRecording(const fs::path& folder) {
  const auto holds = [&](const char* name) {
    std::error_code error;
    return fs::exists(folder / name, error);
  };
  const auto sentence = [](const char* what, const char* keys) {
    return fmt::format(
        "is {}, not a folder of scenes: check a scene or suite file that has {} instead "
        "(reports/docs/bags.md)",
        what, keys);
  };
  if (holds("metadata.yaml")) return sentence("a ROS 2 bag", "`recording: FOLDER`");
  if (holds("cam0/sensor.yaml") || holds("mav0/cam0/sensor.yaml")) {
    return sentence("a dataset in EuRoC's layout", "`recording: FOLDER`");
  }
  if (holds("calib.txt") && holds("image_0")) {
    return sentence("a dataset in KITTI's layout", "`recording: FOLDER` and `format: kitti`");
  }
  return "";
}

std::vector<std::string> FilesBelow(const std::string& folder) {
  std::set<std::string> found;
  std::set<std::string> foreign;
  for (fs::recursive_directory_iterator at(folder), end; at != end; ++at) {
    const fs::path& path = at->path();
    if (at->is_directory() && !WhatRecording(path).empty()) {
      at.disable_recursion_pending();
    } else if (path.extension() == ".yaml") {
      (IsForeignYaml(path.string()) ? foreign : found).insert(path.string());
    }
  }
  if (!foreign.empty()) {
    const std::vector<std::string> names(foreign.begin(), foreign.end());
    TellNotes(folder, {fmt::format("skipped files that are neither scene, suite nor recording: {}",
                                   FirstOfMany(names, ", "))});
  }
  return {found.begin(), found.end()};
}

}  // namespace aisle
