// Completion for bash, made from the very options that the parser knows: it cannot fall behind.
#include "harness/cli/command.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/systems.h"

namespace aisle {
namespace {

std::string Words(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) words += " --" + name;
    for (const std::string& name : option->get_snames()) words += " -" + name;
  }
  return words.empty() ? words : words.substr(1);
}

std::string SystemNames() {
  std::string names;
  for (const System& system : Systems()) names += (names.empty() ? "" : " ") + system.name;
  return names;
}

std::string BashScript(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_group().empty()) continue;  // not for people
    commands += (commands.empty() ? "" : " ") + command->get_name();
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), Words(*command));
  }
  return "# Completion of aisle for bash: eval \"$(./aisle completion bash)\"\n"
         "_aisle() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} words=\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \"" +
         commands +
         "\" -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  case $previous in\n"
         "    --system|--systems) COMPREPLY=($(compgen -W \"" +
         SystemNames() +
         "\" -- \"$current\")); return ;;\n"
         "    --twin|--twins) COMPREPLY=($(compgen -W \"" +
         fmt::format("{}", fmt::join(TwinNames(), " ")) +
         "\" -- \"$current\")); return ;;\n"
         "  esac\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "  case $current in\n"
         "    -*) COMPREPLY=($(compgen -W \"$words\" -- \"$current\")) ;;\n"
         "    *) COMPREPLY=($(compgen -f -- \"$current\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -o filenames -F _aisle aisle ./aisle\n";
}

}  // namespace

void AddCompletionCommand(CLI::App* app, Action* action) {
  CLI::App* command = app->add_subcommand("completion", "completion of this program for bash");
  const auto shell = std::make_shared<std::string>("bash");
  command->add_option("SHELL", *shell, "bash")->check(CLI::IsMember({"bash"}));
  command->footer("Example: eval \"$(./aisle completion bash)\"");
  command->callback([=] {
    *action = [=] {
      fmt::print("{}", BashScript(*app));
      return kAllPassed;
    };
  });
}

}  // namespace aisle
