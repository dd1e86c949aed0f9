#include "harness/io/json_text.h"

#include <gtest/gtest.h>

#include <chrono>

namespace aisle {
namespace {

TEST(JsonText, HoldsWhatTheTextDoes) {
  const nlohmann::ordered_json json = ParseJson(R"({"b": [1, -2.5, {"z": null}], "a": "x"})");
  EXPECT_EQ(json.dump(), R"({"a":"x","b":[1,-2.5,{"z":null}]})");
  EXPECT_TRUE(json.at("b").at(0).is_number_unsigned());
  EXPECT_THROW(ParseJson("{\"a\": "), nlohmann::json::parse_error);
}

/// Each held against all before it, they would take a minute and more.
TEST(JsonText, ManyKeysTakeLittleTime) {
  std::string text = "{";
  constexpr int kKeys = 200'000;
  for (int i = 0; i < kKeys; ++i) text += fmt::format("{}\"artifact_{}\":1", i > 0 ? "," : "", i);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(ParseJson(text + "}").size(), kKeys);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(JsonText, NestingHasAnEnd) {
  const auto nested = [](std::size_t levels) {
    return std::string(levels, '[') + std::string(levels, ']');
  };
  EXPECT_NO_THROW(ParseJson(nested(64)));
  EXPECT_THROW(ParseJson(nested(100)), std::invalid_argument);
  EXPECT_THROW(ParseJson(nested(1'000'000)), std::invalid_argument);
}

}  // namespace
}  // namespace aisle
