#include "slam/common/nearest_name.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

TEST(DidYouMean, NamesTheNearestOrNothing) {
  const std::vector<std::string> names = {"feature.levels", "feature.scale", "robust.field.memory"};
  EXPECT_EQ(DidYouMean("feature.level", names), "; did you mean feature.levels?");
  EXPECT_EQ(DidYouMean("featur.scael", names), "; did you mean feature.scale?");
  EXPECT_EQ(DidYouMean("zebra", names), "");
  EXPECT_EQ(DidYouMean("", names), "");
}

TEST(DidYouMean, KnowsTheLastPartsOfALongerName) {
  const std::vector<std::string> names = {"feature.levels", "robust.field.memory"};
  EXPECT_EQ(DidYouMean("memory", names), "; did you mean robust.field.memory?");
  EXPECT_EQ(DidYouMean("field.memori", names), "; did you mean robust.field.memory?");
}

}  // namespace
}  // namespace aisle::slam
