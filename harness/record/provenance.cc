#include "harness/record/provenance.h"

#include <fmt/ranges.h>

#include <fstream>
#include <thread>

#include "harness/io/hash.h"
#include "harness/io/places.h"
#include "harness/io/shell_output.h"
#include "harness/io/shell_word.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

/// The value after `key` in a file of "key separator value" lines.
std::string LookUp(const std::filesystem::path& file, const std::string& key,
                   const std::string& separator) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line)) {
    if (!line.starts_with(key)) continue;
    std::string value = line.substr(std::min(line.find(separator) + separator.size(), line.size()));
    const std::size_t first = value.find_first_not_of(" \t\""),
                      last = value.find_last_not_of(" \"");
    if (first != std::string::npos) return value.substr(first, last - first + 1);
  }
  return "unknown";
}

/// That of the tree an installed program was built from; `cmake --install` writes it down.
std::string InstalledCommit() {
  std::ifstream stream(OwnFolder() / "commit");
  std::string commit;
  return std::getline(stream, commit) && !commit.empty() ? commit : "unknown";
}

/// What a shell command prints, without line ends.
std::string PrintedBy(const std::string& command) {
  std::string printed = RunInShell(command).text;
  std::erase(printed, '\n');
  return printed;
}

/// Short commit of the source tree, with "+" where files were changed since. Pages into which
/// measurements are written do not count: the second table of one command is by the same program.
std::string SourceCommit() {
  if (IsInstalled()) return InstalledCommit();
  const std::string git = "git -C " + ShellWord(OwnFolder().string());
  const std::string commit = PrintedBy(fmt::format(
      "{0} describe --always --exclude '*' 2>/dev/null && {{ {0} diff --quiet HEAD -- :/ "
      "':(exclude,top,glob)reports/**/*.md' 2>/dev/null || echo +; }}",
      git));
  return commit.empty() ? "unknown" : commit;
}

}  // namespace

Provenance OwnProvenance() {
  return {.version = AISLE_VERSION,
          .commit = SourceCommit(),
          .cpu = LookUp("/proc/cpuinfo", "model name", ":"),
          .os = LookUp("/etc/os-release", "PRETTY_NAME", "="),
          .threads = static_cast<int>(std::thread::hardware_concurrency())};
}

void SayWhoMadeIt(RunRecord* record) {
  static const Provenance kOwn = OwnProvenance();  // asks git: once a process
  static const std::string kProgram = fmt::format("{:016x}", HashFile(OwnExecutable()));
  record->program = kProgram;
  record->commit = kOwn.commit;
  record->cpu = kOwn.cpu;
}

Provenance ProvenanceOf(const std::vector<RunRecord>& runs) {
  std::set<std::string> commits, processors;
  for (const RunRecord& run : runs) {
    if (!run.commit.empty()) commits.insert(run.commit);
    if (!run.cpu.empty()) processors.insert(run.cpu);
  }
  Provenance provenance = OwnProvenance();
  if (!commits.empty()) provenance.commit = fmt::format("{}", fmt::join(commits, ", "));
  if (!processors.empty()) provenance.cpu = fmt::format("{}", fmt::join(processors, ", "));
  return provenance;
}

std::filesystem::path ShippedBaselines() {
  return OwnFolder() / (IsInstalled() ? "baselines" : "reports/baselines");
}

std::filesystem::path BaselinePath(const std::string& suite) {
  const std::filesystem::path own = NewBaselinePath(suite);
  std::error_code error;
  return std::filesystem::exists(own, error) ? own : ShippedBaselines() / own.filename();
}

std::filesystem::path NewBaselinePath(const std::string& suite) {
  const std::filesystem::path folder =
      IsInstalled() ? UserDataDir() / "baselines" : ShippedBaselines();
  return folder / (SafeName(suite) + ".json");
}

}  // namespace aisle
