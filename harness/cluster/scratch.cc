#include "harness/cluster/scratch.h"

#include <unistd.h>

#include <tuple>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = ".lock";

/// Folders that nobody holds any more.
void Sweep(const fs::path& home) {
  for (const auto& entry : fs::directory_iterator(home)) {
    if (!entry.path().filename().string().starts_with("task-")) continue;
    if (FileLock::Try(entry.path() / kLock)) std::ignore = TryToRemoveFolder(entry.path());
  }
}

}  // namespace

Scratch::Scratch(const fs::path& base) : home_(base / fmt::format("aisle-{}", getuid())) {
  // One at a time: a folder that is made and not yet locked looks like one left behind.
  const FileLock alone(home_ / kLock);
  Sweep(home_);
  std::string made = (home_ / "task-XXXXXX").string();
  if (mkdtemp(made.data()) == nullptr) {
    throw MachineError(home_.string() + ": cannot create a folder for a task there");
  }
  folder_ = made;
  held_.emplace(folder_ / kLock);
}

Scratch::~Scratch() { std::ignore = TryToRemoveFolder(folder_); }

}  // namespace aisle
