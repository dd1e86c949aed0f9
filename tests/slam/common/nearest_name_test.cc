#include "slam/common/nearest_name.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

TEST(EditDistance, CountsInsertedDroppedAndReplacedLetters) {
  EXPECT_EQ(EditDistance("", ""), 0);
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("memory", "memroy"), 2);
}

TEST(EditDistance, IsAMetric) {
  const std::vector<std::string> words = {"", "a", "levels", "level", "scale", "lvels", "scales"};
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      EXPECT_EQ(EditDistance(a, b), EditDistance(b, a));
      EXPECT_EQ(EditDistance(a, b) == 0, a == b);
      for (const std::string& c : words) {
        EXPECT_LE(EditDistance(a, c), EditDistance(a, b) + EditDistance(b, c));
      }
    }
  }
}

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
