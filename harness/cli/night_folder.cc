#include "harness/cli/night_folder.h"

#include "harness/cli/cluster_night.h"
#include "harness/cluster/submission.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = ".lock";

}  // namespace

FileLock TakeFolder(const fs::path& out) {
  if (fs::exists(out) && !fs::is_directory(out)) {
    throw InputError(out.string(), 0, "is a file: a report needs a folder");
  }
  std::optional<FileLock> lock = FileLock::Try(out / kLock);
  if (!lock) {
    throw InputError(out.string(), 0,
                     "another `aisle run` is at work there, or a `merge`: wait for it, or choose "
                     "another folder");
  }
  return *std::move(lock);
}

FileLock WaitForFolder(const fs::path& out) { return FileLock(out / kLock); }

FileLock ReadFromFolder(const fs::path& part) {
  std::optional<FileLock> lock = FileLock::TryToRead(part / kLock);
  if (!lock) {
    throw InputError(part.string(), 0, "an `aisle run` is still at work there: wait for it");
  }
  return *std::move(lock);
}

void LeaveTheCluster(const fs::path& out) {
  if (IsUnderWay(out)) {
    throw InputError(out.string(), 0,
                     "its jobs are still in the queue: `aisle status DIR` tells how they go; wait "
                     "for them, scancel them, or choose another --out");
  }
  ForgetNight(out);
}

PlanFile ReadPlan(const fs::path& folder) {
  const fs::path path = folder / "plan.json";
  return PlanFromJson(ReadFile(path), path.string());
}

std::optional<PlanFile> FindPlan(const fs::path& folder) {
  try {
    return ReadPlan(folder);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace aisle
