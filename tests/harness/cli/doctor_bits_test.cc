#include "harness/cli/doctor_bits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

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

TEST(DoctorBitsTest, AListThatIsNoneIsToldByItsName) {
  const std::string file = testing::TempDir() + "bits.json";
  DoctorBitsOptions options;
  options.against = file;
  const auto expect_told = [&](const std::string& text) {
    WriteFileAtomically(file, text);
    EXPECT_THAT([&] { DoctorBits(options); },
                testing::ThrowsMessage<InputError>(
                    testing::StartsWith(file + ": not a list of hashes by processor")))
        << text;
  };
  expect_told("{");
  expect_told("{}");
  expect_told(R"({"makes": [1]})");
  expect_told(R"({"makes": {"a processor": {"commit": 7, "stages": {}}}})");
  expect_told(R"({"makes": {"a processor": {"commit": "a1"}}})");
  expect_told(R"({"makes": {"a processor": {"commit": "a1", "stages": {"flow": 7}}}})");
}

}  // namespace
}  // namespace aisle
