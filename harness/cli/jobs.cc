#include "harness/cli/jobs.h"

#include "harness/cli/places.h"
#include "harness/io/hash.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::uint64_t Mix(const std::string& text, std::uint64_t seed) { return Hash(text, seed); }

/// The program that a command starts with counts as well, where it is a file.
std::uint64_t HashExternal(const ExternalSystem& system, std::uint64_t seed) {
  seed = Mix(fmt::format("{}\n{}\n{}", system.command, system.dataset, system.trajectory), seed);
  const fs::path program = system.command.substr(0, system.command.find(' '));
  std::error_code error;
  return fs::is_regular_file(program, error) ? HashFile(program, seed) : seed;
}

std::vector<std::string> ExternalArguments(const ExternalSystem& system,
                                           const std::string& frames) {
  const std::string dataset = frames + "-" + system.dataset;
  return {"--external-command",
          system.command,
          "--external-dataset",
          system.dataset,
          "--external-trajectory",
          system.trajectory,
          "--external-timeout",
          fmt::format("{}", system.timeout_s),
          "--dataset",
          (CacheDir() / "datasets" / dataset).string()};
}

}  // namespace

Fingerprints::Fingerprints() : program_(HashFile(OwnExecutable(), HashFolder(AssetsDir()))) {}

std::string Fingerprints::Frames(const RunSpec& spec) const {
  const std::uint64_t scene = HashFile(spec.scene_file, program_);
  return fmt::format("{:016x}", Mix(fmt::format("{} {}", spec.twin, spec.seed), scene));
}

std::string Fingerprints::Run(const RunSpec& spec, const Suite& suite) const {
  std::uint64_t hash = Mix(Frames(spec) + " " + spec.system, program_);
  const auto external = suite.externals.find(spec.system);
  if (external != suite.externals.end()) hash = HashExternal(external->second, hash);
  return fmt::format("{:016x}", hash);
}

std::vector<Job> MakeJobs(const Suite& suite, const std::vector<RunSpec>& specs,
                          const Fingerprints& fingerprints, const JobOptions& options) {
  std::vector<Job> jobs;
  for (const RunSpec& spec : specs) {
    const std::string frames = fingerprints.Frames(spec);
    Job job{.spec = spec, .argv = {}, .frames_key = frames};
    job.inputs_hash = fingerprints.Run(spec, suite);
    job.argv = {OwnExecutable().string(),
                "run-one",
                "--scene",
                spec.scene,
                "--scene-file",
                spec.scene_file,
                "--twin",
                spec.twin,
                "--system",
                spec.system,
                "--seed",
                std::to_string(spec.seed),
                "--out",
                options.out.string(),
                "--inputs-hash",
                job.inputs_hash,
                "--threads",
                std::to_string(options.threads)};
    if (options.frame_cache) {
      job.argv.insert(job.argv.end(), {"--frames", (CacheDir() / "frames" / frames).string()});
    }
    const auto external = suite.externals.find(spec.system);
    if (external != suite.externals.end()) {
      const std::vector<std::string> more = ExternalArguments(external->second, frames);
      job.argv.insert(job.argv.end(), more.begin(), more.end());
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

}  // namespace aisle
