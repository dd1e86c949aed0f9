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
using testing::HasSubstr;

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
                                " --settings=" + At("set.yaml") + " {output} " + At("none"));
  ASSERT_EQ(named.files.size(), 4u);
  EXPECT_EQ(named.files[0].filename(), "sh");  // found on PATH
  EXPECT_EQ(named.files[1], At("slam.py"));
  EXPECT_EQ(named.files[2], At("words.bin"));
  EXPECT_EQ(named.files[3], At("set.yaml"));
  EXPECT_EQ(named.unseen, "");
}

TEST_F(CommandFilesTest, AProgramIsFoundHoweverAShellIsToldOfIt) {
  const std::string home = home_.string(), run = At("my slam/run");
  const std::string commands[] = {"'" + run + "' {output}",
                                  "\"" + run + "\" --out={output} {dataset}/a {seed}",
                                  home + "/my\\ slam/run {output}",
                                  "~/my\\ slam/run {output}",
                                  "~/'my slam'/run {output}",
                                  "\"$HOME/my slam/run\" {output}",
                                  "\"${HOME}/my slam/run\" {output}",
                                  "A=1 WHERE='my slam' ~/*/run",
                                  "env A=1 ~/*/run",
                                  "{source}'/my slam/run' {output}",
                                  "sh -c '~/\"my slam\"/run {output}'",
                                  "bash -lc \"'" + run + "' {output}\""};
  for (const std::string& command : commands) {
    const CommandFiles named = FilesOf({.command = command, .repository = home});
    const auto is_run = [&](const fs::path& file) { return fs::equivalent(file, run); };
    EXPECT_TRUE(std::any_of(named.files.begin(), named.files.end(), is_run)) << command;
    EXPECT_EQ(named.unseen, "") << command;
  }
}

TEST_F(CommandFilesTest, WhatOnlyAShellAtWorkCanTellIsNotComplete) {
  for (const std::string command : {"$AISLE_NO_SUCH/run {output}",
                                    "cd ~ && ./slam.py",
                                    "`which sh` {output}",
                                    "\"$(pwd)\"/slam.py",
                                    "~somebody_else/run",
                                    "~/none {output}",
                                    "slam.py",
                                    "sh -c 'cd x; ls'",
                                    "sh -c ~/none",
                                    "ls >{output}",
                                    "ls\nls",
                                    "ls $((1 / 0))",
                                    "exec ls",
                                    "A=1",
                                    "",
                                    "(",
                                    ")",
                                    "'",
                                    "\"",
                                    "${",
                                    "`",
                                    "<",
                                    "sh -c 'sh -c \"sh -c'",
                                    "ls \\"}) {
    EXPECT_NE(Of(command).unseen, "") << command;
    EXPECT_NE(WhyUnseen({.command = command}), "") << command;
    EXPECT_EQ(WhyUnseen({.command = command, .depends_on = {"/srv/run"}}), "") << command;
  }
}

TEST_F(CommandFilesTest, AProgramOfEverybodysTellsNothingWithoutAFileOfTheSystems) {
  for (const std::string command :
       {"python3 {dataset} {output}", "cp a {output}", "sh -c", "kill $$", "[ -e y ]", "ls $",
        "env A=1 nice sort", "sh -c 'cat {dataset}/mav0/cam0/data.csv'"}) {
    EXPECT_THAT(Of(command).unseen, HasSubstr("no file of its own")) << command;
  }
  for (const std::string command : {"~/slam.py {dataset}", "cp ~/set.yaml {output}"}) {
    EXPECT_EQ(Of(command).unseen, "") << command;
  }
  // As a virtual environment has it.
  fs::create_symlink(fs::canonical("/bin/sh"), home_ / "python");
  EXPECT_THAT(Of("~/python {output}").unseen, HasSubstr("no file of its own"));
}

TEST_F(CommandFilesTest, WhatALauncherStartsIsUnseenWhateverFilesItIsGiven) {
  for (const char* program : {"docker", "conda", "ros2", "make"}) {
    WriteFileAtomically(home_ / program, "x");
    fs::permissions(home_ / program, fs::perms::owner_all);
  }
  for (const std::string command :
       {"~/docker run slam:latest {dataset}", "~/conda run -n slam python3 ~/slam.py {dataset}",
        "~/ros2 launch slam slam.launch.py", "~/make -f ~/set.yaml run",
        "env A=1 ~/docker run slam", "python3 -m slam {dataset}",
        "python3 -u -m slam --settings ~/set.yaml", "nice python3 -c 'import slam' ~/set.yaml",
        "sh -c 'python3 -m slam --settings ~/set.yaml'"}) {
    EXPECT_THAT(Of(command).unseen, HasSubstr("starts")) << command;
  }
  EXPECT_EQ(Of("python3 ~/slam.py -m 3 -c x").unseen, "") << "the script's own arguments";
}

TEST_F(CommandFilesTest, AFolderIsUnseenWhateverStandsInIt) {
  for (const std::string command :
       {"~/slam.py --config ~/'my slam'", "~/slam.py --config=\"$HOME/my slam\"",
        "LD_LIBRARY_PATH=\"$HOME/my slam\" ~/slam.py", "python3 ~/slam.py . {output}"}) {
    EXPECT_THAT(Of(command).unseen, HasSubstr("folder")) << command;
  }
  // Those that differ between runs are no folders yet.
  EXPECT_EQ(Of("~/slam.py {dataset}/ {dataset}/mav0 --out={output}/../ {output}*").unseen, "");
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
       {"~/my\\ slam/run", "\"$HOME/my slam/run\"", "sh -c '~/\"my slam\"/run'"}) {
    WriteFileAtomically(home_ / "my slam/run", "made yesterday");
    const std::string before = fingerprint(command);
    EXPECT_EQ(fingerprint(command), before) << command;
    WriteFileAtomically(home_ / "my slam/run", "made today");
    EXPECT_NE(fingerprint(command), before) << command;
  }
}

}  // namespace
}  // namespace aisle
