#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace aisle {

/// A word as a shell hands it on: quotes taken away, `~` and known variables filled in.
struct CommandWord {
  std::string text;
  /// False where it holds what only a shell at work can fill in (an unknown variable, a
  /// substitution, a pattern); that part of `text` is as it stands in the command.
  bool plain = true;
};

/// One command between `;`, `&&`, `|`, brackets and ends of lines.
struct SimpleCommand {
  std::vector<CommandWord> words;   ///< reserved words and assignments too
  std::vector<CommandWord> inputs;  ///< what `<` reads; where output goes is left out
  std::vector<std::string> inner;   ///< commands whose output it takes: $(…) and `…`
  int closed = 0, opened = 0;       ///< round brackets before it, in this order
};

using ShellVariables = std::map<std::string, std::string>;

/// Reads what is given to `sh -c` (POSIX, Shell Command Language) as far as it can be told without
/// running it. Comments and here-documents are passed over.
class CommandReader {
 public:
  explicit CommandReader(std::string text) : text_(std::move(text)) {}

  /// The next command that has a word; nullopt at the end.
  std::optional<SimpleCommand> Next(const ShellVariables& variables);

 private:
  enum class Role { kWord, kInput, kDropped, kHereDocument };

  char At(std::size_t i) const { return i < text_.size() ? text_[i] : '\0'; }
  void Separate(SimpleCommand* command);
  Role Redirect();
  CommandWord ReadWord(const ShellVariables& variables, SimpleCommand* command);
  void ReadDoubleQuoted(const ShellVariables& variables, CommandWord* word, SimpleCommand* command);
  void ReadDollar(const ShellVariables& variables, bool quoted, CommandWord* word,
                  SimpleCommand* command);
  void ReadTilde(const ShellVariables& variables, CommandWord* word);
  void TakeInner(std::size_t begin, std::size_t end, std::size_t after, CommandWord* word,
                 SimpleCommand* command);
  void SkipHereDocuments();

  std::string text_;
  std::size_t at_ = 0;
  std::vector<std::string> here_documents_;  ///< the words that end those begun on this line
};

/// Whether it is NAME=….
bool IsAssignment(const std::string& word);

}  // namespace aisle
