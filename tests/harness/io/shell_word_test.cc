#include "harness/io/shell_word.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace aisle {
namespace {

/// What a program that the shell starts is given as its first argument.
std::string Given(const std::string& word) {
  FILE* pipe = ::popen(("printf %s " + word).c_str(), "r");
  std::string given;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) given += static_cast<char>(c);
  ::pclose(pipe);
  return given;
}

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

}  // namespace
}  // namespace aisle
