#include "harness/report/compare_text.h"

#include "harness/judge/change_size.h"
#include "harness/record/record_json.h"
#include "harness/report/block/markdown_text.h"

namespace aisle {
namespace {

/// What it is now; a score that is gone is nothing.
std::string After(const Comparison& c) {
  if (c.cells > 0) return "";
  return c.new_n > 0 ? fmt::format("{:.4g}", c.new_median) : "nothing";
}

/// What it was; several cells have no one value.
std::string Before(const Comparison& c) {
  return c.cells > 0 ? "" : fmt::format("{:.4g}", c.old_median);
}

std::string NameOfCell(const MissingRuns& one) {
  return fmt::format("{} {} {}", one.scene, one.twin, one.system);
}

std::string Lacking(const MissingRuns& one) {
  return one.is_whole ? "the old side has it, the new one has not"
                      : fmt::format("the old side has seeds {}, the new one has not",
                                    fmt::join(one.seeds, ", "));
}

bool IsChange(const Comparison& c) { return IsAlarm(c.change) || c.change == Change::kBetter; }

struct ConsoleRow {
  std::string name;
  std::vector<std::string> cells;
  std::string remark;
};

ConsoleRow RowOf(const Comparison& c, bool color) {
  const std::string change =
      Painted(Name(c.change), IsAlarm(c.change) ? "31;1" : "32", color && IsChange(c));
  return {NameOfCell(c), {c.score, change, Before(c), After(c), PercentOfChange(c)}, c.why};
}

ConsoleRow RowOf(const MissingRuns& one, bool color) {
  return {NameOfCell(one), {"", Painted("missing", "31;1", color), "", "", ""}, Lacking(one)};
}

std::size_t Count(const std::vector<Comparison>& comparisons, Change change) {
  return static_cast<std::size_t>(
      std::count_if(comparisons.begin(), comparisons.end(),
                    [&](const Comparison& c) { return c.change == change; }));
}

std::string Summary(const std::vector<Comparison>& comparisons) {
  std::string text =
      fmt::format("{} worse, {} better, {} same, {} cannot tell",
                  Count(comparisons, Change::kWorse), Count(comparisons, Change::kBetter),
                  Count(comparisons, Change::kSame), Count(comparisons, Change::kCannotTell));
  for (const Change change : {Change::kUnstable, Change::kGone}) {
    const std::size_t count = Count(comparisons, change);
    if (count > 0) text += fmt::format(", {} {}", count, Name(change));
  }
  return text;
}

}  // namespace

std::string ToConsole(const std::vector<Comparison>& comparisons,
                      const std::vector<MissingRuns>& missing, const TextLook& look) {
  std::vector<ConsoleRow> rows;
  for (const Comparison& c : comparisons) rows.push_back(RowOf(c, look.color));
  for (const MissingRuns& one : missing) rows.push_back(RowOf(one, look.color));
  TextTable::Column name{.title = "scene twin system"};
  std::vector<TextTable::Column> columns = {{.title = "score", .is_left = true},
                                            {.title = "change", .is_left = true},
                                            {.title = "before"},
                                            {.title = "after"},
                                            {.title = ""}};
  for (const ConsoleRow& row : rows) {
    name.width = std::max(name.width, row.name.size());
    TextTable::Hold(row.cells, &columns);
  }
  TextTable table(name, columns, look.width);
  std::string text = table.Heading();
  for (const ConsoleRow& row : rows) text += table.Row(row.name, row.cells, row.remark);
  const std::string summary =
      Summary(comparisons) + (missing.empty() ? "" : "; " + InWords(missing));
  return text + Wrapped(summary, look.width) + "\n";
}

std::string ToMarkdown(const std::vector<Comparison>& comparisons,
                       const std::vector<MissingRuns>& missing) {
  std::string text =
      "| scene, twin, system | score | change | before | after | | why "
      "|\n|---|---|---|--:|--:|--:|---|\n";
  for (const Comparison& c : comparisons) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", MarkdownText(NameOfCell(c)),
                        MarkdownText(c.score), Name(c.change), Before(c), After(c),
                        PercentOfChange(c), MarkdownText(c.why));
  }
  for (const MissingRuns& one : missing) {
    text +=
        fmt::format("| {} | | missing | | | | {} |\n", MarkdownText(NameOfCell(one)), Lacking(one));
  }
  return text;
}

std::string ToJson(const std::vector<Comparison>& comparisons,
                   const std::vector<MissingRuns>& missing) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Comparison& c : comparisons) {
    list.push_back({{"scene", c.scene},
                    {"twin", c.twin},
                    {"system", c.system},
                    {"score", c.score},
                    {"unit", c.unit},
                    {"change", Name(c.change)},
                    {"before", c.old_median},
                    {"after", c.new_median},
                    {"difference_low", c.difference.low},
                    {"difference_high", c.difference.high},
                    {"paired", c.paired},
                    {"seeds_before", c.old_n},
                    {"seeds_after", c.new_n},
                    {"p_holm", c.p},
                    {"why", c.why}});
    if (c.cells > 0) list.back()["cells"] = c.cells;
    if (c.factor) list.back()["factor"] = *c.factor;
  }
  nlohmann::ordered_json lacking = nlohmann::ordered_json::array();
  for (const MissingRuns& one : missing) {
    lacking.push_back({{"scene", one.scene},
                       {"twin", one.twin},
                       {"system", one.system},
                       {"seeds", one.seeds},
                       {"whole", one.is_whole}});
  }
  return Dump({{"schema", 1}, {"comparisons", list}, {"missing", lacking}});
}

}  // namespace aisle
