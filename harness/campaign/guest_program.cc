#include "harness/campaign/guest_program.h"

#include <unistd.h>

#include <chrono>
#include <thread>

#include "harness/campaign/command_files.h"
#include "harness/campaign/process.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr const char* kBlank = " \t\n";

/// The word that names the program: the first that sets no variable.
std::string ProgramWord(const std::string& command) {
  for (std::size_t at = 0; (at = command.find_first_not_of(kBlank, at)) != std::string::npos;) {
    const std::size_t end = std::min(command.find_first_of(" \t\n;|&<>", at), command.size());
    const std::string word = command.substr(at, end - at);
    const std::size_t sign = word.find('=');
    if (sign == std::string::npos || word.find('/') < sign) return word;
    at = end;
  }
  return "";
}

bool ShellKnows(const std::string& word) {
  if (word.find('/') != std::string::npos) return ::access(word.c_str(), X_OK) == 0;
  Process process({"/bin/sh", "-c", "command -v -- \"$1\"", "sh", word}, {.wall_s = 10});
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return process.result().end == ProcessResult::End::kExited && process.result().code == 0;
}

}  // namespace

std::string MissingProgram(const ExternalSystem& system) {
  std::string word = ProgramWord(system.command);
  constexpr std::string_view kSource = "{source}";
  if (word.starts_with(kSource)) word.replace(0, kSource.size(), system.repository);
  const bool plain = word.find_first_of("\"'`$\\(){}*?[]~!#") == std::string::npos;
  return word.empty() || !plain || ShellKnows(word) ? "" : word;
}

std::vector<std::string> NotesOfSystems(const Suite& suite) {
  std::vector<std::string> notes;
  for (const SystemSpec& system : suite.systems) {
    if (!system.external) continue;
    const std::string missing = MissingProgram(*system.external);
    if (!missing.empty()) {
      notes.push_back(fmt::format(
          "system '{}': its command begins with {}, which was not found: its runs would fail",
          system.name, Printable(missing, 200)));
    } else if (const std::string why = WhyUnseen(*system.external); !why.empty()) {
      notes.push_back(fmt::format(
          "--resume repeats the runs of {}: {}; name the files that determine what it does with "
          "depends_on",
          system.name, Printable(why, 300)));
    }
  }
  return notes;
}

}  // namespace aisle
