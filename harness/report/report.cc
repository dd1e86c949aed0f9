#include "harness/report/report.h"

#include "harness/io/file.h"
#include "harness/report/junit.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/answer.h"
#include "harness/report/page/cost_section.h"
#include "harness/report/page/drive_outcome.h"
#include "harness/report/page/hall_section.h"
#include "harness/report/page/overview_section.h"
#include "harness/report/page/page.h"
#include "harness/report/page/resources.h"
#include "harness/report/page/scene_section.h"
#include "harness/report/page/trends.h"
#include "harness/report/page/verdict_section.h"
#include "harness/report/paper/paper_page.h"
#include "harness/report/paper/printed.h"
#include "harness/report/paper/tables.h"
#include "harness/report/summary_csv.h"
#include "harness/report/summary_text.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

// Up to here everything stands on one page: a reader of a small suite need not click.
constexpr std::size_t kScenesOnOnePage = 2;
constexpr const char* kUp = "<p><a href=\"index.html\">back to the verdict</a></p>\n";

/// Which paper the captions of the tables speak of.
std::string ThePaper() {
  return fmt::format("\"The paper\" of these tables is {}.\n\n", kThePaper);
}

/// The tables of the paper belong to its own experiment; elsewhere they are files alone.
std::string PaperLink(const std::vector<SceneRuns>& scenes, const fs::path& report_dir) {
  const std::string paper = PaperPage(scenes, report_dir);
  if (paper.empty()) return "";
  WriteFileAtomically(report_dir / "paper.html",
                      Page("the paper's experiment beside ours", "", kUp + paper));
  return "<h2 id=\"paper\">The paper's experiment</h2>\n<p><a href=\"paper.html\">Its tables and "
         "figures beside ours, on one page</a></p>\n";
}

/// True where there is a page of how the nights went, now or from before.
bool WriteTrends(const Results& results, const fs::path& report_dir, const ReportOptions& options) {
  const std::string trends = TrendSection(
      options.history,
      {.history_dir = options.history_file.parent_path(), .suite_file = results.suite_file});
  if (trends.empty()) return fs::exists(report_dir / "trends.html");
  WriteFileAtomically(report_dir / "trends.html",
                      Page("Trends of " + ReportTitle(results), "", kUp + trends));
  return true;
}

/// Each scene's section: on pages of their own, or one after the other as it comes back.
std::string WriteScenes(const std::vector<SceneRuns>& scenes, const fs::path& report_dir,
                        bool own_pages) {
  std::string sections;
  for (const SceneRuns& scene : scenes) {
    const std::string section = SceneSection(scene, report_dir, "");
    if (own_pages) {
      WriteFileAtomically(report_dir / ScenePage(scene),
                          Page(scene.scene + " " + scene.twin, "", kUp + section));
    } else {
      sections += section;
    }
  }
  return sections;
}

}  // namespace

void WriteReport(const Results& results, const fs::path& report_dir, const ReportOptions& options) {
  const std::vector<SceneRuns> scenes = GroupByScene(results);
  const bool own_pages = scenes.size() > kScenesOnOnePage;
  const SceneLinks links = own_pages ? SceneLinks::kPages : SceneLinks::kAnchors;
  const bool trends = WriteTrends(results, report_dir, options);
  std::string body =
      VerdictSection(results, scenes, links, SinceWhen(options.history), options.limits);
  if (trends) body += "<p><a href=\"trends.html\">How the nights went</a></p>\n";
  if (!options.history_trouble.empty()) {
    body += fmt::format("<p class=\"trouble\">The trends do not include this run: {}</p>\n",
                        Escape(options.history_trouble));
  }
  if (const std::string drives = DriveOverview(scenes, links); !drives.empty()) {
    body += "<section>" + drives + "</section>\n";
  }
  body += "<div class=\"sections\"><section>" + OverviewSection(scenes, links) +
          "</section>\n<section>" + CostSection(scenes) + "</section></div>\n";
  body += HallSection(scenes) + PaperLink(scenes, report_dir) +
          WriteScenes(scenes, report_dir, own_pages);
  body += SystemsSection(scenes, options.systems) + ProvenanceFooter(results);
  const std::vector<NumberTable> tables = PaperTables(scenes);
  WriteResources(report_dir);
  WriteFileAtomically(report_dir / "tables.md", ThePaper() + ToMarkdown(tables));
  WriteFileAtomically(report_dir / "tables.tex", "% " + ThePaper() + ToLatex(tables));
  WriteFileAtomically(report_dir / "index.html", Page(ReportTitle(results), "", body));
  WriteFileAtomically(report_dir / "summary.csv", ToSummaryCsv(results));
  WriteFileAtomically(
      report_dir / "summary.txt",
      ToSummaryText(results, ChangesInWords(options.history), report_dir, options.limits));
  WriteFileAtomically(report_dir / "junit.xml", ToJunit(results, report_dir));
  WriteFileAtomically(report_dir / "results.json", ToJson(results));
}

}  // namespace aisle
