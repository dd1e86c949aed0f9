#include "harness/cli/typed_command.h"

#include <array>
#include <sstream>

#include "harness/io/file.h"
#include "harness/io/places.h"

namespace aisle {
namespace {

constexpr std::array kPlaces = {"--into", "--json", "--out", "--frames-dir", "--threads"};

std::string Quoted(const std::string& word) {
  const bool plain = word.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                         "_-./:=,@+%") == std::string::npos;
  if (plain && !word.empty()) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') quoted += "'\\'";  // closes, a quote by itself, and opens again
    quoted += c;
  }
  quoted += '\'';
  return quoted;
}

}  // namespace

std::string RepeatableCommand(const std::vector<std::string>& words) {
  std::string command = OwnCommand();
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string name = words[i].substr(0, words[i].find('='));
    if (std::find(kPlaces.begin(), kPlaces.end(), name) == kPlaces.end()) {
      command += ' ';
      command += Quoted(words[i]);
    } else if (name == words[i]) {
      ++i;  // its value is a word of its own
    }
  }
  return command;
}

std::string TypedCommand() {
  std::istringstream line(ReadFile("/proc/self/cmdline"));  // words, each ended by a zero
  std::vector<std::string> words;
  for (std::string word; std::getline(line, word, '\0');) words.push_back(word);
  return RepeatableCommand(words);
}

}  // namespace aisle
