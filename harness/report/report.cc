#include "harness/report/report.h"

#include "harness/io/file.h"
#include "harness/report/junit.h"
#include "harness/report/page/cost_section.h"
#include "harness/report/page/page.h"
#include "harness/report/page/resources.h"
#include "harness/report/paper/paper_page.h"
#include "harness/report/paper/tables.h"
#include "harness/report/summary_csv.h"

namespace aisle {
namespace {

// Up to here everything stands on one page: a reader of a small suite need not click.
constexpr std::size_t kScenesOnOnePage = 2;

bool HasPrinted(const std::vector<NumberTable>& tables) {
  return std::any_of(tables.begin(), tables.end(), [](const NumberTable& table) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [](const NumberTable::Row& row) { return row.printed; });
  });
}

}  // namespace

void WriteReport(const Results& results, const std::filesystem::path& report_dir) {
  const std::vector<SceneRuns> scenes = GroupByScene(results);
  const bool own_pages = scenes.size() > kScenesOnOnePage;
  const SceneLinks links = own_pages ? SceneLinks::kPages : SceneLinks::kAnchors;
  std::string body = VerdictSection(results, scenes, links) + OverviewSection(scenes, links);
  body += CostSection(scenes);
  const std::vector<NumberTable> tables = PaperTables(scenes);
  if (const std::string paper = PaperPage(scenes, report_dir); !paper.empty()) {
    const std::string up = "<p><a href=\"index.html\">back to the verdict</a></p>\n";
    WriteFileAtomically(report_dir / "paper.html",
                        Page("the paper's experiment beside ours", "", up + paper));
    body +=
        "<h2>The paper's experiment</h2>\n<p><a href=\"paper.html\">Its tables and figures beside "
        "ours, on one page</a></p>\n";
  } else if (!tables.empty()) {
    body += "<h2>The tables of the paper, with our numbers</h2>\n";
    if (HasPrinted(tables)) {
      body +=
          "<p class=\"soft small\">In italics what the paper printed, of its own drives (DynaSLAM "
          "under semantic): the order of the systems can be compared, not the size of the "
          "numbers.</p>\n";
    }
    body += ToHtml(tables);
  }
  for (const SceneRuns& scene : scenes) {
    const std::string section = SceneSection(scene, report_dir, "");
    if (own_pages) {
      const std::string up = "<p><a href=\"index.html\">back to the verdict</a></p>\n";
      WriteFileAtomically(report_dir / ScenePage(scene),
                          Page(scene.scene + " " + scene.twin, "", up + section));
    } else {
      body += section;
    }
  }
  if (std::filesystem::exists(report_dir / "trends.html")) {
    body += "<p><a href=\"trends.html\">How the nights went</a></p>\n";
  }
  body += ProvenanceFooter(results);
  WriteResources(report_dir);
  WriteFileAtomically(report_dir / "tables.md", ToMarkdown(tables));
  WriteFileAtomically(report_dir / "tables.tex", ToLatex(tables));
  WriteFileAtomically(report_dir / "index.html", Page(results.suite, "", body));
  WriteFileAtomically(report_dir / "summary.csv", ToSummaryCsv(results));
  WriteFileAtomically(report_dir / "junit.xml", ToJunit(results));
  WriteFileAtomically(report_dir / "results.json", ToJson(results));
}

}  // namespace aisle
