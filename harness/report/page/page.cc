#include "harness/report/page/page.h"

#include <limits>

#include "harness/report/markup/html.h"
#include "harness/report/page/answer.h"
#include "harness/score/significance.h"

namespace aisle {
namespace {

std::string LinkTo(const SceneRuns& scene, SceneLinks links) {
  return fmt::format("{}{}", links == SceneLinks::kAnchors ? "#" : "", EscapeUrl(ScenePage(scene)));
}

/// The name leads to the page of the scene it is about, where there is one.
std::string VerdictItem(const Verdict& verdict, const std::vector<SceneRuns>& scenes,
                        SceneLinks links) {
  const char* css = verdict.passed ? "pass" : verdict.flaky ? "flaky" : "fail";
  const char* word = verdict.passed ? "held" : verdict.flaky ? "FLAKY" : "BROKEN";
  const auto scene = std::find_if(scenes.begin(), scenes.end(), [&](const SceneRuns& one) {
    return one.scene == verdict.scene && one.twin == verdict.twin;
  });
  const std::string name =
      scene == scenes.end()
          ? Escape(verdict.name)
          : fmt::format("<a href=\"{}\">{}</a>", LinkTo(*scene, links), Escape(verdict.name));
  return fmt::format("<li><span class=\"{}\">{}</span> {}: {}\n", css, word, name,
                     Escape(verdict.why));
}

std::string Headline(std::size_t all, std::size_t broken, std::size_t flaky) {
  if (all == 0) return "Nothing was judged: the suite sets no limits";
  if (broken == 0) return fmt::format("All {} limits held", all);
  std::string text = fmt::format("{} of {} limits broken", broken, all);
  if (flaky > 0) text += fmt::format(", {} of them flaky", flaky);
  return text;
}

std::string StatusCell(const SystemRuns& system) {
  std::size_t good = 0;
  for (const RunRecord* run : system.runs) good += run->status == RunStatus::kOk ? 1 : 0;
  if (good == system.runs.size()) return "";
  const RunRecord& last = *system.runs.back();
  if (system.runs.size() == 1) return fmt::format(" {}", Name(last.status));
  return fmt::format(" {}/{} ok", good, system.runs.size());
}

/// A list whose tail is folded away; `word` says what the tail holds.
std::string List(const std::vector<std::string>& items, const std::string& word) {
  constexpr std::size_t kShownAtOnce = 12;
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i == kShownAtOnce) {
      text +=
          fmt::format("</ul><details><summary>{} more {}</summary><ul>\n", items.size() - i, word);
    }
    text += items[i];
  }
  const bool folded = items.size() > kShownAtOnce;
  return fmt::format("<ul>\n{}</ul>{}\n", text, folded ? "</details>" : "");
}

/// How many runs failed, and what so many runs can say of the next ones.
std::string FailureRate(const std::vector<RunRecord>& runs) {
  const auto failed =
      static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const RunRecord& run) {
        return run.status != RunStatus::kOk && run.status != RunStatus::kLost;
      }));
  constexpr std::size_t kWorthSaying = 20;  // below, the bound is no news
  if (failed == 0 && runs.size() < kWorthSaying) return "";
  return fmt::format(
      "<p class=\"soft small\">{} of {} runs crashed, hung or answered nonsense: 95 % sure, fewer "
      "than {:.2g} % do.</p>\n",
      failed == 0 ? "None" : std::to_string(failed), runs.size(),
      100 * FailureRateBound(failed, runs.size()));
}

/// How far beyond its limit, as a share of it; what has no number is worst.
double Excess(const Verdict& verdict) {
  if (!verdict.value || !verdict.limit) return std::numeric_limits<double>::infinity();
  const double distance = std::abs(*verdict.value - *verdict.limit);
  return distance / std::max(std::abs(*verdict.limit), 1e-12);
}

}  // namespace

std::string Page(const std::string& title, const std::string& root, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self'; "
      "style-src 'self'; script-src 'self'\">\n"
      "<title>{0}</title>\n<link rel=\"stylesheet\" href=\"{1}style.css\">\n"
      "<script src=\"{1}report.js\" defer></script>\n</head>\n<body>\n{2}</body>\n</html>\n",
      Escape(title), root, body);
}

std::string VerdictSection(const Results& results, const std::vector<SceneRuns>& scenes,
                           SceneLinks links) {
  std::vector<Verdict> worst_first = results.verdicts;
  std::stable_sort(worst_first.begin(), worst_first.end(),
                   [](const Verdict& a, const Verdict& b) { return Excess(a) > Excess(b); });
  std::size_t flaky = 0;
  std::vector<std::string> failed, passed;
  for (const Verdict& verdict : worst_first) {
    if (!verdict.passed) failed.push_back(VerdictItem(verdict, scenes, links));
    flaky += verdict.flaky ? 1 : 0;
  }
  for (const Verdict& verdict : results.verdicts) {
    if (verdict.passed) passed.push_back(VerdictItem(verdict, scenes, links));
  }
  const std::size_t all = results.verdicts.size(), broken = failed.size();
  const char* css = all == 0 ? "" : broken > 0 ? "failed" : "passed";
  std::string lists = failed.empty() ? "" : List(failed, "broken, the worst above");
  if (!passed.empty()) {
    const std::string held = List(passed, "held");
    lists += broken == 0 ? held
                         : fmt::format("<details><summary>{} held</summary>{}</details>",
                                       passed.size(), held);
  }
  std::string answer;
  for (const std::string& sentence : AnswerInWords(results)) {
    answer += "<p class=\"answer\">" + Escape(sentence) + "</p>\n";
  }
  return fmt::format(
      "<h1>{}</h1>\n<p class=\"soft\">{}</p>\n{}<div class=\"verdict {}\"><strong>{}</strong>{}"
      "</div>\n{}",
      Escape(results.suite), Escape(results.question), answer, css, Headline(all, broken, flaky),
      lists, FailureRate(results.runs));
}

std::string OverviewSection(const std::vector<SceneRuns>& scenes, SceneLinks links) {
  std::map<int, std::string> systems;  // by color: the order of first appearance
  for (const SceneRuns& scene : scenes) {
    for (const SystemRuns& system : scene.systems) systems[system.color] = system.system;
  }
  std::string text =
      "<h2>Absolute trajectory error</h2>\n<p class=\"soft small\">RMSE over the final track in "
      "centimetres, positions aligned rigidly (SE(3)), never scaled; median over seeds; coverage "
      "where it is not complete. The least of each row is bold.</p>\n<div class=\"wide\"><table>"
      "<tr><th>scene<th class=\"left\">twin";
  for (const auto& [color, name] : systems) {
    text += fmt::format("<th><span class=\"chip c{}\"></span>{}", color % 6, Escape(name));
  }
  text += "\n";
  for (const SceneRuns& scene : scenes) {
    std::optional<double> least;
    for (const SystemRuns& system : scene.systems) {
      const auto value = MedianScore(system.runs, "ate_rmse_m");
      if (value && (!least || *value < *least)) least = value;
    }
    text += fmt::format("<tr><td><a href=\"{}\">{}</a><td class=\"left\">{}", LinkTo(scene, links),
                        Escape(scene.scene), Escape(scene.twin));
    for (const auto& [color, name] : systems) {
      const auto system = std::find_if(scene.systems.begin(), scene.systems.end(),
                                       [&](const SystemRuns& s) { return s.color == color; });
      if (system == scene.systems.end()) {
        text += "<td class=\"soft\">";
        continue;
      }
      const auto ate = MedianScore(system->runs, "ate_rmse_m");
      const auto coverage = MedianScore(system->runs, "coverage");
      std::string cell = ate ? fmt::format("{:.2f}", 100 * *ate) : "-";
      if (coverage && *coverage < 0.9995) cell += fmt::format(" ({:.1f} %)", 100 * *coverage);
      cell += StatusCell(*system);
      text += fmt::format("<td class=\"{}\">{}", ate && ate == least ? "best" : "", cell);
    }
    text += "\n";
  }
  return text + "</table></div>\n";
}

std::string ProvenanceFooter(const Results& results) {
  const Provenance& from = results.provenance;
  return fmt::format(
      "<h2>Again</h2>\n<pre>{}</pre>\n<footer>aisle {} ({}) on {}, {} threads, {}. Started {}, "
      "took "
      "{:.0f} s. Numbers: <a href=\"results.json\">results.json</a>, <a "
      "href=\"summary.csv\">summary.csv</a>, <a href=\"junit.xml\">junit.xml</a>, tables as <a "
      "href=\"tables.md\">Markdown</a> and <a href=\"tables.tex\">LaTeX</a>.</footer>\n",
      Escape(results.rerun), Escape(from.version), Escape(from.commit), Escape(from.cpu),
      from.threads, Escape(from.os), Escape(results.started), results.wall_s);
}

std::string ScenePage(const SceneRuns& scene) {
  return fmt::format("scene_{}_{}.html", SafeName(scene.scene), SafeName(scene.twin));
}

}  // namespace aisle
