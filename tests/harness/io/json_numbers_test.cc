#include "harness/io/json_numbers.h"

#include <gtest/gtest.h>

#include <limits>

namespace aisle {
namespace {

TEST(JsonNumbers, WhatIsNotFiniteIsNull) {
  using Limits = std::numeric_limits<double>;
  EXPECT_EQ(OrNull(0.1).dump(), "0.1");
  EXPECT_TRUE(OrNull(std::nullopt).is_null());
  EXPECT_TRUE(OrNull(Limits::infinity()).is_null());
  EXPECT_TRUE(OrNull(-Limits::infinity()).is_null());
  EXPECT_TRUE(OrNull(Limits::quiet_NaN()).is_null());
}

TEST(JsonNumbers, ComeBackAsTheyWent) {
  for (const double value : {0.0, -1.0 / 3, std::numeric_limits<double>::denorm_min(), 1e300}) {
    EXPECT_EQ(NumberOrNull(nlohmann::ordered_json::parse(OrNull(value).dump())), value);
  }
  EXPECT_EQ(NumberOrNull(OrNull(std::nullopt)), std::nullopt);
  EXPECT_THROW(NumberOrNull("0.1"), nlohmann::json::type_error);
}

}  // namespace
}  // namespace aisle
