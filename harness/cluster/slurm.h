#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/cluster/array.h"
#include "harness/cluster/submission.h"

namespace aisle {

/// What a site asks for.
struct SlurmOptions {
  std::string name;            ///< of the jobs, as the queue shows it
  std::string partition = {};  ///< empty: the site's default
  std::string time = {};       ///< of a task, as sbatch takes it; empty: the partition's default
  int cpus = 2;                ///< of a task
  int at_most = 0;             ///< tasks at once, and so nodes; 0: as many as there is room for
};

/// Where things lie, the same on every node.
struct SlurmPaths {
  std::filesystem::path program, out, working_folder;  ///< absolute
};

/// The batch script of a part of the tasks. Requeued tasks begin anew and find what is there.
/// Throws InputError where a path or a name cannot stand in a script.
std::string TaskScript(const ArrayPart& part, const SlurmOptions& options, const SlurmPaths& paths);

/// The batch script of the merge, to be submitted with a dependency on the tasks' end.
std::string MergeScript(const std::string& submission, const SlurmOptions& options,
                        const SlurmPaths& paths);

/// Writes the scripts below out/cluster and submits them: the tasks, then the merge when they have
/// ended, however they did (afterany: afterok would never run after a task that failed once).
/// Throws MachineError with what sbatch said.
Submission SubmitToSlurm(const std::vector<std::size_t>& tasks, const std::string& id,
                         const SlurmOptions& options, const SlurmPaths& paths);

/// Jobs of a submission that the queue knows, counted by state ("RUNNING" …); array tasks one by
/// one. None where the controller does not answer.
std::optional<std::map<std::string, int>> QueueOf(const Submission& submission);

/// The same of squeue's output, a line "ARRAY_JOB|STATE" a task.
std::map<std::string, int> CountStates(const std::string& squeue, const Submission& submission);

}  // namespace aisle
