#include "harness/cluster/kubernetes.h"

#include <gtest/gtest.h>

#include <regex>

namespace aisle {
namespace {

TEST(KubernetesTest, NamesAreThoseOfALabel) {
  const std::regex label("[a-z]([-a-z0-9]*[a-z0-9])?");
  for (const std::string name : {"paper", "Paper_Narrow+weakness", "---", "", "é", "a.b/c"}) {
    EXPECT_TRUE(std::regex_match(KubernetesName(name), label)) << KubernetesName(name);
  }
  const std::string longest = KubernetesName(std::string(200, 'x'));
  EXPECT_LE(longest.size() + std::string("-merge").size(), 63);
}

}  // namespace
}  // namespace aisle
