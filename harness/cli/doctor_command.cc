// What this machine has and lacks for the work, before the night finds out.
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "harness/campaign/sandbox.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/doctor_bits.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/places.h"
#include "harness/record/provenance.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

enum class Health { kGood, kLacking, kBad };

struct Finding {
  std::string what;
  Health health = Health::kGood;
  std::string said;
  std::string remedy;  ///< empty where nothing is wrong
};

std::string WordOf(Health health) {
  return health == Health::kGood ? "good" : health == Health::kLacking ? "lacking" : "BAD";
}

constexpr double kFewestDiskGib = 15;   ///< the frame cache alone may take 12
constexpr double kFewestMemoryGib = 4;  ///< one run with its frames ahead

Finding Processor() {
  const bool good = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  std::string isa;
  for (const auto& [name, has] : {std::pair("sse4.2", __builtin_cpu_supports("sse4.2") != 0),
                                  std::pair("avx2", __builtin_cpu_supports("avx2") != 0),
                                  std::pair("fma", __builtin_cpu_supports("fma") != 0),
                                  std::pair("avx512f", __builtin_cpu_supports("avx512f") != 0)}) {
    if (has) isa += std::string(isa.empty() ? "" : ", ") + name;
  }
  return {"processor", good ? Health::kGood : Health::kBad,
          fmt::format("{}; {} threads; {}", OwnProvenance().cpu,
                      std::thread::hardware_concurrency(), isa),
          good ? "" : "this program needs AVX2 and FMA: it will not run here"};
}

Finding Memory() {
  const double gib = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
                     static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 30);
  const bool enough = gib >= kFewestMemoryGib;
  return {"memory", enough ? Health::kGood : Health::kLacking, fmt::format("{:.1f} GiB", gib),
          enough ? "" : "run with --jobs 1"};
}

fs::path NearestExisting(fs::path path) {
  path = fs::absolute(path);
  while (!fs::exists(path) && path.has_relative_path()) path = path.parent_path();
  return path;
}

Finding Disk(const std::string& what, const fs::path& wanted) {
  const fs::path path = NearestExisting(wanted);
  struct statvfs disk {};
  if (::statvfs(path.c_str(), &disk) != 0 || ::access(path.c_str(), W_OK) != 0) {
    return {what, Health::kBad, wanted.string() + ": not writable", "choose another folder"};
  }
  const double gib =
      static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize) / (1 << 30);
  const bool enough = gib >= kFewestDiskGib;
  return {what, enough ? Health::kGood : Health::kLacking,
          fmt::format("{}: {:.0f} GiB free", wanted.string(), gib),
          enough ? ""
                 : fmt::format("frames may need {:.0f} GiB: set AISLE_CACHE to a larger disk",
                               kFewestDiskGib)};
}

Finding Assets() {
  try {
    return {"assets", Health::kGood, AssetsDir().string(), ""};
  } catch (const std::exception& error) {
    return {"assets", Health::kBad, error.what(), "set AISLE_ASSETS"};
  }
}

bool OnPath(const std::string& program) {
  std::istringstream folders(std::getenv("PATH") != nullptr ? std::getenv("PATH") : "");
  std::string folder;
  while (std::getline(folders, folder, ':')) {
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

Finding Tool(const std::string& program, const std::string& use) {
  const bool there = OnPath(program);
  return {program, there ? Health::kGood : Health::kLacking, use,
          there ? "" : "optional: apt-get install " + program};
}

/// Debian's packages that packages.txt of the source tree names for every command.
Finding Packages() {
  if (IsInstalled()) return {"packages", Health::kGood, "installed as dependencies", ""};
  if (!fs::exists("/var/lib/dpkg")) {
    return {"packages", Health::kGood, "not checked: not a Debian system", ""};
  }
  std::ifstream list(OwnFolder() / "packages.txt");
  if (!list) return {"packages", Health::kLacking, "packages.txt not found beside the program", ""};
  std::string line, missing;
  int count = 0;
  while (std::getline(list, line)) {
    const bool for_one_command = line.find(':') != std::string::npos;
    if (line.empty() || line.front() == '#' || for_one_command) continue;
    ++count;
    const bool there = fs::exists("/var/lib/dpkg/info/" + line + ".list") ||
                       fs::exists("/var/lib/dpkg/info/" + line + ":amd64.list");
    if (!there) missing += " " + line;
  }
  if (missing.empty()) {
    return {"packages", Health::kGood, fmt::format("all {} of packages.txt", count), ""};
  }
  return {"packages", Health::kLacking, "missing:" + missing, "apt-get install" + missing};
}

/// Whether systems of others can be held to their own folders.
Finding Confinement() {
  const bool whole = SandboxLevel() >= 6;
  return {"confine", whole ? Health::kGood : Health::kLacking, DescribeSandbox(),
          whole ? ""
                : "external systems are not fully confined: that needs Linux 6.12 or newer with "
                  "lsm=landlock,…"};
}

std::vector<Finding> Examine(const std::string& out) {
  return {Processor(),
          Memory(),
          Disk("cache", CacheDir()),
          Disk("reports", out),
          Assets(),
          Packages(),
          Confinement(),
          Tool("ffmpeg", "makes a short video of every run"),
          Tool("chromium", "opens the report in tests"),
          Tool("git", "finds the commit for every report")};
}

int Doctor(const std::string& out, const DoctorBitsOptions& to) {
  const bool json_alone = to.json && to.json_file.empty();
  const std::vector<Finding> findings = Examine(out);
  bool bad = false;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    bad = bad || finding.health == Health::kBad;
    list.push_back({{"what", finding.what},
                    {"health", WordOf(finding.health)},
                    {"said", finding.said},
                    {"remedy", finding.remedy}});
    if (json_alone) continue;
    fmt::print("{:10} {:8} {}\n", finding.what, WordOf(finding.health), finding.said);
    if (!finding.remedy.empty()) fmt::print("{:19} -> {}\n", "", finding.remedy);
  }
  const std::string json = Dump({{"version", OwnProvenance().version}, {"findings", list}});
  if (json_alone) fmt::print("{}", json);
  if (!to.json_file.empty()) WriteFileAtomically(to.json_file, json);
  return bad ? kOwnFailure : kAllPassed;
}

}  // namespace

void AddDoctorCommand(CLI::App* app, Action* action) {
  struct Options {
    std::string out = "out";
    bool bits = false;
    DoctorBitsOptions of_bits;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("doctor", "Show what this machine has and what it lacks for the work");
  CLI::Option* out =
      command->add_option("--out", options->out, "Folder that reports will go to; default: out");
  const CLI::Option* json =
      command
          ->add_option(
              "--json,--json-file", options->of_bits.json_file,
              "Print JSON instead of the table or, with a file name, write it to that file "
              "beside the table")
          ->expected(0, 1);
  command->option_defaults()->group("Bits");
  const auto bits =
      command
          ->add_flag(
              "--bits", options->bits,
              "Hash what each stage of a small drive computes on this processor, and name the "
              "first stage that differs from the processors in reports/baselines/bits.json")
          ->excludes(out);
  command->add_flag("--pictures", options->of_bits.pictures, "Hash the simulator's stages only")
      ->needs(bits);
  command
      ->add_option("--against", options->of_bits.against,
                   "List of hashes to compare with, as --json writes it")
      ->needs(bits);
  command->add_flag("--keep", options->of_bits.keep, "Add this processor's hashes to the list")
      ->needs(bits);
  AddThreads(command, &options->of_bits.threads, "never changes a bit")->needs(bits);
  command->footer("Example: ./aisle doctor --bits");
  command->callback([=] {
    *action = [=] {
      options->of_bits.json = json->count() > 0;
      return options->bits ? DoctorBits(options->of_bits) : Doctor(options->out, options->of_bits);
    };
  });
}

}  // namespace aisle
