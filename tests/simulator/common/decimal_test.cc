#include "simulator/common/decimal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle::sim {
namespace {

TEST(NanosecondsOf, ReadsEveryDigitWhateverTheNotation) {
  const std::pair<const char*, std::int64_t> good[] = {
      {"1403715529.112143517", 1403715529112143517},
      {"1.403715529112143517e+09", 1403715529112143517},
      {"1.000000000000000056e-01", 100'000'000},
      {"2.000000000000000111E-01", 200'000'000},
      {"-0.1", -100'000'000},
      {"-1.5", -1'500'000'000},
      {"0.0000000005", 1},
      {"5e-10", 1},
      {"4.9e-10", 0},
      {"0.0000000001", 0},
      {"0.9999999999", 1'000'000'000},
      {"1e-20", 0},
      {"12345e-3", 12'345'000'000},
      {".5", 500'000'000},
      {"+2.", 2'000'000'000},
      {"0e99", 0},
      {"4000000000", 4'000'000'000'000'000'000}};
  for (const auto& [text, expected] : good) EXPECT_EQ(NanosecondsOf(text), expected) << text;
}

TEST(NanosecondsOf, TakesNothingUnclear) {
  for (const char* bad : {"",
                          "-",
                          "+",
                          ".",
                          "e5",
                          "1e",
                          "1e+",
                          "1e+-5",
                          "1e 5",
                          "1e5.0",
                          "1e100",
                          "nan",
                          "inf",
                          "0x10",
                          "1,5",
                          "0,",
                          "1.2.3",
                          "0.200000000zzz",
                          "1.0 ",
                          "--1",
                          "+-1",
                          "1_0",
                          "\xef\xbb\xbf"
                          "1",
                          "1403636579763555584",
                          "4000000001",
                          "1e99",
                          "1e2147483648"}) {
    EXPECT_EQ(NanosecondsOf(bad), std::nullopt) << bad;
  }
  EXPECT_EQ(NanosecondsOf(std::string(100'000, '0')), std::nullopt);
}

TEST(DecimalOf, TakesAllOfTheTextOrNothing) {
  EXPECT_EQ(DecimalOf("1.5"), 1.5);
  EXPECT_EQ(DecimalOf("+2."), 2);
  EXPECT_EQ(DecimalOf("-.5"), -0.5);
  EXPECT_EQ(DecimalOf("1e-3"), 1e-3);
  for (const char* bad : {"", "-", "1.5x", "0-1", "1,5", "nan", "inf", "1e999", "0x10", "+-1"}) {
    EXPECT_EQ(DecimalOf(bad), std::nullopt) << bad;
  }
}

TEST(WordsOf, StandBetweenBlanks) {
  EXPECT_THAT(WordsOf(" a  bc\td\r"), testing::ElementsAre("a", "bc", "d"));
  EXPECT_THAT(WordsOf(" \t"), testing::IsEmpty());
  EXPECT_THAT(WordsOf(""), testing::IsEmpty());
}

}  // namespace
}  // namespace aisle::sim
