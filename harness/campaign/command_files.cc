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

/// What stands behind "key:", "key=" or "--key="; empty where there is no such sign.
std::string ValueOf(const std::string& word) {
  const std::size_t sign = word.find_first_of(":=");
  return sign == std::string::npos ? "" : word.substr(sign + 1);
}

std::optional<fs::path> FileOf(const std::string& word) {
  for (const std::string& place : {word, ValueOf(word)}) {
    if (IsFile(place)) return place;
  }
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

/// The first that is a folder, or has one as its value; none where there is no such word.
std::optional<std::string> FolderAmong(const Words& words) {
  std::error_code error;
  for (const std::string& word : words) {
    for (const std::string& place : {word, ValueOf(word)}) {
      if (fs::is_directory(place, error)) return place;
    }
  }
  return std::nullopt;
}

/// "python", "python3.11".
bool IsPython(const std::string& program) {
  const std::string name = fs::path(program).filename().string(), python = "python";
  return name.starts_with(python) &&
         name.find_first_not_of("0123456789.", python.size()) == std::string::npos;
}

/// What does as its arguments say, wherever it is installed.
bool IsInterpreter(const std::string& program) {
  static const std::set<std::string> kInterpreters{"perl", "ruby", "node",    "java",   "julia",
                                                   "lua",  "php",  "Rscript", "octave", "matlab"};
  return IsShell(program) || IsPython(program) ||
         kInterpreters.contains(fs::path(program).filename().string());
}

/// Whether it came with the machine, behind links too.
bool IsTheMachines(const fs::path& file) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(file, error).relative_path();
  auto part = real.begin();
  if (part == real.end()) return false;
  static const std::set<std::string> kFolders{"usr", "bin", "sbin", "snap"};
  return kFolders.contains(part->string()) &&
         !(*part == "usr" && ++part != real.end() && *part == "local");
}

/// Whether it is the same whatever system it runs.
bool IsEverybodys(const fs::path& file) {
  return IsInterpreter(file.string()) || IsTheMachines(file);
}

/// What a program starts that no file of its command is: an image, an environment, a target.
bool IsLauncher(const std::string& program) {
  static const std::set<std::string> kLaunchers{
      "docker", "podman", "apptainer", "singularity", "conda",  "mamba",     "micromamba",
      "pixi",   "uv",     "poetry",    "ros2",        "rosrun", "roslaunch", "make",
      "ninja",  "cmake",  "cargo",     "npm",         "npx",    "ssh",       "flatpak"};
  return kLaunchers.contains(fs::path(program).filename().string());
}

/// `python3 -m slam`, `python3 -c '…'`: what it runs is found among all that is installed.
bool IsPythonWithoutScript(Words::const_iterator program, Words::const_iterator end) {
  if (!IsPython(*program)) return false;
  while (++program != end && program->starts_with('-')) {
    if (*program == "-m" || *program == "-c") return true;
  }
  return false;
}

/// CommandFiles::unseen of words that are one program with its arguments, whose files are these.
std::string UnseenBehind(const Words& words, const std::vector<fs::path>& files) {
  const auto program = std::find_if_not(words.begin(), words.end(), IsAssignment);
  if (program == words.end()) return "its command starts nothing";
  if (!IsProgram(*program)) {
    return fmt::format("its command begins with {}, which is not a program here", *program);
  }
  for (auto word = program; word != words.end(); ++word) {  // also behind `env`, `nice`, …
    if (!IsProgram(*word)) continue;
    if (IsLauncher(*word) || IsPythonWithoutScript(word, words.end())) {
      return fmt::format("what {} starts is not among the files of its command", *word);
    }
  }
  if (const auto folder = FolderAmong(words)) {
    return fmt::format("its command names a folder, {}", *folder);
  }
  if (std::all_of(files.begin(), files.end(), IsEverybodys)) {
    return fmt::format("its command names no file of its own beside {}", *program);
  }
  return "";
}

void AddNew(const fs::path& file, std::vector<fs::path>* files) {
  if (std::find(files->begin(), files->end(), file) == files->end()) files->push_back(file);
}

CommandFiles FilesOfCommand(const std::string& command) {
  const std::optional<Words> words = WordsOf(command);
  if (!words) return {.files = {}, .unseen = "only a shell can tell what its command runs"};
  CommandFiles found;
  for (const std::string& word : *words) {
    if (const std::optional<fs::path> file = FileOf(word)) AddNew(*file, &found.files);
  }
  const auto program = std::find_if_not(words->begin(), words->end(), IsAssignment);
  const auto option = std::find_if(program, words->end(), IsCommandOption);
  if (program == words->end() || !IsShell(*program) || words->end() - option < 2) {
    found.unseen = UnseenBehind(*words, found.files);
    return found;
  }
  const CommandFiles inner = FilesOfCommand(*(option + 1));
  for (const fs::path& file : inner.files) AddNew(file, &found.files);
  found.unseen = IsProgram(*program) ? inner.unseen : UnseenBehind(*words, found.files);
  return found;
}

}  // namespace

CommandFiles FilesOf(const ExternalSystem& system) {
  // What differs between runs is no file that decides what the system is: nothing is below a
  // device, whatever the command adds to the name.
  const std::string nothing = "/dev/null/run";
  return FilesOfCommand(FillIn(system.command, {{"dataset", nothing},
                                                {"calibration", nothing},
                                                {"output", nothing},
                                                {"seed", ""},
                                                {"source", system.repository}}));
}

std::string WhyUnseen(const ExternalSystem& system) {
  return system.depends_on.empty() ? FilesOf(system).unseen : "";
}

}  // namespace aisle
