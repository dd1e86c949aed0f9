#include "harness/campaign/command_files.h"

#include <unistd.h>
#include <wordexp.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "harness/campaign/external_run.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// As a shell would hand them on; nullopt where only a shell at work can tell.
std::optional<Words> WordsOf(const std::string& command) {
  // Arithmetic is no substitution of a command to wordexp, and none of ours.
  if (command.find("$(") != std::string::npos) return std::nullopt;
  wordexp_t read{};
  if (::wordexp(command.c_str(), &read, WRDE_NOCMD | WRDE_UNDEF) != 0) return std::nullopt;
  Words words(read.we_wordv, read.we_wordv + read.we_wordc);
  ::wordfree(&read);
  return words;
}

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::optional<fs::path> OnPath(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    if (::access(file.c_str(), X_OK) == 0 && IsFile(file)) return file;
  }
  return std::nullopt;
}

std::optional<fs::path> FileOf(const std::string& word) {
  if (IsFile(word)) return word;
  const std::size_t value = word.find_first_of(":=");
  if (value != std::string::npos && IsFile(word.substr(value + 1))) return word.substr(value + 1);
  return !word.empty() && word.find('/') == std::string::npos ? OnPath(word) : std::nullopt;
}

bool IsProgram(const std::string& word) {
  return word.find('/') == std::string::npos ? OnPath(word).has_value() : IsFile(word);
}

/// NAME=…, which a shell sets for the program behind it.
bool IsAssignment(const std::string& word) {
  const std::size_t sign = word.find('=');
  return sign != std::string::npos && sign > 0 && word.find_first_of("/-") > sign;
}

bool IsShell(const std::string& program) {
  static const std::set<std::string> kShells{"sh", "bash", "dash", "ksh", "zsh"};
  return kShells.contains(fs::path(program).filename().string());
}

/// "-c", "-lc": the next word is a command.
bool IsCommandOption(const std::string& word) {
  return word.starts_with('-') && !word.starts_with("--") && word.ends_with('c');
}

CommandFiles FilesOfCommand(const std::string& command) {
  const std::optional<Words> words = WordsOf(command);
  if (!words) return {};
  CommandFiles found;
  for (const std::string& word : *words) {
    const std::optional<fs::path> file = FileOf(word);
    const bool is_new =
        file && std::find(found.files.begin(), found.files.end(), *file) == found.files.end();
    if (is_new) found.files.push_back(*file);
  }
  const auto program = std::find_if_not(words->begin(), words->end(), IsAssignment);
  if (program == words->end()) return found;
  found.complete = IsProgram(*program);
  const auto option = std::find_if(program, words->end(), IsCommandOption);
  if (!IsShell(*program) || words->end() - option < 2) return found;
  const CommandFiles inner = FilesOfCommand(*(option + 1));
  found.files.insert(found.files.end(), inner.files.begin(), inner.files.end());
  found.complete = found.complete && inner.complete;
  return found;
}

}  // namespace

CommandFiles FilesOf(const ExternalSystem& system) {
  // What differs between runs is no file that decides what the system is.
  return FilesOfCommand(FillIn(system.command, {{"dataset", ""},
                                                {"calibration", ""},
                                                {"output", ""},
                                                {"seed", ""},
                                                {"source", system.repository}}));
}

bool MayChangeUnseen(const ExternalSystem& system) {
  return system.depends_on.empty() && !FilesOf(system).complete;
}

}  // namespace aisle
