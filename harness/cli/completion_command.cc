// Completion for bash, made from the very options that the parser knows: it cannot fall behind.
#include "harness/cli/command.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/systems.h"

namespace aisle {
namespace {

std::string Joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

std::vector<std::string> NamesOf(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

/// The words an option may be given, where the parser holds it to some: "TEXT:{tum,kitti,euroc}".
std::vector<std::string> ValuesOf(const CLI::Option& option) {
  const std::string name = option.get_lnames().empty() ? "" : option.get_lnames().front();
  if (name == "twin" || name == "twins") return TwinNames();
  std::vector<std::string> values;
  if (name == "system" || name == "systems") {
    for (const System& system : Systems()) values.push_back(system.name);
    return values;
  }
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return values;
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

/// A line of a shell's `case` for every command: what may follow it, and what its options take.
struct Cases {
  std::string words, values;
};

void AddCases(const CLI::App& command, const std::string& path, Cases* cases) {
  std::vector<std::string> words;
  for (const CLI::App* below : command.get_subcommands({})) {
    if (below->get_group().empty()) continue;  // not for people
    words.push_back(below->get_name());
    AddCases(*below, path + below->get_name() + " ", cases);
  }
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string> names = NamesOf(*option), values = ValuesOf(*option);
    words.insert(words.end(), names.begin(), names.end());
    if (names.empty()) words.insert(words.end(), values.begin(), values.end());  // positional
    for (const std::string& name : names) {
      cases->values += fmt::format("    '{}{}') words='{}' ;;\n", path, name, Joined(values));
    }
  }
  cases->words += fmt::format("    '{}') words='{}' ;;\n", path, Joined(words));
}

/// `path` grows with the commands on the line: "", "bench ", "bench render ".
constexpr const char* kScript =
    R"bash(# Completion of aisle for bash: eval "$(./aisle completion bash)"
_aisle_words() {{
  case $1 in
{0}  esac
}}
_aisle_values() {{
  case $1 in
{1}  esac
}}
_aisle() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
  local path= word words= commands i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${{COMP_WORDS[i]}}
    _aisle_words "$path"
    case " $words " in
      *" $word "*) [[ $word == -* ]] || path+="$word " ;;
    esac
  done
  words=
  _aisle_values "$path$previous"
  if [ -z "$words" ]; then
    _aisle_words "$path"
    if [[ $current != -* ]]; then
      commands=
      for word in $words; do [[ $word == -* ]] || commands+="$word "; done
      words=$commands
    fi
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  [ -n "$words" ] || COMPREPLY=($(compgen -f -- "$current"))
}}
complete -o filenames -F _aisle aisle ./aisle
)bash";

std::string BashScript(const CLI::App& app) {
  Cases cases;
  AddCases(app, "", &cases);
  return fmt::format(fmt::runtime(kScript), cases.words, cases.values);
}

}  // namespace

void AddCompletionCommand(CLI::App* app, Action* action) {
  CLI::App* command =
      app->add_subcommand("completion", "Print the script that completes commands in bash");
  const auto shell = std::make_shared<std::string>("bash");
  command->add_option("SHELL", *shell, "Shell to complete in; default: bash")
      ->check(CLI::IsMember({"bash"}));
  command->footer("Example: eval \"$(./aisle completion bash)\"");
  command->callback([app, action, shell] {  // `shell` is where the parser puts the word
    *action = [app] {
      fmt::print("{}", BashScript(*app));
      return kAllPassed;
    };
  });
}

}  // namespace aisle
