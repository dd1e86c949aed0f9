#include "harness/cluster/kubernetes.h"

#include <gtest/gtest.h>

#include <regex>

namespace aisle {
namespace {

TEST(KubernetesTest, NamesAreThoseOfALabel) {
  const std::regex label("[a-z]([-a-z0-9]*[a-z0-9])?");
  for (const std::string name : {"paper", "Paper_Narrow+weakness", "---", "", "é", "a.b/c"}) {
    EXPECT_TRUE(std::regex_match(KubernetesName(name, "/out"), label))
        << KubernetesName(name, "/out");
  }
  const std::string longest = KubernetesName(std::string(200, 'x'), "/out");
  EXPECT_LE(longest.size() + std::string("-merge").size(), 63);
}

TEST(KubernetesTest, NightsOfOneSuiteInTwoFoldersAreTwo) {
  EXPECT_EQ(KubernetesName("paper", "/a"), KubernetesName("paper", "/a"));
  EXPECT_NE(KubernetesName("paper", "/a"), KubernetesName("paper", "/b"));
  const std::string longest(200, 'x');
  EXPECT_NE(KubernetesName(longest, "/a"), KubernetesName(longest, "/b"));
}

}  // namespace
}  // namespace aisle
