#include "harness/report/markup/html.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

TEST(EscapeTest, MarkupAndBrokenBytesAreHarmless) {
  EXPECT_EQ(Escape("<a b=\"c\">&'"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;");
  EXPECT_EQ(Escape("\xff\x01ü"), "\xEF\xBF\xBD\xEF\xBF\xBDü");
  EXPECT_EQ(EscapeUrl("a b/<c>\n"), "a%20b/%3Cc%3E%0A");
}

}  // namespace
}  // namespace aisle
