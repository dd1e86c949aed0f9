#include "harness/report/compare_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;

TEST(CompareTextTest, EveryWritingNamesTheChange) {
  Comparison worse;
  worse.score = "ate_rmse_m";
  worse.old_median = 0.02;
  worse.new_median = 0.04;
  worse.change = Change::kWorse;
  EXPECT_THAT(ToConsole({worse}, false), HasSubstr("1 worse"));
  EXPECT_THAT(ToMarkdown({worse}), HasSubstr("| ate_rmse_m | worse |"));
  EXPECT_THAT(ToJson({worse}), HasSubstr("\"change\": \"worse\""));
}

}  // namespace
}  // namespace aisle
