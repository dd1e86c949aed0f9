#include "harness/report/page/compare_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/file.h"
#include "harness/judge/change_size.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ComparePageTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  /// A night of nine seeds on two scenes; the errors of the second are those of the first, times
  /// `factor`.
  Results Night(const std::string& name, double factor, const std::string& scene = "a") const {
    Results night;
    night.provenance = {"0.2.0", "commit_" + name, "cpu of " + name, "Debian", 2};
    night.suite = "nightly";
    night.started = "2026-01-31T02:00:00Z";
    night.rerun = "./aisle run " + name;
    for (const auto& [which, times] : {std::pair(scene, 1.0), std::pair(scene + "2", factor)}) {
      for (std::uint64_t seed = 1; seed <= 9; ++seed) {
        RunRecord run;
        run.spec = {.scene = which, .scene_file = "", .system = BuiltIn("robust"), .seed = seed};
        run.scores["ate_rmse_m"] = {
            .value = times * (0.02 + 0.001 * static_cast<double>(seed * seed % 7)),
            .unit = "m",
            .alignment = "se3",
            .n = 1,
            .absent = ""};
        run.artifacts["picture_0000"] =
            fmt::format("runs/{}/frame_000040{}.jpg", RunId(run.spec), "_worst_error");
        WriteFileAtomically(folder_ / name / run.artifacts["picture_0000"], name);
        night.runs.push_back(run);
      }
    }
    WriteFileAtomically(folder_ / name / "index.html", "");
    return night;
  }
  std::string Page(const Results& before, const Results& after) const {
    return ComparePage(Compare(before, after), {"out/old", &before, folder_ / "old"},
                       {"out/new", &after, folder_ / "new"}, folder_ / "compared");
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_compare_{}", ::getpid());
};

TEST_F(ComparePageTest, NamesBothSidesAndLeadsToTheSeedAndItsFrames) {
  const Results before = Night("old", 1), after = Night("new", 2);
  const std::string page = Page(before, after);
  EXPECT_THAT(page, HasSubstr("The largest change: ate_rmse_m of robust on a2 live, from "));
  for (const char* told : {"out/old", "out/new", "commit_old", "commit_new", "cpu of new",
                           "./aisle run old", "2026-01-31T02:00:00Z"}) {
    EXPECT_THAT(page, HasSubstr(told));
  }
  EXPECT_THAT(page, HasSubstr("href=\"../new/index.html#scene_a2_live.html\""));
  EXPECT_THAT(page, HasSubstr("before: robust, seed "));
  std::size_t copied = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "compared" / "pictures")) {
    copied += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(copied, 2u);
}

/// Held the other way round, what got worse got better: by as much, and nothing else is news.
TEST_F(ComparePageTest, TheOtherWayRoundIsTheOtherWayRound) {
  const Results old = Night("old", 1), now = Night("new", 2);
  const auto said = [](const std::string& page) {
    const std::size_t at = page.find("Of ");
    return page.substr(at, page.find(" The largest", at) - at);
  };
  const std::string forth = said(Page(old, now)), back = said(Page(now, old));
  EXPECT_THAT(forth, HasSubstr("1 got worse and 0 better"));
  EXPECT_THAT(back, HasSubstr("0 got worse and 1 better"));
  const auto changes = Compare(old, now), mirrored = Compare(now, old);
  ASSERT_EQ(changes.size(), mirrored.size());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    EXPECT_EQ(changes[i].old_median, mirrored[i].new_median);
    EXPECT_NEAR(changes[i].difference.low, -mirrored[i].difference.high, 1e-12);
    EXPECT_NEAR(SizeOf(changes[i]), SizeOf(mirrored[i]), 1e-12);
  }
  EXPECT_THAT(Page(old, old), Not(HasSubstr("id=\"changes\""))) << "a night and itself";
}

/// From wherever the page stands, its links lead to the two reports and to the pictures beside it.
TEST_F(ComparePageTest, EveryLinkLeadsToAFile) {
  const Results old = Night("old", 1), now = Night("new", 2);
  const fs::path out = folder_ / "deep er" / "compared";
  const std::string page = ComparePage(Compare(old, now), {"o", &old, folder_ / "old"},
                                       {"n", &now, folder_ / "new"}, out);
  fs::create_directories(out);
  std::size_t links = 0;
  for (const char* attribute : {"href=\"", "src=\""}) {
    for (std::size_t at = 0; (at = page.find(attribute, at)) != std::string::npos; ++at) {
      const std::size_t from = page.find('"', at) + 1;
      std::string link = page.substr(from, page.find('"', from) - from);
      link = link.substr(0, link.find('#'));
      EXPECT_EQ(link.find('%'), std::string::npos) << link;
      EXPECT_TRUE(fs::exists(out / link)) << link;
      ++links;
    }
  }
  EXPECT_GT(links, 5u);
}

TEST_F(ComparePageTest, SuitesThatShareNothingSayWhy) {
  const Results before = Night("old", 1, "a"), after = Night("new", 1, "z");
  EXPECT_THAT(Page(before, after), HasSubstr("Nothing can be compared: the two share no scene: a, "
                                             "a2 before, z, z2 after."));
}

TEST_F(ComparePageTest, WhatVanishedIsCountedAndListed) {
  const Results before = Night("old", 1);
  Results after = before;
  std::erase_if(after.runs,
                [](const RunRecord& run) { return run.spec.scene == "a2" || run.spec.seed > 5; });
  const std::string page = Page(before, after);
  EXPECT_THAT(page, HasSubstr("verdict failed"));
  EXPECT_THAT(page, HasSubstr("Compared with before, 1 cell and 4 seeds of 1 other are missing."));
  EXPECT_THAT(page, HasSubstr("all of it"));
  EXPECT_THAT(page, HasSubstr("seeds 6, 7, 8, 9"));
  EXPECT_THAT(Page(after, before), Not(HasSubstr("missing"))) << "what is new is not missing";
}

TEST_F(ComparePageTest, ASystemThatGotWorseEverywhereIsSaidFirst) {
  const Results before = Night("old", 2);
  Results after = before;
  for (RunRecord& run : after.runs) *run.scores["ate_rmse_m"].value *= 1.5;
  const std::string page = Page(before, after);
  EXPECT_THAT(page, HasSubstr("The largest change: ate_rmse_m of robust, by 50 % (median of 2 "
                              "cells); 18 of 18 seeds got worse"));
  EXPECT_THAT(page, HasSubstr("<td>all 2 cells<td"));
  EXPECT_THAT(page, HasSubstr("<td>+50.0 %<td>"));
}

/// What is left has no scores, and hides nothing of what is not left.
TEST_F(ComparePageTest, WhatVanishedIsListedWhereNoScoreCanBeCompared) {
  Results before = Night("old", 1);
  Results after = before;
  for (RunRecord& run : before.runs) {
    if (run.spec.scene == "a") run.scores.clear();
  }
  std::erase_if(after.runs, [](const RunRecord& run) { return run.spec.scene == "a2"; });
  const std::string page = Page(before, after);
  EXPECT_THAT(page, HasSubstr("verdict failed"));
  EXPECT_THAT(page, HasSubstr("Missing since before"));
}

TEST_F(ComparePageTest, HostileNamesAreText) {
  const std::string hostile = "\"><script>alert(1)</script>";
  const Results before = Night("old", 1, hostile), after = Night("new", 3, hostile);
  EXPECT_THAT(Page(before, after), Not(HasSubstr("<script>")));
}

}  // namespace
}  // namespace aisle
