#pragma once

#include <filesystem>
#include <string>

namespace aisle {

struct KubernetesOptions {
  std::string name;   ///< of the suite; made one that Kubernetes takes
  std::string image;  ///< holds `aisle`
  std::string claim;  ///< PersistentVolumeClaim that is mounted at the report's folder
  std::size_t tasks = 1;
  int at_most = 0;                            ///< pods at once; 0: as many as tasks
  int cpus = 2;                               ///< of a task
  double memory_mib = 8192;                   ///< of a task
  std::filesystem::path out, working_folder;  ///< absolute, in the pods
};

/// Two documents of YAML, batch/v1: the Indexed Job of the tasks, each of which finds its number in
/// JOB_COMPLETION_INDEX, and the Job of the merge, suspended: Kubernetes has nothing that starts
/// one Job after another, so whoever waits for the first releases the second. A pod that was
/// evicted, or two for one index, do no harm: a task begins with what is there.
std::string KubernetesJobs(const KubernetesOptions& options);

/// Commands for a shell that drive a night by that file to its end: what the folder's last night
/// left goes first, since a Job that is there is neither run again nor changed by `apply`; the
/// merge is released when the tasks have ended, also where their Job failed.
std::string KubernetesRecipe(const KubernetesOptions& options, const std::filesystem::path& file);

/// The tasks' Job, by suite and report's folder, so that a suite's nights in two folders do not
/// meet. A name as RFC 1123 has it: lower-case letters, digits and hyphens, a letter first, at most
/// 52 characters, so that "-merge" and a pod's own ending still fit in.
std::string KubernetesName(const std::string& suite, const std::filesystem::path& out);

}  // namespace aisle
