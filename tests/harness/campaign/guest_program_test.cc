#include "harness/campaign/guest_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::string Missing(const std::string& command, const std::string& repository = "") {
  return MissingProgram({.command = command, .repository = repository});
}

TEST(MissingProgramTest, WhatAShellCanStartIsThere) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_guest_{}", ::getpid());
  WriteFileAtomically(folder / "slam", "#!/bin/sh\n");
  fs::permissions(folder / "slam", fs::perms::owner_all);
  for (const std::string command :
       {"cp a {output}", "cd /srv && ./slam {output}", "A=1 B=/x/y sh slam.sh",
        "test -e x && cp a b", "if true; then x; fi", "echo 0 > {output}", "(x)",
        "\"/a b/slam\" {output}", "$SLAM {output}", "true;x"}) {
    EXPECT_EQ(Missing(command), "") << command;
  }
  EXPECT_EQ(Missing(folder.string() + "/slam {output}"), "");
  EXPECT_EQ(Missing("{source}/slam {output}", folder.string()), "");
  fs::remove_all(folder);
}

TEST(MissingProgramTest, WhatItCannotStartIsNamed) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_guest_{}", ::getpid());
  WriteFileAtomically(folder / "slam", "no program: nobody may start it");
  const std::string slam = (folder / "slam").string();
  EXPECT_EQ(Missing("no_such_slam {output}"), "no_such_slam");
  EXPECT_EQ(Missing("  A=1 no_such_slam>x"), "no_such_slam");
  EXPECT_EQ(Missing("/no/such/slam {output}"), "/no/such/slam");
  EXPECT_EQ(Missing(slam), slam);
  EXPECT_EQ(Missing("{source}/none {output}", folder.string()), folder.string() + "/none");
  EXPECT_EQ(Missing("-v x"), "-v") << "no option of ours";
  fs::remove_all(folder);
}

TEST(NotesOfSystemsTest, NameTheSystemAndTheProgram) {
  const fs::path own = fs::temp_directory_path() / fmt::format("aisle_notes_{}", ::getpid());
  WriteFileAtomically(own, "");
  Suite suite;
  suite.systems = {
      BuiltIn("robust"),
      {.name = "mine", .external = ExternalSystem{.command = "no_such_slam {output}"}},
      {.name = "copy", .external = ExternalSystem{.command = "cp " + own.string() + " {output}"}}};
  suite.systems.push_back(
      {.name = "told",
       .external = ExternalSystem{.command = "$NO_SUCH_SLAM {output}", .depends_on = {"a.out"}}});
  suite.systems.push_back(
      {.name = "untold", .external = ExternalSystem{.command = "$NO_SUCH_SLAM {output}"}});
  suite.systems.push_back(
      {.name = "module", .external = ExternalSystem{.command = "env python3 -m slam {output}"}});
  const std::vector<std::string> notes = NotesOfSystems(suite);
  fs::remove(own);
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_THAT(notes[1], testing::StartsWith("--resume repeats the runs of untold: only a shell"));
  EXPECT_THAT(notes[2], testing::StartsWith("--resume repeats the runs of module: what python3 "));
  EXPECT_THAT(notes[0], testing::StartsWith("system 'mine': "));
  EXPECT_THAT(notes[0], testing::HasSubstr("no_such_slam"));
}

}  // namespace
}  // namespace aisle
