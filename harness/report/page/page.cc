#include "harness/report/page/page.h"

#include "harness/report/markup/html.h"
#include "harness/report/page/scene_section.h"

namespace aisle {
namespace {

/// The text between the tags of a piece of markup.
std::string WithoutTags(const std::string& markup) {
  std::string text;
  bool in_tag = false;
  for (const char c : markup) {
    in_tag = in_tag || c == '<';
    if (!in_tag) text += c;
    in_tag = in_tag && c != '>';
  }
  return text;
}

/// What the page holds, from its headings that can be led to; nothing below three of them.
std::string Contents(const std::string& body) {
  constexpr int kWorthIt = 3;
  constexpr std::size_t kBegin = 8;  // of "<h2 id=\""
  std::string items;
  int count = 0;
  for (std::size_t at = 0; (at = body.find("<h", at)) != std::string::npos; ++at) {
    const char level = at + kBegin < body.size() ? body[at + 2] : '0';
    if ((level != '2' && level != '3') || body.compare(at + 3, 5, " id=\"") != 0) continue;
    const std::size_t quote = body.find("\">", at + kBegin), end = body.find("</h", at);
    if (quote == std::string::npos || end == std::string::npos || end < quote) break;
    items += fmt::format("<li class=\"level{}\"><a href=\"#{}\">{}</a>\n", level,
                         body.substr(at + kBegin, quote - at - kBegin),
                         WithoutTags(body.substr(quote + 2, end - quote - 2)));
    ++count;
  }
  if (count < kWorthIt) return "";
  return "<nav class=\"contents\" aria-label=\"contents\"><ul>\n" + items + "</ul></nav>\n";
}

}  // namespace

std::string LinkTo(const SceneRuns& scene, SceneLinks links) {
  const std::string page = EscapeUrl(ScenePage(scene));
  return links == SceneLinks::kAnchors ? fmt::format("#{}", page) : page;
}

std::string Page(const std::string& title, const std::string& root, const std::string& body) {
  const std::string contents = Contents(body);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self'; "
      "style-src 'self'; script-src 'self'\">\n"
      "<title>{0}</title>\n<link rel=\"stylesheet\" href=\"{1}style.css\">\n"
      "<script src=\"{1}report.js\" defer></script>\n</head>\n<body>\n{2}<main>\n{3}</main>\n"
      "</body>\n</html>\n",
      Escape(title), root, contents, body);
}

std::string ProvenanceFooter(const Results& results) {
  const Provenance& from = results.provenance;
  return fmt::format(
      "<h2 id=\"again\">Again</h2>\n<pre>{}</pre>\n<footer>aisle {} ({}) on {}, {} threads, {}. "
      "Started {}, "
      "took "
      "{:.0f} s. Numbers: <a href=\"results.json\">results.json</a>, <a "
      "href=\"summary.csv\">summary.csv</a>, <a href=\"summary.txt\">summary.txt</a>, <a "
      "href=\"junit.xml\">junit.xml</a>, tables as <a "
      "href=\"tables.md\">Markdown</a> and <a href=\"tables.tex\">LaTeX</a>.</footer>\n",
      Escape(results.rerun), Escape(from.version), Escape(from.commit), Escape(from.cpu),
      from.threads, Escape(from.os), Escape(results.started), results.wall_s);
}

}  // namespace aisle
