#include "harness/report/block/markdown_text.h"
#include "harness/report/markup/html.h"
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
