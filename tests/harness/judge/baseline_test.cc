#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/judge/compare.h"
#include "tests/harness/record/night.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

TEST(BaselineTest, KeepsWhatAComparisonNeeds) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_baseline_{}", ::getpid());
  const Results results = MakeNight({.scenes = 1, .seeds = 9}, folder);
  fs::remove_all(folder);
  const Results baseline = BaselineOf(results);
  EXPECT_LT(ToJson(baseline).size(), ToJson(results).size() / 3);
  const std::vector<Comparison> by_baseline = Compare(baseline, results);
  const std::vector<Comparison> by_all = Compare(results, results);
  ASSERT_EQ(by_baseline.size(), by_all.size());
  ASSERT_FALSE(by_all.empty());
  for (std::size_t i = 0; i < by_all.size(); ++i) {
    EXPECT_EQ(by_baseline[i].score, by_all[i].score);
    EXPECT_EQ(by_baseline[i].old_median, by_all[i].old_median);
    EXPECT_EQ(by_baseline[i].new_median, by_all[i].new_median);
    EXPECT_EQ(by_baseline[i].p, by_all[i].p);
    EXPECT_EQ(by_baseline[i].change, by_all[i].change);
  }
}

}  // namespace
}  // namespace aisle
