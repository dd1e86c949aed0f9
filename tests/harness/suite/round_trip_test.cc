// plan.json with any values comes back as it was.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "harness/suite/plan.h"
#include "tests/support/arbitrary.h"

namespace aisle {
namespace {

SuiteScene AnyScene() { return {.name = AnyText(), .file = AnyText(), .recorded = AnyFlag()}; }

SystemSpec AnySystem() {
  return {.name = AnyText(), .like = AnyText(), .options = AnyMap(3, AnyText)};
}

Limit AnyLimit() {
  return {.score = AnyText(),
          .scene = AnyText(),
          .twin = AnyText(),
          .system = AnyText(),
          .min = Perhaps(AnyNumber),
          .max = Perhaps(AnyNumber),
          .share = Perhaps(AnyNumber)};
}

Suite AnySuite() {
  return {.name = AnyText(),
          .question = AnyText(),
          .scenes = AnyList(3, AnyScene),
          .systems = AnyList(3, AnySystem),
          .twins = AnyList(3, AnyText),
          .seeds = AnyList(5, AnyWhole<std::uint64_t>),
          .limits = AnyList(3, AnyLimit)};
}

bool Equal(const Limit& a, const Limit& b) {
  return a.score == b.score && a.scene == b.scene && a.twin == b.twin && a.system == b.system &&
         a.min == b.min && a.max == b.max && a.share == b.share;
}

bool Equal(const Suite& a, const Suite& b) {
  return a.name == b.name && a.question == b.question && a.scenes == b.scenes &&
         a.systems == b.systems && a.twins == b.twins && a.seeds == b.seeds &&
         std::equal(a.limits.begin(), a.limits.end(), b.limits.begin(), b.limits.end(),
                    [](const Limit& x, const Limit& y) { return Equal(x, y); });
}

TEST(PlanRoundTrip, KeepsEverySuite) {
  EXPECT_TRUE(rc::check([] {
    const PlanFile plan{.suites = AnyList(3, AnySuite),
                        .command = AnyText(),
                        .suite_file = AnyText(),
                        .gate = AnyOf(0, 1) == 1,
                        .trial = AnyOf(0, 1) == 1,
                        .started = AnyText(),
                        .inputs = AnyMap(3, AnyText)};
    const PlanFile read = PlanFromJson(ToJson(plan), "x");
    RC_ASSERT(read.command == plan.command && read.suite_file == plan.suite_file);
    RC_ASSERT(read.gate == plan.gate && read.trial == plan.trial);
    RC_ASSERT(read.started == plan.started && read.inputs == plan.inputs);
    RC_ASSERT(std::equal(read.suites.begin(), read.suites.end(), plan.suites.begin(),
                         plan.suites.end(),
                         [](const Suite& x, const Suite& y) { return Equal(x, y); }));
  }));
}

TEST(ShardRoundTrip, PartsOfAnyPlanAreTogetherTheWhole) {
  EXPECT_TRUE(rc::check([] {
    const std::vector<RunSpec> all = Plan(AnySuite());
    const auto count = static_cast<std::size_t>(AnyOf(1, 9));
    std::size_t together = 0;
    for (std::size_t index = 1; index <= count; ++index) {
      together += TakeShard(all, ShardFromText(fmt::format("{}/{}", index, count))).size();
    }
    RC_ASSERT(together == all.size());
  }));
}

}  // namespace
}  // namespace aisle
