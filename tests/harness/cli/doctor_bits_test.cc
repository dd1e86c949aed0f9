#include "harness/cli/doctor_bits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;

const BitsOfMake kOwn{.commit = "a1", .stages = {{"triangles", "00"}, {"static light", "11"}}};

TEST(HoldAgainstTest, OneProgramThatComputesOtherwiseElsewhereFails) {
  BitsOfMake known = kOwn;
  EXPECT_FALSE(HoldAgainst(kOwn, known).differs);
  known.stages[1].second = "12";
  const BitsVerdict verdict = HoldAgainst(kOwn, known);
  EXPECT_TRUE(verdict.differs);
  EXPECT_EQ(verdict.said, "first stage that differs: static light");
}

TEST(HoldAgainstTest, AnotherProgramIsNotComparableButMayBeEqual) {
  BitsOfMake known = kOwn;
  known.commit = "a0";
  EXPECT_EQ(HoldAgainst(kOwn, known).said, "all stages equal");
  known.stages[1].second = "12";
  const BitsVerdict verdict = HoldAgainst(kOwn, known);
  EXPECT_FALSE(verdict.differs);
  EXPECT_THAT(verdict.said, HasSubstr("not comparable from stage static light on"));
}

TEST(HoldAgainstTest, StagesThatOneLacksAreNotAsked) {
  BitsOfMake known = kOwn;
  known.stages = {{"static light", "11"}, {"trajectory", "22"}};
  EXPECT_EQ(HoldAgainst(kOwn, known).said, "all stages equal");
}

}  // namespace
}  // namespace aisle
