// The shipped schema of suite files, asked by a validator of others.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "harness/campaign/inputs.h"
#include "tests/support/yaml_json.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class SuiteSchemaByOthersTest : public testing::Test {
 protected:
  SuiteSchemaByOthersTest() {
    const nlohmann::json json = nlohmann::json::parse(SuiteSchema(KnownNames()));
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(json), schema_);
  }
  bool Accepts(const YAML::Node& node) const {
    const nlohmann::json document = test::ToJson(node);
    return valijson::Validator().validate(
        schema_, valijson::adapters::NlohmannJsonAdapter(document), nullptr);
  }

 private:
  valijson::Schema schema_;
};

TEST_F(SuiteSchemaByOthersTest, TakesEverySuiteThatIsShipped) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(AISLE_SOURCE_DIR "/scenes/suites")) {
    EXPECT_TRUE(Accepts(YAML::LoadFile(entry.path()))) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 5u);
}

TEST_F(SuiteSchemaByOthersTest, HoldsALimitToTheTwinsThereAre) {
  const std::string start =
      "suite: a\nscenes: [b]\nsystems: [plain]\ntwins: [live, empty]\nlimits: ";
  for (const char* twin : {"live", "empty", "frozen", "none", "low", "mid", "high"}) {
    EXPECT_TRUE(Accepts(YAML::Load(start + "[{score: coverage, min: 1, twin: " + twin + "}]")));
  }
  EXPECT_FALSE(Accepts(YAML::Load(start + "[{score: coverage, min: 1, twin: dead}]")));
  EXPECT_FALSE(Accepts(YAML::Load(start + "[{scores: coverage, min: 1}]")));
}

}  // namespace
}  // namespace aisle
