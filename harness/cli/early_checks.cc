#include "harness/cli/early_checks.h"

#include <fmt/ranges.h>

#include <filesystem>
#include <set>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/plugs/simulated_sequence.h"

namespace aisle {

void CheckSceneFiles(const std::vector<std::string>& files) {
  std::vector<std::string> complaints;
  std::set<std::string> checked;
  for (const std::string& file : files) {
    if (!checked.insert(file).second) continue;
    for (std::string& complaint : CheckScene(file)) complaints.push_back(std::move(complaint));
  }
  if (!complaints.empty()) throw InputError(fmt::format("{}", fmt::join(complaints, "\n")));
}

void CheckCanBeWritten(const std::string& file) {
  if (file.empty()) return;
  if (std::filesystem::is_directory(file)) {
    throw InputError(file, 0, "is a folder; expected a file");
  }
  MakeParentFolder(file);
}

}  // namespace aisle
