#include "harness/campaign/command_reader.h"

#include <algorithm>

namespace aisle {
namespace {

constexpr std::string_view kBlank = " \t";
constexpr std::string_view kSeparators = "\n;|&()";
constexpr std::string_view kPatterns = "*?[";

bool IsNameStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool Holds(std::string_view set, char c) { return c != '\0' && set.find(c) != set.npos; }

bool EndsWord(char c) {
  return c == '\0' || Holds(kBlank, c) || Holds(kSeparators, c) || c == '<' || c == '>';
}

/// Where the name ends that begins there.
std::size_t NameEnd(const std::string& text, std::size_t at) {
  if (at >= text.size() || !IsNameStart(text[at])) return at;
  while (at < text.size() && (IsNameStart(text[at]) || IsDigit(text[at]))) ++at;
  return at;
}

/// Where the bracket closes that was opened before `at`, quotes heeded; the text's end where it
/// does not.
std::size_t ClosingBracket(const std::string& text, std::size_t at) {
  int open = 1;
  char quote = '\0';
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\\' && quote != '\'') {
      ++at;
    } else if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '(') {
      ++open;
    } else if (c == ')' && --open == 0) {
      return at;
    }
  }
  return text.size();
}

}  // namespace

bool IsAssignment(const std::string& word) {
  const std::size_t end = NameEnd(word, 0);
  return end > 0 && end < word.size() && word[end] == '=';
}

std::optional<SimpleCommand> CommandReader::Next(const ShellVariables& variables) {
  SimpleCommand command;
  Role role = Role::kWord;
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '\0' || Holds(kBlank, c)) {
      ++at_;
    } else if (c == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (Holds(kSeparators, c)) {
      if (!command.words.empty() || !command.inputs.empty()) return command;
      Separate(&command);
      role = Role::kWord;
    } else if (c == '<' || c == '>') {
      role = Redirect();
    } else {
      const std::size_t begin = at_;
      CommandWord word = ReadWord(variables, &command);
      const std::string_view raw = std::string_view(text_).substr(begin, at_ - begin);
      const bool is_descriptor =
          (At(at_) == '<' || At(at_) == '>') && std::all_of(raw.begin(), raw.end(), IsDigit);
      if (role == Role::kHereDocument) here_documents_.push_back(word.text);
      if (role == Role::kInput) command.inputs.push_back(std::move(word));
      if (role == Role::kWord && !is_descriptor) command.words.push_back(std::move(word));
      role = Role::kWord;
    }
  }
  if (command.words.empty() && command.inputs.empty() && command.inner.empty()) return std::nullopt;
  return command;
}

void CommandReader::Separate(SimpleCommand* command) {
  const char c = text_[at_++];
  if (c == '(') ++command->opened;
  if (c == ')' && command->opened > 0) {
    --command->opened;  // nothing was in it
  } else if (c == ')') {
    ++command->closed;
  }
  if (c == '\n') SkipHereDocuments();
}

CommandReader::Role CommandReader::Redirect() {
  const std::size_t begin = at_;
  while (Holds("<>&|", At(at_))) ++at_;
  const std::string_view sign = std::string_view(text_).substr(begin, at_ - begin);
  if (sign == "<<") {
    if (At(at_) == '-') ++at_;
    return Role::kHereDocument;
  }
  return sign == "<" || sign == "<>" ? Role::kInput : Role::kDropped;
}

void CommandReader::SkipHereDocuments() {
  for (const std::string& last : here_documents_) {
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      const std::size_t tabs = std::min(text_.find_first_not_of('\t', at_), end);
      const bool over = text_.compare(tabs, end - tabs, last) == 0;
      at_ = std::min(end + 1, text_.size());
      if (over) break;
    }
  }
  here_documents_.clear();
}

CommandWord CommandReader::ReadWord(const ShellVariables& variables, SimpleCommand* command) {
  CommandWord word;
  ReadTilde(variables, &word);
  while (!EndsWord(At(at_))) {
    const char c = text_[at_];
    if (c == '\'') {
      const std::size_t end = std::min(text_.find('\'', at_ + 1), text_.size());
      word.text += text_.substr(at_ + 1, end - at_ - 1);
      at_ = std::min(end + 1, text_.size());
    } else if (c == '"') {
      ReadDoubleQuoted(variables, &word, command);
    } else if (c == '\\') {
      if (At(at_ + 1) != '\n' && at_ + 1 < text_.size()) word.text += text_[at_ + 1];
      at_ = std::min(at_ + 2, text_.size());
    } else if (c == '$' || c == '`') {
      ReadDollar(variables, false, &word, command);
    } else {
      // `[` alone is a command, as `]` is its last word.
      if (Holds(kPatterns, c) && !(c == '[' && EndsWord(At(at_ + 1)))) word.plain = false;
      word.text += c;
      ++at_;
      const bool begins_value =
          IsAssignment(word.text) && NameEnd(word.text, 0) + 1 == word.text.size();
      if (begins_value) ReadTilde(variables, &word);
    }
  }
  return word;
}

void CommandReader::ReadDoubleQuoted(const ShellVariables& variables, CommandWord* word,
                                     SimpleCommand* command) {
  for (++at_; at_ < text_.size() && text_[at_] != '"';) {
    const char c = text_[at_];
    if (c == '\\' && Holds("$`\"\\\n", At(at_ + 1))) {
      if (text_[at_ + 1] != '\n') word->text += text_[at_ + 1];
      at_ += 2;
    } else if (c == '$' || c == '`') {
      ReadDollar(variables, true, word, command);
    } else {
      word->text += c;
      ++at_;
    }
  }
  at_ = std::min(at_ + 1, text_.size());
}

void CommandReader::TakeInner(std::size_t begin, std::size_t end, std::size_t after,
                              CommandWord* word, SimpleCommand* command) {
  end = std::min(end, text_.size());
  command->inner.push_back(text_.substr(begin, end - begin));
  word->text += text_.substr(at_, std::min(after, text_.size()) - at_);
  word->plain = false;
  at_ = std::min(after, text_.size());
}

void CommandReader::ReadDollar(const ShellVariables& variables, bool quoted, CommandWord* word,
                               SimpleCommand* command) {
  if (text_[at_] == '`') {
    const std::size_t end = std::min(text_.find('`', at_ + 1), text_.size());
    return TakeInner(at_ + 1, end, end + 1, word, command);
  }
  if (At(at_ + 1) == '(') {
    const std::size_t end = ClosingBracket(text_, at_ + 2);
    return TakeInner(at_ + 2, end, end + 1, word, command);
  }
  const bool braced = At(at_ + 1) == '{';
  const std::size_t begin = at_ + (braced ? 2 : 1);
  const std::size_t name_end = NameEnd(text_, begin);
  const auto value = variables.find(text_.substr(begin, name_end - begin));
  const bool is_known = name_end > begin && (!braced || At(name_end) == '}') &&
                        value != variables.end() &&
                        // Unquoted, a shell would part it into several words.
                        (quoted || value->second.find_first_of(" \t\n*?[") == std::string::npos);
  std::size_t after = name_end;
  if (braced) after = std::min(text_.find('}', name_end), text_.size() - 1) + 1;
  if (is_known) {
    word->text += value->second;
  } else {
    after = std::max(after, at_ + 1);
    word->text += text_.substr(at_, after - at_);
    word->plain = word->plain && after == at_ + 1 && !Holds("$?!#@*-0123456789", At(after));
  }
  at_ = after;
}

void CommandReader::ReadTilde(const ShellVariables& variables, CommandWord* word) {
  if (At(at_) != '~') return;
  const auto home = variables.find("HOME");
  if ((At(at_ + 1) == '/' || EndsWord(At(at_ + 1))) && home != variables.end()) {
    word->text += home->second;
    ++at_;
  } else {
    word->plain = false;  // somebody else's
  }
}

}  // namespace aisle
