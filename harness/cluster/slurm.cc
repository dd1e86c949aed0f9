#include "harness/cluster/slurm.h"

#include <charconv>
#include <sstream>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/shell_output.h"
#include "harness/io/shell_word.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// A value of an #SBATCH line, which sbatch reads by rules of its own: what it cannot hold is
/// refused rather than guessed at.
std::string Quoted(const std::string& value) {
  if (value.find_first_of("\"\\\n\r") != std::string::npos) {
    throw InputError(
        fmt::format("'{}': a batch script cannot contain paths or names with quotes, backslashes "
                    "or line breaks",
                    Printable(value, 200)));
  }
  return '"' + value + '"';
}

/// A path that sbatch fills in: its own per cent signs doubled.
std::string LogPath(const SlurmPaths& paths, const std::string& pattern) {
  std::string folder;
  for (const char c : (paths.out / "cluster" / "log").string())
    folder += c == '%' ? "%%" : std::string(1, c);
  return Quoted(folder + "/" + pattern);
}

std::string Head(const std::string& name, const SlurmOptions& options, const SlurmPaths& paths) {
  std::string text = "#!/bin/sh\n";
  text += fmt::format("#SBATCH --job-name={}\n", Quoted(name));
  text += fmt::format("#SBATCH --chdir={}\n", Quoted(paths.working_folder.string()));
  if (!options.partition.empty()) {
    text += fmt::format("#SBATCH --partition={}\n", Quoted(options.partition));
  }
  return text + "#SBATCH --requeue\n#SBATCH --open-mode=append\n";
}

/// What a command of Slurm's says, to stdout or stderr.
ShellOutput Ask(const std::vector<std::string>& argv) {
  std::string line;
  for (const std::string& word : argv) line += ShellWord(word) + " ";
  return RunInShell(line + "2>&1 </dev/null");
}

/// A site's MaxArraySize; Slurm's own default where it does not say.
std::size_t LargestArray() {
  constexpr std::size_t kDefault = 1001;
  const ShellOutput answer = Ask({"scontrol", "show", "config"});
  const std::size_t key = answer.text.find("MaxArraySize");
  const std::size_t digits = answer.text.find_first_of("0123456789", key);
  if (answer.status != 0 || key == std::string::npos || digits == std::string::npos)
    return kDefault;
  std::size_t size = 0;
  std::from_chars(answer.text.data() + digits, answer.text.data() + answer.text.size(), size);
  return size > 0 ? size : kDefault;
}

/// The number of the job that was submitted.
std::string Submit(const fs::path& script, const std::string& text,
                   const std::vector<std::string>& more) {
  WriteFileAtomically(script, text);
  std::vector<std::string> argv{"sbatch", "--parsable"};
  argv.insert(argv.end(), more.begin(), more.end());
  argv.push_back(script.string());
  const ShellOutput answer = Ask(argv);
  const std::string number = answer.text.substr(0, answer.text.find_first_not_of("0123456789"));
  if (answer.status == -1) throw MachineError("sbatch: cannot start a process");
  if (answer.status != 0 || number.empty()) {
    throw MachineError(fmt::format("sbatch {}: {}", script.string(), Printable(answer.text, 400)));
  }
  return number;
}

}  // namespace

std::string TaskScript(const ArrayPart& part, const SlurmOptions& options,
                       const SlurmPaths& paths) {
  std::string text = Head(options.name, options, paths);
  text += fmt::format("#SBATCH --array={}", part.indices);
  if (options.at_most > 0) text += fmt::format("%{}", options.at_most);
  text += fmt::format("\n#SBATCH --cpus-per-task={}\n", options.cpus);
  if (!options.time.empty()) text += fmt::format("#SBATCH --time={}\n", Quoted(options.time));
  text += fmt::format("#SBATCH --output={}\n", LogPath(paths, "%A_%a.txt"));
  // In the shell's place: what Slurm sends to the job reaches the program.
  return text + fmt::format("exec {} run-task {} --offset {}\n", ShellWord(paths.program.string()),
                            ShellWord(paths.out.string()), part.offset);
}

std::string MergeScript(const std::string& submission, const SlurmOptions& options,
                        const SlurmPaths& paths) {
  std::string text = Head(options.name + "-merge", options, paths);
  text += fmt::format("#SBATCH --output={}\n", LogPath(paths, "merge_%j.txt"));
  return text + fmt::format("exec {} merge {} --submission {}\n", ShellWord(paths.program.string()),
                            ShellWord(paths.out.string()), ShellWord(submission));
}

Submission SubmitToSlurm(const std::vector<std::size_t>& tasks, const std::string& id,
                         const SlurmOptions& options, const SlurmPaths& paths) {
  const fs::path folder = paths.out / "cluster";
  MakeParentFolder(folder / "log" / "any");
  Submission submission{.id = id, .arrays = {}, .merge = {}};
  std::string after = "--dependency=afterany";
  for (const ArrayPart& part : SplitArray(tasks, LargestArray())) {
    const fs::path script = folder / fmt::format("tasks_{}.sbatch", part.offset);
    submission.arrays.push_back(Submit(script, TaskScript(part, options, paths), {}));
    WriteSubmission(submission, paths.out);
    after += ":" + submission.arrays.back();
  }
  submission.merge = Submit(folder / "merge.sbatch", MergeScript(id, options, paths), {after});
  WriteSubmission(submission, paths.out);
  return submission;
}

std::optional<std::map<std::string, int>> QueueOf(const Submission& submission) {
  const ShellOutput answer = Ask({"squeue", "--noheader", "--array", "--me", "--format=%F|%T"});
  if (answer.status != 0) return std::nullopt;
  return CountStates(answer.text, submission);
}

std::map<std::string, int> CountStates(const std::string& squeue, const Submission& submission) {
  std::map<std::string, int> states;
  std::istringstream stream(squeue);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t bar = line.find('|');
    if (bar == std::string::npos) continue;
    const std::string job = line.substr(0, bar);
    const auto& arrays = submission.arrays;
    if (job != submission.merge && std::find(arrays.begin(), arrays.end(), job) == arrays.end()) {
      continue;
    }
    ++states[line.substr(bar + 1)];
  }
  return states;
}

}  // namespace aisle
