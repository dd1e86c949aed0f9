#pragma once

#include <filesystem>
#include <optional>

#include "harness/io/file_lock.h"
#include "harness/suite/plan.h"

namespace aisle {

/// The folder of a report, for one who fills or rewrites it: two nights in one folder would take
/// each other's results away. Throws InputError where another is at work there or it is a file.
FileLock TakeFolder(const std::filesystem::path& out);

/// The same for a cluster's own merge: waits until nobody else is at work there.
FileLock WaitForFolder(const std::filesystem::path& out);

/// The same for one who only reads it. Throws InputError where somebody is at work there.
FileLock ReadFromFolder(const std::filesystem::path& part);

/// A night of this machine in a folder that a cluster filled: `status` must not go on telling of
/// the cluster's. Throws InputError where its jobs are still in the queue.
void LeaveTheCluster(const std::filesystem::path& out);

/// Throws InputError where the folder holds no plan.
PlanFile ReadPlan(const std::filesystem::path& folder);
/// The plan that lies in the folder; none where there is none, or none that can be read.
std::optional<PlanFile> FindPlan(const std::filesystem::path& folder);

}  // namespace aisle
