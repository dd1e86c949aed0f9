#include "simulator/common/yaml_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle::sim {
namespace {

using testing::HasSubstr;

TEST(YamlFaults, KeysAreShownPrintableAndShort) {
  const auto shown = [](const std::string& key) {
    const auto faults = YamlFaults("\"" + key + "\": 1\n\"" + key + "\": 2\n");
    return faults.empty() ? "" : faults.front().key;
  };
  EXPECT_EQ(shown("frames"), "frames");
  EXPECT_EQ(shown("\\e[2J\\e]0;owned\\a"), "\\x1b[2J\\x1b]0;owned\\x07");
  EXPECT_LT(shown(std::string(900, 'k')).size(), 70u);
}

TEST(YamlFaults, AreNotToldWithoutEnd) {
  std::string text;
  for (int i = 0; i < 30'000; ++i) text += "a: 1\n";
  const auto faults = YamlFaults(text);
  ASSERT_EQ(faults.size(), 100u);
  EXPECT_EQ(faults.front().line, 2);
  EXPECT_THAT(faults.back().what, HasSubstr("too many mistakes"));
}

TEST(YamlFaults, ReadingEndsWhereItHasGoneTooFar) {
  std::string wide = "[";
  for (int i = 0; i < 110'000; ++i) wide += "1,";
  const auto values = YamlFaults(wide);  // whose end, which is missing, it does not see
  ASSERT_EQ(values.size(), 1u);
  EXPECT_THAT(values.front().what, HasSubstr("more than 100000 values"));
  const auto levels = YamlFaults(std::string(5000, '['));
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_THAT(levels.front().what, HasSubstr("more than 32 levels"));
}

}  // namespace
}  // namespace aisle::sim
