#include "harness/cli/typed_command.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "harness/cli/command_line.h"
#include "harness/io/file.h"
#include "harness/io/places.h"

namespace aisle {
namespace {

constexpr std::array kPlaces = {"--into", "--json",   "--json-file", "--out",
                                "-o",     "--output", "--frames-dir"};

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

/// The command that the words choose.
const CLI::App* ChosenBy(const std::vector<std::string>& words, const CLI::App& app) {
  const CLI::App* chosen = &app;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto commands = chosen->get_subcommands({});
    const auto next = std::ranges::find_if(
        commands, [&](const CLI::App* command) { return command->get_name() == words[i]; });
    if (next == commands.end()) break;
    chosen = *next;
  }
  return chosen;
}

/// Whether an option has a value behind it: --json is a file of some commands, a flag of others.
bool TakesValue(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  return option != nullptr && option->get_items_expected_min() > 0;
}

}  // namespace

std::string RepeatableCommand(const std::vector<std::string>& words) {
  CLI::App app;
  Action action;
  AddCommands(&app, &action);
  const CLI::App* chosen = ChosenBy(words, app);
  std::string command = OwnCommand();
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string name = words[i].substr(0, words[i].find('='));
    if (std::find(kPlaces.begin(), kPlaces.end(), name) == kPlaces.end()) {
      command += ' ';
      command += Quoted(words[i]);
    } else if (name == words[i] && TakesValue(*chosen, name)) {
      ++i;  // a word of its own
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
