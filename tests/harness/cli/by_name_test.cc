#include "harness/cli/by_name.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/input_error.h"

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

std::string WhyNot(const std::string& word) {
  try {
    CheckAreThere({word});
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "";
}

TEST(ByNameTest, WhatIsNowhereIsToldWithTheNameThatIsNear) {
  EXPECT_EQ(WhyNot(AISLE_SOURCE_DIR "/scenes/suites/smoke.yaml"), "");
  EXPECT_EQ(WhyNot("smok"), "smok: no such file, scene or suite (did you mean smoke?)");
  EXPECT_THAT(WhyNot("paper/scene22.yaml"), testing::HasSubstr("(did you mean paper/scene2?)"));
  EXPECT_EQ(WhyNot("/nowhere/smok"), "/nowhere/smok: no such file");
}

}  // namespace
}  // namespace aisle
