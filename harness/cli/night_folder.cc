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
    throw InputError(out.string(), 0, "is a file; expected a folder for the report");
  }
  std::optional<FileLock> lock = FileLock::Try(out / kLock);
  if (!lock) {
    throw InputError(
        out.string(), 0,
        "in use by another `aisle run` or `merge`: wait for it, or choose another folder");
  }
  return *std::move(lock);
}

FileLock WaitForFolder(const fs::path& out) { return FileLock(out / kLock); }

FileLock ReadFromFolder(const fs::path& part) {
  std::optional<FileLock> lock = FileLock::TryToRead(part / kLock);
  if (!lock) {
    throw InputError(part.string(), 0, "in use by an `aisle run`: wait for it");
  }
  return *std::move(lock);
}

void LeaveTheCluster(const fs::path& out) {
  if (IsUnderWay(out)) {
    throw InputError(out.string(), 0,
                     "its jobs are still in the queue: `aisle status DIR` shows their progress; "
                     "wait for them, scancel them, or choose another --out");
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
