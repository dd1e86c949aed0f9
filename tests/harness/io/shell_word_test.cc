#include "harness/io/shell_word.h"

#include <gtest/gtest.h>

#include "harness/io/shell_output.h"

namespace aisle {
namespace {

/// What a program that the shell starts is given as its first argument.
std::string Given(const std::string& word) { return RunInShell("printf %s " + word).text; }

TEST(ShellWordTest, TheShellHandsOnTheVeryText) {
  for (const char* text :
       {"out/tonight", "my suites/night.yaml", "it's 5%", "'", "", "$HOME", "`id`", "a;b|c&d", "*",
        "~", "#x", "a\nb", "\"", "\\", "(x)", "{a,b}", "robust.feature.features=800"}) {
    EXPECT_EQ(Given(ShellWord(text)), text);
  }
}

TEST(ShellWordTest, PlainWordsStayAsPeopleTypeThem) {
  for (const char* text : {"out/tonight", "paper,robust", "robust.feature.features=800"}) {
    EXPECT_EQ(ShellWord(text), text);
  }
}

TEST(RunInShell, TakesAllThatIsPrintedAndHowItEnded) {
  const ShellOutput long_one = RunInShell("head -c 10000 /dev/zero | tr '\\0' x; exit 3");
  EXPECT_EQ(long_one.text, std::string(10000, 'x'));
  EXPECT_EQ(WEXITSTATUS(long_one.status), 3);
  EXPECT_EQ(RunInShell("echo aside >&2; true 2>&1").status, 0);
}

}  // namespace
}  // namespace aisle
