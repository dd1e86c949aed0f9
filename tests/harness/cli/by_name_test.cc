#include "harness/cli/by_name.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

std::string Named(const CLI::Validator& rule, std::string word) {
  EXPECT_EQ(rule(word), "");
  return word;
}

TEST(ByNameTest, WhereNoFolderIsTakenTheSuiteComesFirst) {
  EXPECT_TRUE(Named(ByName(), "smoke").ends_with("scenes/smoke"));
  EXPECT_TRUE(Named(SuiteByName(), "smoke").ends_with("scenes/suites/smoke.yaml"));
  EXPECT_TRUE(Named(SuiteByName(), "smoke/short").ends_with("scenes/smoke/short.yaml"));
  EXPECT_EQ(Named(SuiteByName(), "no/such/scene"), "no/such/scene");
  EXPECT_EQ(Named(SuiteByName(), ""), "");
}

}  // namespace
}  // namespace aisle
