#include "harness/cli/jobs.h"

#include "harness/cli/places.h"
#include "harness/io/hash.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::uint64_t Mix(const std::string& text, std::uint64_t seed) { return Hash(text, seed); }

/// The program that a command starts with counts as well, where it is a file.
std::uint64_t HashExternal(const ExternalSystem& system, std::uint64_t seed) {
  seed = Mix(fmt::format("{}\n{}\n{}\n{}", system.command, system.dataset, system.trajectory,
                         system.vslam_lab),
             seed);
  const fs::path program = system.command.substr(0, system.command.find(' '));
  std::error_code error;
  return fs::is_regular_file(program, error) ? HashFile(program, seed) : seed;
}

std::vector<std::string> ExternalArguments(const ExternalSystem& system,
                                           const std::string& frames) {
  const fs::path dataset = CacheDir() / "datasets" / (frames + "-" + system.dataset);
  std::vector<std::string> arguments{"--external-command",
                                     system.command,
                                     "--external-dataset",
                                     system.dataset,
                                     "--external-trajectory",
                                     system.trajectory,
                                     "--external-timeout",
                                     fmt::format("{}", system.timeout_s),
                                     "--dataset",
                                     dataset.string()};
  if (system.vslam_lab) arguments.push_back("--vslam-lab");
  return arguments;
}

/// As `run-one` takes them.
std::string ToText(const MaskErrors& errors) {
  return fmt::format("{},{},{},{}", errors.boundary_px, errors.miss_below_px, errors.miss_share,
                     errors.latency_frames);
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
  const auto imperfect = suite.imperfect.find(spec.system);
  if (imperfect != suite.imperfect.end()) {
    hash = Mix(imperfect->second.like + " " + ToText(imperfect->second.errors), hash);
  }
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
    if (!options.video) job.argv.push_back("--no-video");
    if (options.debug_dynamic) job.argv.push_back("--debug-dynamic");
    const auto external = suite.externals.find(spec.system);
    if (external != suite.externals.end()) {
      const std::vector<std::string> more = ExternalArguments(external->second, frames);
      job.argv.insert(job.argv.end(), more.begin(), more.end());
    }
    const auto imperfect = suite.imperfect.find(spec.system);
    if (imperfect != suite.imperfect.end()) {
      job.argv.insert(job.argv.end(), {"--like", imperfect->second.like, "--mask-errors",
                                       ToText(imperfect->second.errors)});
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

}  // namespace aisle
