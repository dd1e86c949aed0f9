#include "harness/cli/command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <new>
#include <span>

#include "harness/cli/cluster_commands.h"
#include "harness/cli/help_format.h"
#include "harness/cli/terminal.h"
#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"
#include "harness/io/places.h"
#include "harness/record/provenance.h"

namespace aisle {

namespace {

/// What is wrong with the word where a command is expected: nothing where it is one, or an option.
std::string NoCommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> shown;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == word) return "";
    if (!command->get_group().empty()) shown.push_back(command->get_name());
  }
  if (word.starts_with("-")) return "";
  return fmt::format("unknown command '{}'{}", Printable(word), DidYouMean(word, shown));
}

/// What is wrong with the first word that is meant for an option and is none of the command that
/// the line chose; nothing where there is no such word.
std::string NoOption(const CLI::App& app, std::span<const char* const> words) {
  const CLI::App* chosen = &app;
  std::string names;
  while (!chosen->get_subcommands().empty()) {
    chosen = chosen->get_subcommands().front();
    names += (names.empty() ? "" : " ") + chosen->get_name();
  }
  std::vector<std::string> known;
  for (const CLI::Option* option : chosen->get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back(name);
  }
  for (const std::string word : words) {
    if (word == "--") break;  // what follows is for no option
    if (!word.starts_with("--")) continue;
    const std::string name = word.substr(2, word.find('=') - 2);
    if (name.empty() || std::ranges::find(known, name) != known.end()) continue;
    const std::string near = NearestWord(name, known);
    return fmt::format("unknown option '--{}' for '{}'{}", Printable(name), names,
                       near.empty() ? "" : " (did you mean --" + near + "?)");
  }
  return "";
}

/// Examples speak of the launcher of a tree; an installed program is called by its name.
void NameInExamples(CLI::App* app, const std::string& name) {
  std::string footer = app->get_footer();
  for (std::size_t at = 0; (at = footer.find("./aisle", at)) != std::string::npos;) {
    footer.replace(at, std::string("./aisle").size(), name);
    at += name.size();
  }
  app->footer(footer);
  for (CLI::App* command : app->get_subcommands({})) NameInExamples(command, name);
}

/// A plain decimal number that is all of the text, as in suites; nothing else is one.
template <class T>
std::errc TakeWhole(const std::string& text, T* value) {
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, *value);
  return error == std::errc() && rest != end ? std::errc::invalid_argument : error;
}

/// What is not a number passes every range, since no comparison with it holds.
std::string NotFinite(std::string& text) {
  double value = 0;
  if (TakeWhole(text, &value) == std::errc() && std::isfinite(value)) return "";
  return fmt::format("expected a finite number, got '{}'", Printable(text));
}

/// Read as C reads them, 010 is 8, and of counts -1 and what is too large are other numbers: they
/// are handed on without zeros in front.
template <class Whole>
std::string NotWhole(std::string& text) {
  using Limits = std::numeric_limits<Whole>;
  Whole value = 0;
  const std::errc wrong = TakeWhole(text, &value);
  if (wrong != std::errc()) {
    const bool tell_range = !Limits::is_signed || wrong == std::errc::result_out_of_range;
    const std::string range = fmt::format(" in [{}, {}]", Limits::min(), Limits::max());
    return fmt::format("expected an integer{}, got '{}'", tell_range ? range : "", Printable(text));
  }
  text = fmt::format("{}", value);
  return "";
}

/// Every option of all commands that takes such a number, before its own range is asked.
void AskForPlainNumbers(CLI::App* app) {
  for (CLI::Option* option : app->get_options()) {
    const std::string type = option->get_type_name();
    const auto ask = [&](std::string (*wrong)(std::string&)) {
      option->transform(CLI::Validator(wrong, ""));
    };
    if (type.starts_with("FLOAT")) ask(NotFinite);
    if (type.starts_with("UINT")) ask(NotWhole<std::uint64_t>);
    if (type.starts_with("INT")) ask(NotWhole<std::int64_t>);
  }
  for (CLI::App* command : app->get_subcommands({})) AskForPlainNumbers(command);
}

}  // namespace

void AddCommands(CLI::App* app, Action* action) {
  AddRunCommand(app, action);
  AddRunOneCommand(app, action);
  AddRunTaskCommand(app, action);
  AddRerunCommand(app, action);
  AddMergeCommand(app, action);
  AddStatusCommand(app, action);
  AddImportMeshCommand(app, action);
  AddPreviewCommand(app, action);
  AddGalleryCommand(app, action);
  AddRenderCommand(app, action);
  AddSlamCommand(app, action);
  AddVocabularyCommand(app, action);
  AddBenchCommand(app, action);
  AddSystemsCommand(app, action);
  AddScoreCommand(app, action);
  AddScoresCommand(app, action);
  AddReportCommand(app, action);
  AddCompareCommand(app, action);
  AddBaselineCommand(app, action);
  AddBisectCommand(app, action);
  AddCheckCommand(app, action);
  AddDoctorCommand(app, action);
  AddCompletionCommand(app, action);
  AskForPlainNumbers(app);
}

int RunCommandLine(int argc, const char* const* argv) {
  CLI::App app{"aisle: simulation-in-the-loop tests for stereo visual SLAM in dynamic scenes"};
  app.name("aisle");
  app.formatter(std::make_shared<HelpFormat>(LookOfStdout().width));  // handed down to commands
  app.set_version_flag("--version", [] {
    const Provenance own = OwnProvenance();
    return fmt::format("aisle {} ({})", own.version, own.commit);
  });
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all passed, 1 a verdict failed, 2 interrupted (can be resumed), 3 internal "
      "error or\n            machine failure, 4 wrong usage or input, 5 nothing "
      "selected.\nExample: ./aisle run scenes/suites/quickstart.yaml");
  Action action;
  AddCommands(&app, &action);
  NameInExamples(&app, OwnCommand());
  try {
    app.parse(argc, argv);
    return action();
  } catch (const CLI::ParseError& error) {
    std::string wrong = argc > 1 ? NoCommand(app, argv[1]) : "";
    if (wrong.empty() && dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
      wrong = NoOption(app, {argv + 1, argv + argc});
    }
    if (!wrong.empty()) {
      fmt::print(stderr, "{}\nRun with --help for more information.\n", wrong);
      return kBadInput;
    }
    return app.exit(error) == 0 ? kAllPassed : kBadInput;  // --help is no error
  } catch (const InputError& error) {
    fmt::print(stderr, "aisle: {}\n", error.what());
    return kBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    const std::error_code code = error.code();
    const bool impossible = code == std::errc::filename_too_long ||
                            code == std::errc::not_a_directory ||
                            code == std::errc::too_many_symbolic_link_levels;
    fmt::print(stderr, "aisle: {}: {}\n", Printable(error.path1().string(), 80), code.message());
    return impossible ? kBadInput : kOwnFailure;  // a name that no file can have was given to us
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "aisle: out of memory\n");
    return kOwnFailure;
  } catch (const std::exception& error) {
    fmt::print(stderr, "aisle: {}\n", error.what());
    return kOwnFailure;
  }
}

}  // namespace aisle
