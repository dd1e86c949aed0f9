#include "harness/common/text_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace aisle {
namespace {

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> WordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

TEST(TextLayout, WhatIsShownHasNoCodesAndCountsCharacters) {
  EXPECT_EQ(ShownWidth(""), 0u);
  EXPECT_EQ(ShownWidth("\x1b[31;1mFAIL\x1b[0m"), 4u);
  EXPECT_EQ(ShownWidth("5 … 10 m"), 8u);
  EXPECT_EQ(ShownWidth("\x1b["), 0u) << "a code that is cut off";
  EXPECT_EQ(FirstColumns("a … b", 3), "a …");
  EXPECT_EQ(FirstColumns("a … b", 9), "a … b");
}

TEST(TextLayout, ATextIsCutBetweenItsWords) {
  const std::string text =
      "FAIL  paper/scene2 live orbslam2: median of 9 seeds 0.153 m is not at most 0.03";
  for (std::size_t width = 14; width < 100; ++width) {
    const std::string wrapped = Wrapped(text, width, 6);
    const auto lines = LinesOf(wrapped);
    EXPECT_EQ(WordsOf(wrapped), WordsOf(text)) << width;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const bool is_word = WordsOf(lines[i]).size() == 1;  // too long for any line
      EXPECT_TRUE(lines[i].size() <= width || is_word) << lines[i];
      EXPECT_TRUE(i == 0 || lines[i].find_first_not_of(' ') == 6) << lines[i];
    }
  }
  EXPECT_EQ(Wrapped(text, 0, 6), text);
  EXPECT_EQ(Wrapped(text, 100, 6), text);
}

TextTable Table(std::size_t width) {
  return {{.title = "run", .width = 30},
          {{.title = "status", .width = 7, .is_left = true},
           {.title = "RPE 1s [cm]", .width = 6},
           {.title = "on movers", .width = 6}},
          width};
}

TEST(TextLayout, ATableFitsEveryTerminalAndSaysAllOfIt) {
  const std::string id = "weakness/axis/live/robust_mk/1",
                    why = "said nothing for 60 s, and was ended";
  for (std::size_t width = 30; width < 120; ++width) {
    TextTable table = Table(width);
    const std::string text = table.Heading() + table.Row(id, {"ok", "1.25", "0.1 %"}) +
                             table.Row(id + "", {"\x1b[31mtimeout\x1b[0m", "-", "-"}, why);
    std::string flat;
    for (const std::string& line : LinesOf(text)) {
      EXPECT_LE(ShownWidth(line), width) << text;
      flat += line + " ";
    }
    std::string words;
    for (const std::string& word : WordsOf(flat)) words += word + " ";
    for (const char* part :
         {"run ", "status ", "1.25 ", "0.1 % ", "timeout", "said nothing for 60 s, "}) {
      EXPECT_THAT(words, testing::HasSubstr(part)) << text;
    }
  }
}

TEST(TextLayout, WithoutATerminalARecordIsALine) {
  TextTable table = Table(0);
  EXPECT_EQ(LinesOf(table.Heading()).size(), 1u);
  const std::string row = table.Row("a", {"crashed", "-", "-"}, std::string(300, 'x') + " y");
  EXPECT_EQ(LinesOf(row).size(), 1u);
}

TEST(TextLayout, NumbersStandBelowTheirTitle) {
  for (const std::size_t width : {0u, 40u, 58u, 200u}) {
    TextTable table = Table(width);
    const auto heading = LinesOf(table.Heading());
    const auto row = LinesOf(table.Row("a", {"ok", "1.25", "0.1 %"}));
    EXPECT_EQ(row.back().size(), heading.back().size()) << table.Heading();
  }
}

TEST(TextLayout, RemarksBeginInOneColumn) {
  for (const std::size_t width : {0u, 200u}) {
    TextTable table = Table(width);
    const std::string one = table.Row("a", {"ok", "1", "2"}, "why"),
                      empty = table.Row("b", {"lost", "", ""}, "why");
    EXPECT_EQ(one.find("why"), empty.find("why")) << one << empty;
  }
}

TEST(TextLayout, ANameAboveItsCellsIsSaidOnce) {
  TextTable table = Table(40);
  const std::string text = table.Row("one", {"ok", "1", "2"}) + table.Row("one", {"ok", "3", "4"}) +
                           table.Row("two", {"ok", "5", "6"});
  EXPECT_EQ(LinesOf(text).size(), 5u) << text;
}

}  // namespace
}  // namespace aisle
