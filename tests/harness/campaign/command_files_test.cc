#include "harness/campaign/command_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "harness/campaign/job.h"
#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

/// A home with programs in it, one of which has a space in its name.
class CommandFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    home_ = fs::temp_directory_path() / fmt::format("aisle_named_{}", ::getpid());
    for (const char* file : {"slam.py", "words.bin", "set.yaml", "my slam/run"}) {
      WriteFileAtomically(home_ / file, "x");
      fs::permissions(home_ / file, fs::perms::owner_all);
    }
    if (const char* home = std::getenv("HOME")) old_home_ = home;
    ::setenv("HOME", home_.c_str(), 1);
  }
  void TearDown() override {
    ::setenv("HOME", old_home_.c_str(), 1);
    RemoveFolder(home_);
  }

  std::string At(const std::string& file) const { return (home_ / file).string(); }
  static CommandFiles Of(const std::string& command) { return FilesOf({.command = command}); }

  fs::path home_;
  std::string old_home_;
};

TEST_F(CommandFilesTest, WordsAndTheValuesBehindKeysAreFiles) {
  const CommandFiles named = Of("sh '" + At("slam.py") + "' vocabulary:" + At("words.bin") +
                                " --settings=" + At("set.yaml") + " {output}; sh " + At("none"));
  ASSERT_EQ(named.files.size(), 4u);
  EXPECT_EQ(named.files[0].filename(), "sh");  // found on PATH
  EXPECT_EQ(named.files[1], At("slam.py"));
  EXPECT_EQ(named.files[2], At("words.bin"));
  EXPECT_EQ(named.files[3], At("set.yaml"));
  EXPECT_THAT(named.unknown, IsEmpty());
}

TEST_F(CommandFilesTest, AProgramIsFoundHoweverAShellIsToldOfIt) {
  const std::string home = home_.string(), run = At("my slam/run");
  const std::string commands[] = {
      "'" + run + "' {output}",
      "\"" + run + "\" {output}",
      home + "/my\\ slam/run {output}",
      "~/my\\ slam/run {output}",
      "~/'my slam'/run {output}",
      "\"$HOME/my slam/run\" {output}",
      "\"${HOME}/my slam/run\" {output}",
      "cd '" + home + "/my slam' && ./run {output}",
      "cd ~/'my slam' && \"$PWD\"/run {output}",
      "cd && cd 'my slam' && ./run",
      "cd -P -- 'no such' || (cd ~/'my slam' && exec ./run)",
      "A=1 WHERE='my slam'; ~/\"$WHERE\"/run",
      "sh -c 'cd ~/\"my slam\" && ./run {output}'",
      "bash -lc \"'" + run + "' {output}\"",
      "eval '\"$HOME/my slam/run\"'",
      "if test -e {output}; then true; else ~/my\\ slam/run; fi",
      "cat <<END >{output} # that's \"all\nno'thing (of\nEND\n~/my\\ slam/run 2>/dev/null",
      "(cd /; true) && { echo \"$(date)\"; ~/my\\ slam/run; } >{output}"};
  for (const std::string& command : commands) {
    const CommandFiles named = Of(command);
    const auto is_run = [&](const fs::path& file) { return fs::equivalent(file, run); };
    EXPECT_TRUE(std::any_of(named.files.begin(), named.files.end(), is_run)) << command;
    EXPECT_THAT(named.unknown, IsEmpty()) << command;
  }
}

TEST_F(CommandFilesTest, AProgramThatOnlyAShellAtWorkCanFindIsUnknown) {
  const std::pair<std::string, std::string> commands[] = {
      {"$AISLE_NO_SUCH/run {output}", "$AISLE_NO_SUCH/run"},
      {"\"$TMPDIR\"/run", "$TMPDIR/run"},
      {"cd \"$(pwd)\" && ./run", "./run"},
      {"(cd ~) && ./run", "./run"},
      {"`which run` {output}", "`which run`"},
      {"~/*/run", At("*/run")},
      {"~somebody/run", "~somebody/run"},
      {"true && ~/none {output}", At("none")},
      {"sh -c 'cd /no/such && ./run'", "./run"},
      {"HOME=$AISLE_NO_SUCH; ~/slam.py", "~/slam.py"},
      {"PATH=/no/such; ls", "ls"}};
  for (const auto& [command, unknown] : commands) {
    const CommandFiles named = Of(command);
    ASSERT_EQ(named.unknown.size(), 1u) << command;
    EXPECT_EQ(named.unknown[0], unknown) << command;
    EXPECT_EQ(UnknownProgram({.command = command}), named.unknown[0]);
    EXPECT_EQ(UnknownProgram({.command = command, .depends_on = {"/srv/run"}}), "");
  }
}

TEST_F(CommandFilesTest, WhatAShellKnowsItselfOrFindsIsKnown) {
  for (const char* command :
       {"cp a {output}", "python3 -m slam {dataset}", "test -e x && [ -e y ] && cp a b",
        "for f in a b; do echo $f; done", "export A=1; : \"$A\"; exit $?", "A=1 B=/x/y sh slam.sh",
        "yes | head -c 3 >{output}; true {output}", "kill -SEGV $$ # {output}",
        "case a in b) true;; esac"}) {
    EXPECT_THAT(Of(command).unknown, IsEmpty()) << command;
  }
}

TEST_F(CommandFilesTest, ACommandThatIsNoneComesToAnEnd) {
  for (const std::string command : {"",
                                    "(",
                                    ")",
                                    "'",
                                    "\"",
                                    "$(",
                                    "`",
                                    "${",
                                    "\\",
                                    "$",
                                    "<",
                                    "<<",
                                    "<<a\nb",
                                    "cd",
                                    "sh -c",
                                    "eval",
                                    "sh -c 'sh -c \"sh -c'",
                                    "~",
                                    "a=~",
                                    "#"}) {
    EXPECT_LE(Of(command).files.size(), 1u) << command;
  }
  EXPECT_THAT(Of(std::string("ls \0 ls", 7)).unknown, IsEmpty());
}

TEST_F(CommandFilesTest, WhatItReadsCountsAndWhatItWritesDoesNot) {
  EXPECT_THAT(Of("true <~/set.yaml").files, Contains(fs::path(At("set.yaml"))));
  EXPECT_THAT(Of("true >~/set.yaml 2>>~/words.bin").files,
              testing::Not(testing::Contains(
                  testing::AnyOf(fs::path(At("set.yaml")), fs::path(At("words.bin"))))));
}

TEST_F(CommandFilesTest, VariablesAreThoseThatTheSystemSees) {
  ::setenv("AISLE_TEST_SLAM", home_.c_str(), 1);
  const std::string command = "$AISLE_TEST_SLAM/slam.py {output}";
  EXPECT_THAT(FilesOf({.command = command}).unknown, ElementsAre("$AISLE_TEST_SLAM/slam.py"));
  EXPECT_THAT(FilesOf({.command = command, .environment = {"AISLE_TEST_SLAM"}}).files,
              ElementsAre(fs::path(At("slam.py"))));
  ::unsetenv("AISLE_TEST_SLAM");
}

TEST_F(CommandFilesTest, ARebuiltProgramIsAnotherSystem) {
  const auto fingerprint = [](const std::string& command) {
    return Fingerprints().Run({.scene = "smoke/short",
                               .scene_file = AISLE_SOURCE_DIR "/scenes/smoke/short.yaml",
                               .twin = "live",
                               .system = {.name = "mine",
                                          .like = "",
                                          .options = {},
                                          .mask_errors = {},
                                          .external = ExternalSystem{.command = command}},
                               .seed = 1});
  };
  for (const std::string command :
       {"~/my\\ slam/run", "\"$HOME/my slam/run\"", "cd ~/'my slam' && ./run"}) {
    WriteFileAtomically(home_ / "my slam/run", "made yesterday");
    const std::string before = fingerprint(command);
    EXPECT_EQ(fingerprint(command), before) << command;
    WriteFileAtomically(home_ / "my slam/run", "made today");
    EXPECT_NE(fingerprint(command), before) << command;
  }
}

}  // namespace
}  // namespace aisle
