#include "harness/campaign/command_files.h"

#include <unistd.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include "harness/campaign/command_reader.h"
#include "harness/campaign/external_run.h"
#include "harness/campaign/sandbox.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Words after which a command begins; what `.` reads is as good as a program.
const std::set<std::string> kBeforePrograms{"if", "then", "elif",   "else",   "while",
                                            "do", "!",    "{",      "until",  "time",
                                            ".",  "exec", "source", "command"};
/// Words that the shell knows itself, those of a script's order among them.
const std::set<std::string> kShellWords{
    ":",    "[",        "}",      "alias",   "bg",    "break",  "case",  "cd",     "continue",
    "done", "echo",     "eval",   "esac",    "exit",  "export", "false", "fg",     "fi",
    "for",  "getopts",  "hash",   "in",      "jobs",  "kill",   "local", "printf", "pwd",
    "read", "readonly", "return", "set",     "shift", "test",   "times", "trap",   "true",
    "type", "ulimit",   "umask",  "unalias", "unset", "wait"};
const std::set<std::string> kShells{"sh", "bash", "dash", "ksh", "zsh"};

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// Follows a command from word to word: where it stands by then, and what it has set.
class Walk {
 public:
  explicit Walk(const std::vector<std::string>& environment) {
    for (const std::string& entry : environment) Set(entry);
    variables_.erase("TMPDIR");  // another in each run
    Enter(fs::path());
  }

  /// `counts`: whether a program of it that is not found is a gap; not of a text that may be none.
  void Follow(const std::string& command, bool counts, int depth = 0) {
    constexpr int kDeepest = 8;
    if (depth > kDeepest) return;
    const std::optional<fs::path> folder = folder_;
    const ShellVariables variables = variables_;
    CommandReader reader(command);
    std::vector<std::optional<fs::path>> outside;  // of round brackets
    while (const std::optional<SimpleCommand> simple = reader.Next(variables_)) {
      for (int i = 0; i < simple->closed && !outside.empty(); ++i) {
        Enter(outside.back());
        outside.pop_back();
      }
      outside.insert(outside.end(), static_cast<std::size_t>(simple->opened), folder_);
      for (const std::string& inner : simple->inner) Follow(inner, false, depth + 1);
      for (const CommandWord& input : simple->inputs) TakeWord(input);
      FollowSimple(simple->words, counts, depth);
    }
    folder_ = folder;
    variables_ = variables;
  }

  const CommandFiles& found() const { return found_; }

 private:
  void FollowSimple(const std::vector<CommandWord>& words, bool counts, int depth) {
    std::size_t program = 0;
    for (; program < words.size(); ++program) {
      const CommandWord& word = words[program];
      if (IsAssignment(word.text)) {
        SetOrForget(word);
      } else if (!word.plain || !kBeforePrograms.contains(word.text)) {
        break;
      }
    }
    for (const CommandWord& word : words) {
      const bool may_be_command = word.text.find_first_of(" \t\n;&|()'\"") != std::string::npos;
      if (!TakeWord(word) && may_be_command) Follow(word.text, false, depth + 1);
    }
    if (program == words.size() || words[program].text.empty()) return;
    if (counts && !IsKnown(words[program])) found_.unknown.push_back(words[program].text);
    const auto next = words.begin() + static_cast<std::ptrdiff_t>(program) + 1;
    Obey(words[program].text, {next, words.end()}, counts, depth);
  }

  /// "-c", "-lc": the next word is a command.
  static bool IsCommandOption(const std::string& word) {
    return word.starts_with('-') && !word.starts_with("--") && word.ends_with('c');
  }

  /// What commands that the shell knows change for those after them, or bid it do.
  void Obey(const std::string& program, const std::vector<CommandWord>& arguments, bool counts,
            int depth) {
    if (program == "cd") return ChangeFolder(arguments);
    if (program == "export" || program == "readonly") {
      for (const CommandWord& word : arguments) {
        if (IsAssignment(word.text)) SetOrForget(word);
      }
    }
    const bool is_shell = kShells.contains(fs::path(program).filename().string());
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const bool is_text = is_shell && i > 0 && IsCommandOption(arguments[i - 1].text);
      if (is_text || program == "eval") Follow(arguments[i].text, counts, depth + 1);
    }
  }

  void ChangeFolder(const std::vector<CommandWord>& arguments) {
    const auto target = std::find_if(arguments.begin(), arguments.end(), [](const CommandWord& w) {
      return w.text != "-L" && w.text != "-P" && w.text != "--";
    });
    const CommandWord home{variables_.contains("HOME") ? variables_.at("HOME") : ""};
    const CommandWord& word = target == arguments.end() ? home : *target;
    const std::optional<fs::path> path = word.plain ? From(word.text) : std::nullopt;
    Enter(path && IsFolder(*path) ? path : std::nullopt);
  }

  void Enter(const std::optional<fs::path>& folder) {
    folder_ = folder;
    variables_.erase("PWD");
    if (folder) variables_["PWD"] = (fs::current_path() / *folder).lexically_normal().string();
  }

  void Set(const std::string& assignment) {
    const std::size_t sign = assignment.find('=');
    variables_[assignment.substr(0, sign)] = assignment.substr(sign + 1);
  }
  void SetOrForget(const CommandWord& assignment) {
    if (assignment.plain) return Set(assignment.text);
    variables_.erase(assignment.text.substr(0, assignment.text.find('=')));
  }

  /// A path as the command means it; none where it is not known where the command stands.
  std::optional<fs::path> From(const std::string& path) const {
    if (path.empty()) return std::nullopt;
    if (fs::path(path).is_absolute()) return path;
    return folder_ ? std::optional(*folder_ / path) : std::nullopt;
  }

  std::optional<fs::path> OnPath(const std::string& name) const {
    const auto path = variables_.find("PATH");
    std::istringstream folders(path == variables_.end() ? "" : path->second);
    for (std::string folder; std::getline(folders, folder, ':');) {
      const fs::path file = fs::path(folder) / name;
      if (::access(file.c_str(), X_OK) == 0 && IsFile(file)) return file;
    }
    return std::nullopt;
  }

  bool IsKnown(const CommandWord& program) const {
    if (!program.plain) return false;
    if (program.text.find('/') == std::string::npos) {
      return kShellWords.contains(program.text) || OnPath(program.text);
    }
    const std::optional<fs::path> file = From(program.text);
    return file && IsFile(*file);
  }

  bool Take(const std::optional<fs::path>& path) {
    if (!path || !IsFile(*path)) return false;
    auto& files = found_.files;
    if (std::find(files.begin(), files.end(), *path) == files.end()) files.push_back(*path);
    return true;
  }

  bool TakeWord(const CommandWord& word) {
    if (!word.plain) return false;
    if (Take(From(word.text))) return true;
    const std::size_t value = word.text.find_first_of(":=");
    if (value != std::string::npos && Take(From(word.text.substr(value + 1)))) return true;
    return word.text.find('/') == std::string::npos && Take(OnPath(word.text));
  }

  CommandFiles found_;
  std::optional<fs::path> folder_;  ///< where it stands; empty: where we do; none: not known
  ShellVariables variables_;
};

}  // namespace

CommandFiles FilesOf(const ExternalSystem& system) {
  Walk walk(ScrubbedEnvironment("", system.environment));
  walk.Follow(FillIn(system.command, {{"source", system.repository}}), true);
  return walk.found();
}

std::string UnknownProgram(const ExternalSystem& system) {
  if (!system.depends_on.empty()) return "";
  const CommandFiles named = FilesOf(system);
  return named.unknown.empty() ? "" : named.unknown.front();
}

}  // namespace aisle
