#include "harness/report/tables.h"

#include <set>

#include "harness/report/html.h"
#include "harness/report/printed.h"

namespace aisle {
namespace {

struct Column {
  const char* title;
  const char* score;
  double factor;
  int decimals;
};

struct Kind {
  int number;  ///< of the paper's table
  const char* title;
  const char* caption;
  std::vector<Column> columns;
};

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {
      {1,
       "Moving objects",
       "Each object of each frame, found where the rectangles overlap by half (IoU 0.5) or more. "
       "The paper's Table 1.",
       {{"moving", "objects_moving", 1, 0},
        {"found", "objects_found", 1, 0},
        {"missed", "objects_missed", 1, 0},
        {"invented", "objects_invented", 1, 0}}},
      {2,
       "Detection of moving objects",
       "By rectangle, found where the overlap (IoU) is 0.5 or more; the paper's equations (12) to "
       "(14). The paper's Table 2.",
       {{"precision [%]", "object_precision", 100, 1},
        {"recall [%]", "object_recall", 100, 1},
        {"IoU [%]", "object_iou", 100, 1}}},
      {3,
       "Drift and absolute error",
       "KITTI's segments at 5, 10, … 40 m, all segments pooled; absolute error as RMSE after rigid "
       "alignment. The paper's Table 3 has KITTI's own lengths.",
       {{"t rel [%]", "t_rel_short_percent", 1, 2},
        {"r rel [deg/100m]", "r_rel_short_deg_per_100m", 1, 2},
        {"t abs [m]", "ate_rmse_m", 1, 4}}},
      {4,
       "Absolute trajectory error [m]",
       "Final track, rigid alignment (SE(3)), never scaled; median over seeds. The paper's Table "
       "4.",
       {{"RMSE", "ate_rmse_m", 1, 4},
        {"mean", "ate_mean_m", 1, 4},
        {"median", "ate_median_m", 1, 4},
        {"S.D.", "ate_std_m", 1, 4}}},
      {5,
       "Relative pose error, translation [m]",
       "From each frame to the next; median over seeds. The paper's Table 5.",
       {{"RMSE", "rpe_trans_rmse_m", 1, 4},
        {"mean", "rpe_trans_mean_m", 1, 4},
        {"median", "rpe_trans_median_m", 1, 4},
        {"S.D.", "rpe_trans_std_m", 1, 4}}},
      {6,
       "Time of the front end [ms]",
       "Mean per frame on this machine. The paper's Table 6.",
       {{"dynamic", "ms_dynamic_mean", 1, 1},
        {"tracking", "ms_track_mean", 1, 1},
        {"whole step", "ms_process_mean", 1, 1}}}};
  return kinds;
}

std::vector<std::string> SystemsOf(const std::vector<SceneRuns>& scenes) {
  std::map<int, std::string> by_color;
  for (const SceneRuns& scene : scenes) {
    for (const SystemRuns& system : scene.systems) by_color[system.color] = system.system;
  }
  std::vector<std::string> names;
  for (const auto& [color, name] : by_color) names.push_back(name);
  return names;
}

std::string Text(double value, const Column& column) {
  return fmt::format("{:.{}f}", value * column.factor, column.decimals);
}

std::string Cell(const SceneRuns& scene, const std::string& system, const Column& column) {
  for (const SystemRuns& runs : scene.systems) {
    if (runs.system != system) continue;
    const std::optional<double> value = MedianScore(runs.runs, column.score);
    if (value) return Text(*value, column);
  }
  return "-";
}

bool HasNumber(const NumberTable::Row& row) {
  return std::any_of(row.cells.begin(), row.cells.end(),
                     [](const std::string& cell) { return cell != "-"; });
}

/// Systems without any number in a table need no column in it.
void DropEmptyGroups(NumberTable* table) {
  const std::size_t width = table->columns.size();
  for (std::size_t g = table->groups.size(); g-- > 0;) {
    const auto at = static_cast<std::ptrdiff_t>(g * width);
    const auto step = static_cast<std::ptrdiff_t>(width);
    const bool empty =
        std::all_of(table->rows.begin(), table->rows.end(), [&](const NumberTable::Row& row) {
          return std::all_of(row.cells.begin() + at, row.cells.begin() + at + step,
                             [](const std::string& cell) { return cell == "-"; });
        });
    if (!empty) continue;
    table->groups.erase(table->groups.begin() + static_cast<std::ptrdiff_t>(g));
    for (NumberTable::Row& row : table->rows) {
      row.cells.erase(row.cells.begin() + at, row.cells.begin() + at + step);
    }
  }
}

/// What the paper printed under one name, in the columns of the systems that stand for its own.
/// Absent where it printed nothing of these.
std::optional<NumberTable::Row> PrintedRowOf(const std::string& name, const Kind& kind,
                                             const NumberTable& table) {
  const std::size_t width = kind.columns.size();
  NumberTable::Row row{.name = "as printed: " + name,
                       .cells = std::vector<std::string>(table.groups.size() * width),
                       .printed = true};
  bool any = false;
  for (const PrintedRow& printed : PrintedTable(kind.number)) {
    const auto group = std::find(table.groups.begin(), table.groups.end(), printed.system);
    if (printed.row != name || group == table.groups.end()) continue;
    const auto first = static_cast<std::size_t>(group - table.groups.begin()) * width;
    for (std::size_t c = 0; c < width; ++c) {
      Column as_printed = kind.columns[c];
      as_printed.factor = 1;
      row.cells[first + c] = printed.values[c] ? Text(*printed.values[c], as_printed) : "-";
    }
    any = true;
  }
  return any ? std::optional(row) : std::nullopt;
}

/// The paper's rows under our scenes of the same number, and after them those of its other data.
void AddPrinted(const Kind& kind, NumberTable* table) {
  std::vector<NumberTable::Row> rows;
  std::set<std::string> ours;
  for (const NumberTable::Row& row : table->rows) {
    rows.push_back(row);
    ours.insert(row.name);
    if (const auto printed = PrintedRowOf(row.name, kind, *table)) rows.push_back(*printed);
  }
  for (const PrintedRow& printed : PrintedTable(kind.number)) {
    const std::string name = printed.row;
    if (name.starts_with("paper/") || !ours.insert(name).second) continue;
    if (const auto row = PrintedRowOf(name, kind, *table)) rows.push_back(*row);
  }
  table->rows = std::move(rows);
}

/// Reports on other scenes need not be reminded of the paper.
bool FollowsThePaper(const std::vector<SceneRuns>& scenes) {
  return std::any_of(scenes.begin(), scenes.end(), [](const SceneRuns& scene) {
    return scene.scene.starts_with("paper/") || scene.scene.starts_with("street/");
  });
}

std::string LatexText(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        safe += std::string("\\") + c;
        break;
      case '\\':
        safe += "\\textbackslash{}";
        break;
      case '~':
        safe += "\\textasciitilde{}";
        break;
      case '^':
        safe += "\\textasciicircum{}";
        break;
      default:
        safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return safe;
}

std::string MarkdownText(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '\\' || c == '`' || c == '*' || c == '[') safe += '\\';
    safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return safe;
}

}  // namespace

std::vector<NumberTable> PaperTables(const std::vector<SceneRuns>& scenes) {
  std::vector<NumberTable> tables;
  for (const Kind& kind : Kinds()) {
    NumberTable table{.title = kind.title,
                      .caption = kind.caption,
                      .groups = SystemsOf(scenes),
                      .columns = {},
                      .rows = {}};
    for (const Column& column : kind.columns) table.columns.emplace_back(column.title);
    for (const SceneRuns& scene : scenes) {
      if (scene.twin != "live") continue;
      NumberTable::Row row{.name = scene.scene, .cells = {}};
      for (const std::string& system : table.groups) {
        for (const Column& column : kind.columns) row.cells.push_back(Cell(scene, system, column));
      }
      if (HasNumber(row)) table.rows.push_back(row);
    }
    if (table.rows.empty()) continue;
    DropEmptyGroups(&table);
    if (FollowsThePaper(scenes)) AddPrinted(kind, &table);
    tables.push_back(table);
  }
  return tables;
}

std::string ToHtml(const std::vector<NumberTable>& tables) {
  std::string text;
  for (const NumberTable& table : tables) {
    text += fmt::format(
        "<h3>{}</h3>\n<p class=\"soft small\">{}</p>\n<div class=\"wide\"><table "
        "class=\"grouped\"><thead><tr><th rowspan=\"2\">scene",
        Escape(table.title), Escape(table.caption));
    for (const std::string& group : table.groups) {
      text +=
          fmt::format("<th class=\"group\" colspan=\"{}\">{}", table.columns.size(), Escape(group));
    }
    text += "<tr>";
    for (std::size_t g = 0; g < table.groups.size(); ++g) {
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        text += fmt::format("<th{}>{}", c == 0 ? " class=\"first\"" : "", Escape(table.columns[c]));
      }
    }
    text += "</thead><tbody>\n";
    for (const NumberTable::Row& row : table.rows) {
      text +=
          fmt::format("<tr{}><td>{}", row.printed ? " class=\"printed\"" : "", Escape(row.name));
      for (std::size_t c = 0; c < row.cells.size(); ++c) {
        text += fmt::format("<td{}>{}", c % table.columns.size() == 0 ? " class=\"first\"" : "",
                            Escape(row.cells[c]));
      }
      text += "\n";
    }
    text += "</tbody></table></div>\n";
  }
  return text;
}

std::string ToMarkdown(const std::vector<NumberTable>& tables) {
  std::string text;
  for (const NumberTable& table : tables) {
    text += fmt::format("## {}\n\n{}\n\n| scene |", table.title, table.caption);
    std::string rule = "|---|";
    for (const std::string& group : table.groups) {
      for (const std::string& column : table.columns) {
        text += fmt::format(" {} {} |", MarkdownText(group), MarkdownText(column));
        rule += "---:|";
      }
    }
    text += "\n" + rule + "\n";
    for (const NumberTable::Row& row : table.rows) {
      text += "| " + MarkdownText(row.name) + " |";
      for (const std::string& cell : row.cells) text += " " + cell + " |";
      text += "\n";
    }
    text += "\n";
  }
  return text;
}

std::string ToLatex(const std::vector<NumberTable>& tables) {
  std::string text = "% needs \\usepackage{booktabs}\n";
  for (const NumberTable& table : tables) {
    const std::size_t width = table.columns.size();
    text += fmt::format("\\begin{{table}}\n\\caption{{{}. {}}}\n\\centering\n\\begin{{tabular}}{{l",
                        LatexText(table.title), LatexText(table.caption));
    for (std::size_t i = 0; i < table.groups.size() * width; ++i) text += 'r';
    text += "}\n\\toprule\n";
    for (const std::string& group : table.groups) {
      text += fmt::format(" & \\multicolumn{{{}}}{{c}}{{{}}}", width, LatexText(group));
    }
    text += " \\\\\nscene";
    for (std::size_t g = 0; g < table.groups.size(); ++g) {
      for (const std::string& column : table.columns) text += " & " + LatexText(column);
    }
    text += " \\\\\n\\midrule\n";
    for (const NumberTable::Row& row : table.rows) {
      text += LatexText(row.name);
      for (const std::string& cell : row.cells) text += " & " + LatexText(cell);
      text += " \\\\\n";
    }
    text += "\\bottomrule\n\\end{tabular}\n\\end{table}\n\n";
  }
  return text;
}

}  // namespace aisle
