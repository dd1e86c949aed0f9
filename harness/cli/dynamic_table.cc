#include "harness/cli/dynamic_table.h"

#include "harness/score/mask_scores.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

/// How late the last of the large movers was found, and for how many frames one was lost.
struct OverTime {
  std::string after_s = "-", gap = "-";
};

OverTime LargeOverTime(const DynamicOfView& row) {
  OverTime cells;
  const auto large = row.spells.find("large");
  if (large == row.spells.end()) return cells;
  const Continuity c = Summarize(large->second);
  if (c.delay_max_s) {
    cells.after_s = fmt::format("{}{:.2f}", c.never_found > 0 ? ">" : "", *c.delay_max_s);
  }
  if (c.gap_max_frames) cells.gap = fmt::format("{}", *c.gap_max_frames);
  return cells;
}

std::string Cell(const Score& score) {
  return score.value ? fmt::format("{:.3f}", *score.value) : "-";
}

std::string Percent(double share) { return fmt::format("{:.2f}", 100 * share); }

/// What a row holds of a view with truth, as words; the names are the heading's.
std::vector<std::string> Cells(const DynamicOfView& row) {
  const Detection objects = ObjectDetection(row.masks), large = LargeDetection(row.masks),
                  pixels = PixelDetection(row.masks);
  const OverTime time = LargeOverTime(row);
  return {Cell(objects.precision),
          Cell(objects.recall),
          Cell(large.precision),
          Cell(large.recall),
          time.after_s,
          time.gap,
          Cell(objects.iou),
          Cell(pixels.iou),
          Cell(pixels.recall),
          Percent(row.static_wrong()) + " %"};
}

const std::vector<std::string> kColumns = {"prec.", "recall",  "large P", "large R", "after s",
                                           "gap",   "box IoU", "px IoU",  "px rec.", "static"};
constexpr std::size_t kGap = 5, kStatic = 9;  // of these

std::string Name(const DynamicOfView& row) {
  return row.stretches == 1 ? row.view : fmt::format("{}, {} stretches", row.name, row.stretches);
}

std::string TableRow(const std::string& name, const DynamicOfView& row) {
  std::string line = fmt::format("| {} | {} |", name, row.frames);
  for (const std::string& cell : Cells(row)) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace

TextTable DynamicLines(const std::vector<std::string>& names, std::size_t width) {
  // Widths of what such figures usually are: rows are shown as they are measured.
  std::vector<TextTable::Column> columns = {{.title = "frames", .width = 5}};
  for (const std::string& title : kColumns) columns.push_back({.title = title, .width = 5});
  columns[1 + kGap].width = 3;
  columns[1 + kStatic].title = "static %";
  columns.push_back({.title = "all %", .width = 5});
  columns.push_back({.title = "ms", .width = 5});
  TextTable::Column name{.title = "view"};
  for (const std::string& one : names) name.width = std::max(name.width, ShownWidth(one));
  return {name, columns, width};
}

std::vector<std::string> DynamicCells(const DynamicOfView& row) {
  std::vector<std::string> cells = {fmt::format("{}", row.frames)};
  std::vector<std::string> figures(kColumns.size(), "-");
  if (row.has_truth) {
    figures = Cells(row);
    figures[kStatic] = Percent(row.static_wrong());
  }
  cells.insert(cells.end(), figures.begin(), figures.end());
  cells.push_back(Percent(row.rejected_share()));
  const auto dynamic = row.stage_ms.find("dynamic");
  cells.push_back(
      dynamic == row.stage_ms.end() ? "" : fmt::format("{:.1f}", dynamic->second / row.frames));
  return cells;
}

std::vector<DynamicOfView> ByScene(const std::vector<DynamicOfView>& stretches) {
  std::vector<DynamicOfView> scenes;
  for (const DynamicOfView& stretch : stretches) {
    const auto same = std::find_if(scenes.begin(), scenes.end(), [&](const DynamicOfView& scene) {
      return scene.name == stretch.name;
    });
    if (same == scenes.end()) {
      scenes.push_back(stretch);
    } else {
      *same += stretch;
    }
  }
  return scenes;
}

std::string DynamicTable(const std::vector<DynamicOfView>& rows) {
  std::string names = "| view | frames |", rule = "|---|---|", table;
  for (const std::string& column : kColumns) {
    names += " " + column + " |";
    rule += "---|";
  }
  DynamicOfView sum;
  for (const DynamicOfView& row : rows) {
    table += TableRow(Name(row), row);
    sum += row;
  }
  if (rows.size() > 1) table += TableRow("**all**", sum);
  return names + "\n" + rule + "\n" + table;
}

}  // namespace aisle
