#include "harness/campaign/job.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "harness/bag/drive_bag.h"
#include "harness/campaign/command_files.h"
#include "harness/campaign/renderer_hash.h"
#include "harness/campaign/source.h"
#include "harness/contract/stream.h"
#include "harness/io/file.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/io/json_text.h"
#include "harness/io/places.h"
#include "harness/io/system_spec_json.h"
#include "harness/plugs/steering_options.h"
#include "harness/record/record.h"
#include "harness/record/record_json.h"
#include "harness/suite/recording.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

/// One that is not set differs from one that is set to nothing.
std::uint64_t HashVariable(const std::string& name, std::uint64_t seed) {
  const char* value = std::getenv(name.c_str());
  return Hash(value == nullptr ? name : name + "=" + value, seed);
}

/// Programs, scripts and settings that a command names count as well, where they are files, and so
/// do the variables that it is given beside the usual ones.
std::uint64_t HashSystem(const SystemSpec& system, std::uint64_t seed) {
  seed = Hash(ToJson(system).dump(), seed);
  if (!system.external) return seed;
  for (const std::string& name : system.external->environment) seed = HashVariable(name, seed);
  for (const fs::path& file : FilesOf(*system.external).files) seed = HashFile(file, seed);
  for (const fs::path path : system.external->depends_on) {
    seed = fs::is_directory(path) ? HashFolder(path, seed) : HashFile(path, seed);
  }
  return seed;
}

std::vector<std::string> SystemNamesOf(const std::vector<RunSpec>& specs) {
  std::vector<std::string> names;
  for (const RunSpec& spec : specs) names.push_back(spec.system.name);
  return names;
}

Job FromJson(const Json& json) {
  if (json.at("schema") != kSchema) {
    throw std::invalid_argument(fmt::format("schema is not {}", kSchema));
  }
  Job job;
  job.spec = {.scene = json.at("scene").get<std::string>(),
              .scene_file = json.at("scene_file").get<std::string>(),
              .twin = json.at("twin").get<std::string>(),
              .system = SystemSpecFromJson(json.at("system")),
              .seed = json.at("seed").get<std::uint64_t>(),
              .repeat = json.value("repeat", 1)};
  job.out = json.at("out").get<std::string>();
  job.frames = json.at("frames").get<std::string>();
  job.led_frames = json.value("led_frames", "");
  job.teaching = json.value("teaching", "");
  job.dataset = json.at("dataset").get<std::string>();
  job.frames_key = json.at("frames_key").get<std::string>();
  job.inputs_hash = json.at("inputs_hash").get<std::string>();
  job.threads = json.at("threads").get<int>();
  job.video = json.at("video").get<bool>();
  job.debug_dynamic = json.at("debug_dynamic").get<bool>();
  job.mcap = json.value("mcap", false);
  job.memory_mib = json.value("memory_mib", job.memory_mib);
  job.frames_in_report = json.value("frames_in_report", "worst");
  for (const auto& folder : json.value("hidden", std::vector<std::string>())) {
    job.hidden.emplace_back(folder);
  }
  return job;
}

}  // namespace

std::string ToJson(const Job& job) {
  Json hidden = Json::array();
  for (const fs::path& folder : job.hidden) hidden.push_back(folder.string());
  return Dump({{"schema", kSchema},
               {"scene", job.spec.scene},
               {"scene_file", job.spec.scene_file},
               {"twin", job.spec.twin},
               {"seed", job.spec.seed},
               {"repeat", job.spec.repeat},
               {"system", ToJson(job.spec.system)},
               {"out", job.out.string()},
               {"frames", job.frames.string()},
               {"led_frames", job.led_frames.string()},
               {"teaching", job.teaching.string()},
               {"dataset", job.dataset.string()},
               {"frames_key", job.frames_key},
               {"inputs_hash", job.inputs_hash},
               {"threads", job.threads},
               {"video", job.video},
               {"debug_dynamic", job.debug_dynamic},
               {"mcap", job.mcap},
               {"memory_mib", job.memory_mib},
               {"frames_in_report", job.frames_in_report},
               {"hidden", std::move(hidden)}});
}

Job JobFromJson(const std::string& text, const std::string& file) {
  try {
    return FromJson(ParseJson(text));
  } catch (const std::exception& error) {
    throw InputError(file, 0, "not a job file: " + Printable(error.what(), 200));
  }
}

fs::path JobPath(const fs::path& out, const RunSpec& spec) {
  return out / "runs" / RunId(spec) / "job.json";
}

void WriteJob(const Job& job) { WriteFileAtomically(JobPath(job.out, job.spec), ToJson(job)); }

Job ReadJob(const fs::path& file) { return JobFromJson(ReadFile(file), file.string()); }

Fingerprints::Fingerprints()
    : renderer_(HashFolder(AssetsDir(), RendererHash())), program_(HashFile(OwnExecutable())) {}

std::string Fingerprints::Frames(const RunSpec& spec) const {
  const auto [at, is_new] = sources_.try_emplace({spec.scene_file, spec.twin});
  if (is_new) at->second = HashSource(spec.scene_file, spec.twin, renderer_);
  return fmt::format("{:016x}", Hash(fmt::format("{} {}", spec.twin, spec.seed), at->second));
}

std::string Fingerprints::Run(const RunSpec& spec) const {
  const auto [at, is_new] = systems_.try_emplace(spec.system.name);
  if (is_new) at->second = HashSystem(spec.system, program_);
  return fmt::format("{:016x}", Hash(Frames(spec), at->second));
}

std::string Fingerprints::Teaching(const RunSpec& spec) const {
  const RunSpec led = AsLed(spec);
  return fmt::format("{:016x}", Hash(Frames(led), HashSystem(led.system, program_)));
}

std::filesystem::path FramesFolder(const std::string& key) { return CacheDir() / "frames" / key; }

std::vector<Job> MakeJobs(const std::vector<RunSpec>& specs, const Fingerprints& fingerprints,
                          const JobOptions& options) {
  if (options.mcap) RequireOwnTopics(SystemNamesOf(specs));
  std::vector<Job> jobs;
  std::map<std::string, bool> drives;  // by file: the runs of a scene are many
  const auto is_drive = [&](const std::string& file) {
    const auto [at, is_new] = drives.try_emplace(file);
    if (is_new) at->second = IsDriveSource(file);
    return at->second;
  };
  for (const RunSpec& spec : specs) {
    Job job{.spec = spec,
            .out = options.out,
            .frames = {},
            .dataset = {},
            .frames_key = {},
            .inputs_hash = fingerprints.Run(spec)};
    job.frames_key = fingerprints.Frames(spec);
    job.threads = options.threads;
    job.video = options.video;
    job.debug_dynamic = options.debug_dynamic;
    job.mcap = options.mcap;
    job.memory_mib = options.memory_mib;
    job.frames_in_report = options.frames_in_report;
    // A recording is read where it is: its frames are files already.
    if (options.frame_cache && !IsRecording(spec.scene_file)) {
      // What one is shown who steers, no other run sees.
      if (!is_drive(spec.scene_file)) job.frames = FramesFolder(job.frames_key);
      if (SteeringOf(spec.system.options).taught) {
        job.led_frames = FramesFolder(fingerprints.Frames(AsLed(spec)) + "-led");
        job.teaching = CacheDir() / "taught" / fingerprints.Teaching(spec);
      }
    }
    if (const auto& external = spec.system.external; external && !IsStream(*external)) {
      // Frames may be another scene's; what a guest is told of names is not.
      job.dataset = CacheDir() / "datasets" /
                    (job.frames_key + "-" + SafeName(spec.scene) + "-" + external->dataset);
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

}  // namespace aisle
