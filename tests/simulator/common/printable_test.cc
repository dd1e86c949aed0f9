#include "simulator/common/printable.h"

#include <gtest/gtest.h>

namespace aisle::sim {
namespace {

TEST(Printable, LeavesNothingThatATerminalObeys) {
  EXPECT_EQ(Printable("plain, and Lübeck"), "plain, and Lübeck");
  EXPECT_EQ(Printable("\x1b[2J\n\x7f"), "\\x1b[2J\\x0a\\x7f");
  EXPECT_EQ(Printable("a\xc2\x9b"
                      "31m"),
            "a\\x9b31m");
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(Printable("abcdef", 6), "abcdef");
  EXPECT_EQ(Printable("abcdef", 5), "abcde…");
  EXPECT_EQ(Printable("abcdü.", 5), "abcd…");
  EXPECT_EQ(Printable(std::string(1000, '\xbf'), 10), "…") << "of no character at all";
}

}  // namespace
}  // namespace aisle::sim
