#include "harness/report/page/answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::ElementsAre;

RunRecord RunOf(const std::string& scene, const std::string& system, std::optional<double> ate_m,
                std::uint64_t seed = 1) {
  RunRecord run;
  run.spec = {scene, scene + ".yaml", "live", BuiltIn(system), seed};
  run.scores["ate_rmse_m"] = {
      .value = ate_m, .unit = "m", .alignment = "se3", .n = 1, .absent = ""};
  return run;
}

Results Of(std::vector<RunRecord> runs) {
  Results results;
  results.runs = std::move(runs);
  return results;
}

TEST(AnswerTest, SaysWhoIsOffByHowMuchAndWhatIsWonBack) {
  EXPECT_THAT(AnswerInWords(Of({RunOf("s", "plain", 1.7), RunOf("s", "robust", 0.02),
                                RunOf("s", "oracle", 0.0)})),
              ElementsAre("On s, plain is off by 1.70 m, robust by 2.0 cm and oracle by 0.0 mm: "
                          "robust wins back 99 % of what movers cost plain."));
  EXPECT_THAT(AnswerInWords(Of({RunOf("s", "plain", 0.5), RunOf("s", "oracle", 0.05)})),
              ElementsAre("On s, plain is off by 50 cm and oracle by 5.0 cm."));
}

TEST(ReportTitle, OfManySuitesNamesTwo) {
  Results results;
  results.suite = "night";
  EXPECT_EQ(ReportTitle(results), "night");
  results.suite = "one+two+three";
  EXPECT_EQ(ReportTitle(results), "one + two + three");
  results.suite = "one+two+three+four";
  EXPECT_EQ(ReportTitle(results), "one + two and 2 more");
}

TEST(AnswerTest, OnlyARejectionWinsBackAndOnlyFromItsOwnTwin) {
  RunRecord mine = RunOf("s", "mine", 0.1);
  mine.spec.system = {.name = "mine", .external = ExternalSystem{.command = "mine"}};
  EXPECT_THAT(AnswerInWords(Of({RunOf("s", "plain", 0.5), mine, RunOf("s", "oracle", 0.05)})),
              ElementsAre("On s, plain is off by 50 cm, mine by 10 cm and oracle by 5.0 cm."));
  EXPECT_THAT(
      AnswerInWords(Of(
          {RunOf("s", "orbslam2", 0.5), RunOf("s", "robust", 0.06), RunOf("s", "oracle", 0.05)})),
      ElementsAre("On s, orbslam2 is off by 50 cm, robust by 6.0 cm and oracle by 5.0 cm."));
}

TEST(AnswerTest, ARejectionThatAnOptionTurnsOnWinsBackToo) {
  RunRecord on = RunOf("s", "plain", 0.06);
  on.spec.system.name = "on";
  on.spec.system.options["dynamic.method"] = "robust";
  EXPECT_THAT(AnswerInWords(Of({RunOf("s", "plain", 0.5), on, RunOf("s", "oracle", 0.05)})),
              ElementsAre("On s, plain is off by 50 cm, on by 6.0 cm and oracle by 5.0 cm: on wins "
                          "back 98 % of what movers cost plain."));
}

TEST(AnswerTest, WhereMoversCostNothingItSaysSo) {
  EXPECT_THAT(AnswerInWords(Of({RunOf("s", "plain", 0.0054), RunOf("s", "oracle", 0.004)})),
              ElementsAre("On s, plain is off by 5.4 mm and oracle by 4.0 mm: movers cost "
                          "plain next to nothing here."));
}

/// One crash of nine runs leaves the error of the others, which the tables show as well.
TEST(AnswerTest, ARunWithoutAnErrorTakesNothingFromTheOthers) {
  std::vector<RunRecord> runs = {RunOf("s", "robust", 0.02)};
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    runs.push_back(RunOf("s", "plain", 0.1 + 0.02 * static_cast<double>(seed), seed));
    runs.back().scores["coverage"] = {
        .value = 1, .unit = "1", .alignment = "", .n = 1, .absent = ""};
  }
  runs.back().scores.clear();
  runs.back().status = RunStatus::kCrashed;
  EXPECT_THAT(AnswerInWords(Of(runs)),
              ElementsAre("On s, robust is off by 2.0 cm and plain by 19 cm in 8 of 9 seeds."));
}

TEST(AnswerTest, TakesMediansOverSeedsAndTellsWhoIsLost) {
  EXPECT_THAT(AnswerInWords(Of({RunOf("s", "robust", 0.1, 1), RunOf("s", "robust", 0.2, 2),
                                RunOf("s", "robust", 0.9, 3), RunOf("s", "mine", {}, 1),
                                RunOf("s", "mine", {}, 2)})),
              ElementsAre("On s, robust is off by 20 cm and mine has no error to tell."));
}

TEST(AnswerTest, AnErrorOfHalfADriveSaysSoAndWinsNothingBack) {
  RunRecord half = RunOf("s", "robust", 0.007);
  half.scores["coverage"] = {.value = 0.49, .unit = "1", .alignment = "", .n = 1, .absent = ""};
  RunRecord lost = half;
  lost.status = RunStatus::kLost;
  RunRecord whole = RunOf("s", "robust", 0.007);
  whole.scores["coverage"] = {.value = 1, .unit = "1", .alignment = "", .n = 1, .absent = ""};
  whole.status = RunStatus::kLost;  // asked for more than there can be
  EXPECT_THAT(AnswerInWords(Of({whole})), ElementsAre("On s, robust is off by 7.0 mm."));
  for (const RunRecord& part : {half, lost}) {
    EXPECT_THAT(AnswerInWords(Of({RunOf("s", "plain", 0.5), part, RunOf("s", "oracle", 0.02)})),
                ElementsAre("On s, plain is off by 50 cm, robust by 7.0 mm over the 49 % of the "
                            "frames it has a pose for and oracle by 2.0 cm."));
  }
}

TEST(AnswerTest, OfManyScenesTheWorstAreToldAndTheirNumber) {
  const auto sentences = AnswerInWords(Of({RunOf("a", "robust", 0.1), RunOf("b", "robust", 0.4),
                                           RunOf("c", "robust", 0.2), RunOf("d", "robust", 0.3)}));
  EXPECT_THAT(
      sentences,
      ElementsAre("On b, robust is off by 40 cm.", "On d, robust is off by 30 cm.",
                  "On c, robust is off by 20 cm.", "These are the 3 scenes of 4 that went worst."));
}

TEST(AnswerTest, WithoutAnErrorThereIsNothingToSay) {
  EXPECT_THAT(AnswerInWords(Of({})), ElementsAre());
  EXPECT_THAT(AnswerInWords(Of({RunOf("s", "robust", {})})), ElementsAre());
}

}  // namespace
}  // namespace aisle
