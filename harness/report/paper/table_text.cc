#include <algorithm>
#include <set>

#include "harness/report/block/markdown_text.h"
#include "harness/report/markup/html.h"
#include "harness/report/paper/spread.h"
#include "harness/report/paper/tables.h"

namespace aisle {
namespace {

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

/// What stands behind a median; empty where all rows are of one seed.
std::string WhatCellsHold(const NumberTable& table) {
  std::set<std::size_t> several;
  for (const NumberTable::Row& row : table.rows) {
    if (!row.intervals.empty()) several.insert(row.seeds);
  }
  if (several.empty()) return "";
  const std::size_t fewest = *several.begin(), most = *several.rbegin();
  std::string text = fewest == most ? fmt::format("Cells: of {} seeds", most)
                                    : fmt::format("Cells: of {} to {} seeds", fewest, most);
  if (HasInterval(most)) text += " the median and, in brackets, its 95 % interval (bootstrap)";
  if (!HasInterval(fewest)) {
    text += HasInterval(most) ? ", or of fewer than five, in parentheses, the least and the most"
                              : " the median and, in parentheses, the least and the most";
  }
  return text + (HasInterval(most) ? "; the HTML report has the least and the most too." : ".");
}

std::string MarkdownHead(const NumberTable& table) {
  std::string head = fmt::format("| scene | {} |", MarkdownText(table.group_head));
  std::string rule = "|---|---|";
  for (const std::string& column : table.columns) {
    const std::string unit = table.unit.empty() ? "" : fmt::format(" [{}]", table.unit);
    head += fmt::format(" {} |", MarkdownText(column + unit));
    rule += "---:|";
  }
  return head + "\n" + rule + "\n";
}

/// One group's cells; nothing where the paper printed none of it.
std::string MarkdownRow(const NumberTable& table, const NumberTable::Row& row, std::size_t group) {
  const std::size_t width = table.columns.size();
  std::string cells;
  bool any = false;
  for (std::size_t i = group * width; i < (group + 1) * width; ++i) {
    any |= !row.cells[i].empty();
    const bool has_interval =
        !row.intervals.empty() && !row.intervals[i].empty() && row.cells[i] != "-";
    cells += fmt::format(" {}{}{} |", row.cells[i], has_interval ? " " : "",
                         has_interval ? row.intervals[i] : "");
  }
  if (!any) return "";
  return fmt::format("| {} | {}{} |{}\n", MarkdownText(row.scene),
                     MarkdownText(table.groups[group]), row.printed ? ", as printed" : "", cells);
}

bool HasMeasured(const NumberTable& table, const std::string& scene) {
  return std::ranges::any_of(table.rows, [&](const NumberTable::Row& row) {
    return row.scene == scene && !row.printed && !row.spread;
  });
}

}  // namespace

std::string ToHtml(const std::vector<NumberTable>& tables) {
  std::string text;
  for (const NumberTable& table : tables) {
    text += fmt::format(
        "<h3>{}</h3>\n<p class=\"soft small\">{}</p>\n<div class=\"wide\"><table "
        "class=\"grouped by{}\"><thead><tr><th rowspan=\"2\">scene",
        Escape(table.title), Escape(table.caption), table.columns.size());
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
      text += fmt::format("<tr{}><td>{}",
                          row.printed  ? " class=\"printed\""
                          : row.spread ? " class=\"spread\""
                                       : "",
                          Escape(row.name));
      for (const std::string& cell : row.cells) text += "<td>" + Escape(cell);
      text += "\n";
    }
    text += "</tbody></table></div>\n";
  }
  return text;
}

std::string ToMarkdown(const std::vector<NumberTable>& tables) {
  std::string text;
  for (const NumberTable& table : tables) {
    text += fmt::format("## {}\n\n{}\n\n", table.title, table.caption);
    if (const std::string cells = WhatCellsHold(table); !cells.empty()) text += cells + "\n\n";
    text += MarkdownHead(table);
    for (const NumberTable::Row& row : table.rows) {
      if (row.spread || (row.printed && HasMeasured(table, row.scene))) continue;
      for (std::size_t group = 0; group < table.groups.size(); ++group) {
        text += MarkdownRow(table, row, group);
        if (row.printed) continue;
        for (const NumberTable::Row& other : table.rows) {
          if (other.printed && other.scene == row.scene) text += MarkdownRow(table, other, group);
        }
      }
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
