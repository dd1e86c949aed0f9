#include "harness/report/tables.h"

#include "harness/report/html.h"

namespace aisle {
namespace {

struct Column {
  const char* title;
  const char* score;
  double factor;
  int decimals;
};

struct Kind {
  const char* title;
  const char* caption;
  std::vector<Column> columns;
};

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {
      {"Detection of moving objects",
       "By rectangle, found where the overlap (IoU) is 0.5 or more; the paper's equations (12) to "
       "(14). The paper's Table 2.",
       {{"precision [%]", "object_precision", 100, 1},
        {"recall [%]", "object_recall", 100, 1},
        {"IoU [%]", "object_iou", 100, 1}}},
      {"Drift and absolute error",
       "KITTI's segments at 5, 10, … 40 m, all segments pooled; absolute error as RMSE after rigid "
       "alignment. The paper's Table 3 has KITTI's own lengths.",
       {{"t rel [%]", "t_rel_short_percent", 1, 2},
        {"r rel [deg/100m]", "r_rel_short_deg_per_100m", 1, 2},
        {"t abs [m]", "ate_rmse_m", 1, 4}}},
      {"Absolute trajectory error [m]",
       "Final track, rigid alignment (SE(3)), never scaled; median over seeds. The paper's Table "
       "4.",
       {{"RMSE", "ate_rmse_m", 1, 4},
        {"mean", "ate_mean_m", 1, 4},
        {"median", "ate_median_m", 1, 4},
        {"S.D.", "ate_std_m", 1, 4}}},
      {"Relative pose error, translation [m]",
       "From each frame to the next; median over seeds. The paper's Table 5.",
       {{"RMSE", "rpe_trans_rmse_m", 1, 4},
        {"mean", "rpe_trans_mean_m", 1, 4},
        {"median", "rpe_trans_median_m", 1, 4},
        {"S.D.", "rpe_trans_std_m", 1, 4}}},
      {"Time of the front end [ms]",
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

std::string Cell(const SceneRuns& scene, const std::string& system, const Column& column) {
  for (const SystemRuns& runs : scene.systems) {
    if (runs.system != system) continue;
    const std::optional<double> value = MedianScore(runs.runs, column.score);
    if (value) return fmt::format("{:.{}f}", *value * column.factor, column.decimals);
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
    tables.push_back(table);
  }
  return tables;
}

std::string ToHtml(const std::vector<NumberTable>& tables) {
  std::string text;
  for (const NumberTable& table : tables) {
    text += fmt::format(
        "<h3>{}</h3>\n<p class=\"soft small\">{}</p>\n<div class=\"wide\"><table "
        "class=\"grouped\"><thead><tr><th rowspan=\"2\">scene</th>",
        Escape(table.title), Escape(table.caption));
    for (const std::string& group : table.groups) {
      text += fmt::format("<th class=\"group\" colspan=\"{}\">{}</th>", table.columns.size(),
                          Escape(group));
    }
    text += "</tr><tr>";
    for (std::size_t g = 0; g < table.groups.size(); ++g) {
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        text += fmt::format("<th{}>{}</th>", c == 0 ? " class=\"first\"" : "",
                            Escape(table.columns[c]));
      }
    }
    text += "</tr></thead><tbody>\n";
    for (const NumberTable::Row& row : table.rows) {
      text += "<tr><td>" + Escape(row.name) + "</td>";
      for (std::size_t c = 0; c < row.cells.size(); ++c) {
        text +=
            fmt::format("<td{}>{}</td>", c % table.columns.size() == 0 ? " class=\"first\"" : "",
                        Escape(row.cells[c]));
      }
      text += "</tr>\n";
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
