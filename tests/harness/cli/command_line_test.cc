// What arguments lead to, without starting the program.
#include "harness/cli/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/io/file.h"
#include "harness/record/results.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The exit code of `aisle WORDS...`; what it says goes to `said`.
int Exit(std::vector<std::string> words, std::string* said = nullptr) {
  words.insert(words.begin(), "aisle");
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = RunCommandLine(static_cast<int>(argv.size()), argv.data());
  const std::string text =
      testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  if (said != nullptr) *said = text;
  return code;
}

/// The commands that `words` choose, outermost first; empty where they are refused.
std::vector<std::string> Chosen(const std::string& words, Action* action) {
  CLI::App app;
  app.require_subcommand(1);
  AddCommands(&app, action);
  try {
    app.parse(words);
  } catch (const CLI::ParseError&) {
    return {};
  }
  std::vector<std::string> names;
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    names.push_back(at->get_name());
  }
  return names;
}

TEST(CommandLineTest, ACommandThatIsChosenLeavesSomethingToDo) {
  for (const std::string words :
       {"report out", "compare a b", "check a.yaml", "bench slam", "rerun a/b/c/1 --in out"}) {
    Action action;
    EXPECT_EQ(Chosen(words, &action).front(), words.substr(0, words.find(' ')));
    EXPECT_TRUE(action) << words;
  }
}

TEST(CommandLineTest, ABenchIsACommandOfItsOwn) {
  Action action;
TEST(CommandLineTest, AssetsThatAreNowhereAreOneErrorWhereverTheyAreAskedFor) {
  const char* before = std::getenv("AISLE_ASSETS");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("AISLE_ASSETS", "/no/such/folder", 1);
  std::string said;
  EXPECT_EQ(Exit({"run", "quickstart"}, &said), kBadInput);  // looked up while arguments are read
  EXPECT_THAT(said, HasSubstr("set AISLE_ASSETS"));
  before == nullptr ? ::unsetenv("AISLE_ASSETS") : ::setenv("AISLE_ASSETS", kept.c_str(), 1);
}

  EXPECT_THAT(Chosen("bench dynamic paper/scene2:90-130 --warm-up 3", &action),
              testing::ElementsAre("bench", "dynamic"));
}

TEST(CommandLineTest, WhatIsRefusedLeavesNothingToDo) {
  for (const char* words : {"", "nonsense", "bench", "bench dynamic --every 0", "compare a",
                            "bench dynamic --debug-dynamic", "report"}) {
    Action action;
    EXPECT_TRUE(Chosen(words, &action).empty()) << words;
    EXPECT_FALSE(action) << words;
  }
}

TEST(CommandLineTest, HelpIsNoErrorAndWrongUsageIs) {
  std::string said;
  EXPECT_EQ(Exit({"--help"}, &said), kAllPassed);
  EXPECT_THAT(said, HasSubstr("Exit codes: 0 all passed"));
  EXPECT_EQ(Exit({"--version"}), kAllPassed);
  EXPECT_EQ(Exit({"bench", "slam", "--help"}), kAllPassed);
  EXPECT_EQ(Exit({}), kBadInput);
  EXPECT_EQ(Exit({"nonsense"}), kBadInput);
  EXPECT_EQ(Exit({"bench", "slam", "--laps", "0"}), kBadInput);
}

TEST(CommandLineTest, BadFilesAreBadInputAndAreNamed) {
  std::string said;
  EXPECT_EQ(Exit({"report", "/nowhere/at/all"}, &said), kBadInput);
  EXPECT_EQ(said, "aisle: /nowhere/at/all/results.json: no such file\n");
  EXPECT_EQ(Exit({"check", "/nowhere/at/all.yaml"}, &said), kBadInput);
  EXPECT_THAT(said, HasSubstr("/nowhere/at/all.yaml"));
  EXPECT_EQ(Exit({"bench", "dynamic", "paper/scene2:9-3"}, &said), kBadInput);
  EXPECT_THAT(said, HasSubstr("paper/scene2:9-3: expected SOURCE:FROM-TO"));
}

TEST(CommandLineTest, ABrokenVerdictIsTheExitCodeOfAReport) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_cli_{}", ::getpid());
  const auto code_of = [&](bool passed) {
    Results results;
    results.suite = "nightly";
    results.verdicts = {{.name = "a limit", .passed = passed, .why = "so"}};
    WriteFileAtomically(folder / "results.json", ToJson(results));
    return Exit({"report", folder.string()});
  };
  EXPECT_EQ(code_of(true), kAllPassed);
  EXPECT_EQ(code_of(false), kVerdictFailed);
  fs::remove_all(folder);
}

TEST(CommandLineTest, NothingToCompareIsSaid) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_cli_none_{}", ::getpid());
  WriteFileAtomically(folder / "results.json", ToJson(Results{}));
  EXPECT_EQ(Exit({"compare", folder.string(), folder.string()}), kNothingToDo);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace aisle
