#include "harness/report/page/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <regex>

#include "harness/report/markup/html.h"
#include "harness/report/page/answer.h"
#include "harness/report/page/parts.h"

namespace aisle {
namespace {

std::vector<std::string> AllOf(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) {
    found.push_back((*at)[1]);
  }
  return found;
}

/// The table of contents is the list of the headings that can be led to, in their order.
TEST(Page, ContentsAreItsHeadingsThatHaveAnId) {
  std::mt19937 random(1);
  for (int round = 0; round < 100; ++round) {
    std::string body;
    std::vector<std::string> expected;
    for (int i = 0; i < round % 12; ++i) {
      const char level = static_cast<char>('1' + random() % 4);
      const bool with_id = random() % 3 != 0;
      const std::string id = fmt::format("part_{}", i);
      body += with_id ? fmt::format("<h{} id=\"{}\">", level, id) : fmt::format("<h{}>", level);
      body += fmt::format("title <b>of</b> {}</h{}>\n<p>text</p>\n", i, level);
      if (with_id && (level == '2' || level == '3')) expected.push_back(id);
    }
    const std::string page = Page("a title", "", body);
    const auto links = AllOf(page, "<li class=\"level[23]\"><a href=\"#([^\"]*)\">");
    EXPECT_EQ(links, expected.size() < 3 ? std::vector<std::string>{} : expected) << body;
    for (const std::string& text : AllOf(page, "<a href=\"#[^\"]*\">([^\n]*)</a>")) {
      EXPECT_THAT(text, testing::StartsWith("title of ")) << "tags do not nest in links";
    }
    EXPECT_THAT(page, testing::HasSubstr(body)) << "the body stays as it is";
  }
}

TEST(Page, AsksForItsResourcesWhereItsRootIsAndForNothingElse) {
  for (const std::string root : {"", "../", "../../"}) {
    const std::string page = Page("<t>", root, "");
    EXPECT_THAT(AllOf(page, "(?:href|src)=\"([^\"]*)\""),
                testing::ElementsAre(root + "style.css", root + "report.js"));
    EXPECT_THAT(page, testing::HasSubstr("<title>&lt;t&gt;</title>"));
  }
}

/// What is said is the length rounded to the last figure that is said, in a unit in which that
/// figure is a hundredth of a metre, a tenth of a millimetre below a centimetre; longer is never
/// said as shorter.
TEST(LengthInWords, IsTheRoundedLengthAndKeepsItsOrder) {
  const std::map<std::string, double> metres = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}};
  double before = 0;
  for (double length = 2e-4; length < 500; length *= 1.013) {
    const std::string words = LengthInWords(length);
    const std::size_t space = words.find(' '), point = words.find('.');
    ASSERT_NE(space, std::string::npos) << words;
    ASSERT_TRUE(metres.contains(words.substr(space + 1))) << words;
    const double unit = metres.at(words.substr(space + 1));
    const double said = std::stod(words) * unit;
    const double figures = point == std::string::npos ? 0 : static_cast<double>(space - point - 1);
    const double last = unit * std::pow(10, -figures);
    EXPECT_LE(std::abs(said - length), 0.501 * last) << words;
    EXPECT_LE(last, length < 0.01 ? 1e-4 : length < 0.1 ? 1e-3 : 0.01) << words;
    EXPECT_GE(said, before * (1 - 1e-12)) << words;
    before = said;
  }
}

TEST(LengthInWords, BelowACentimetreIsInMillimetres) {
  EXPECT_EQ(LengthInWords(0.0014), "1.4 mm");
  EXPECT_EQ(LengthInWords(0.0097), "9.7 mm");
  EXPECT_EQ(LengthInWords(0.0214), "2.1 cm");
}

TEST(FailedAndLost, CountsWhatDidNotEndAndWhatEndedWithTooFewPoses) {
  const auto with = [](const std::vector<RunStatus>& statuses) {
    std::vector<RunRecord> runs;
    for (const RunStatus status : statuses) runs.emplace_back().status = status;
    return runs;
  };
  using enum RunStatus;
  EXPECT_EQ(FailedAndLost(with({kOk, kOk})), "");
  EXPECT_EQ(FailedAndLost(with({kOk, kLost})), "1 of 2 runs lost");
  EXPECT_EQ(FailedAndLost(with({kOk, kCrashed, kTimeout})), "2 of 3 runs failed");
  EXPECT_EQ(FailedAndLost(with({kInvalid, kLost, kLost, kOk})), "1 of 4 runs failed, 2 lost");
}

TEST(CompleteOf, AreThoseThatCameToAnEndAndAllWhereNoneDid) {
  RunRecord good, lost, crashed;
  lost.status = RunStatus::kLost;
  crashed.status = RunStatus::kCrashed;
  using Runs = std::vector<const RunRecord*>;
  EXPECT_EQ(CompleteOf({&crashed, &good, &lost}), (Runs{&good, &lost}));
  EXPECT_EQ(CompleteOf({&crashed}), Runs{&crashed});
}

TEST(Listed, EveryPartIsThereOnceWithOneAnd) {
  std::vector<std::string> parts;
  EXPECT_EQ(Listed(parts), "");
  for (int n = 1; n <= 6; ++n) {
    parts.push_back(fmt::format("p{}", n));
    const std::string text = Listed(parts);
    EXPECT_EQ(AllOf(text, "(p\\d)"), parts);
    EXPECT_EQ(AllOf(text, "( and )").size(), n > 1 ? 1u : 0u);
    EXPECT_EQ(AllOf(text, "(, )").size(), static_cast<std::size_t>(std::max(0, n - 2)));
  }
}

TEST(SeedOf, TellsDrivesOverOneSeedApart) {
  RunSpec spec;
  spec.seed = 3;
  const std::string first = SeedOf(spec);
  spec.repeat = 2;
  EXPECT_NE(SeedOf(spec), first);
  spec.seed = 4;
  EXPECT_THAT(SeedOf(spec), testing::HasSubstr("4"));
}

TEST(LastWords, OfForeignProgramsAreTextAndLeadToTheWholeLog) {
  RunRecord run;
  EXPECT_EQ(LastWordsOf(run, ""), "");
  run.last_words = "</pre><script>alert(1)</script>\x01";
  run.artifacts["log"] = "runs/a b/log.txt";
  const std::string text = LastWordsOf(run, "../");
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("<script>")));
  EXPECT_THAT(text, testing::HasSubstr(Escape(run.last_words)));
  EXPECT_THAT(text, testing::HasSubstr("href=\"../runs/a%20b/log.txt\""));
}

}  // namespace
}  // namespace aisle
