#include "harness/report/junit.h"

#include <pugixml.hpp>
#include <sstream>

#include "harness/io/places.h"
#include "harness/io/shell_word.h"
#include "harness/record/group.h"
#include "harness/report/markup/html.h"

namespace aisle {
namespace {

/// XML 1.0 (section 2.2) has no way to write most control bytes, U+FFFE and U+FFFF: they are left
/// out. Bytes that are no UTF-8 are replaced. One of them would cost the reader every verdict.
std::string XmlText(const std::string& text) {
  std::string clean;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = CharacterLength(text, at);
    const std::string character = length == 0 ? "\xEF\xBF\xBD" : text.substr(at, length);
    const auto first = static_cast<unsigned char>(character[0]);
    const bool is_control = first < 0x20 && first != '\n' && first != '\t';
    const bool is_none = character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
    if (!is_control && !is_none) clean += character;
    at += std::max<std::size_t>(length, 1);
  }
  return clean;
}

void Set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(XmlText(value).c_str());
}

void AddCase(pugi::xml_node suite, const Results& results, const Verdict& verdict,
             const std::filesystem::path& report_dir) {
  const std::size_t colon = verdict.name.rfind(": ");
  pugi::xml_node test = suite.append_child("testcase");
  Set(test, "classname", results.suite + "." + verdict.name.substr(0, colon));
  Set(test, "name", colon == std::string::npos ? verdict.name : verdict.name.substr(colon + 2));
  if (verdict.passed) return;
  pugi::xml_node failure = test.append_child("failure");
  Set(failure, "type", verdict.flaky ? "flaky" : "limit");
  Set(failure, "message", verdict.why);
  failure.text().set(XmlText(FailureText(verdict, results, report_dir)).c_str());
}

/// A run that came to its end, with its time: a suite without limits still says what it did. Those
/// that did not have a verdict of the same name.
void AddRun(pugi::xml_node suite, const Results& results, const RunRecord& run) {
  pugi::xml_node test = suite.append_child("testcase");
  Set(test, "classname", results.suite + "." + RunId(run.spec));
  Set(test, "name", "completes");
  Set(test, "time", fmt::format("{:.1f}", run.wall_s));
}

void AddProperties(pugi::xml_node suite, const Results& results) {
  pugi::xml_node properties = suite.append_child("properties");
  const std::pair<const char*, std::string> named[] = {
      {"version", results.provenance.version},
      {"commit", results.provenance.commit},
      {"cpu", results.provenance.cpu},
      {"runs", std::to_string(results.runs.size())}};
  for (const auto& [name, value] : named) {
    pugi::xml_node property = properties.append_child("property");
    Set(property, "name", name);
    Set(property, "value", value);
  }
}

}  // namespace

std::vector<const RunRecord*> RunsOf(const Verdict& verdict, const Results& results) {
  std::vector<const RunRecord*> runs;
  for (const RunRecord& run : results.runs) {
    if (verdict.name == RunId(run.spec) + ": completes") return {&run};
    if (run.spec.scene == verdict.scene && run.spec.twin == verdict.twin &&
        run.spec.system.name == verdict.system) {
      runs.push_back(&run);
    }
  }
  return runs;
}

std::string FailureText(const Verdict& verdict, const Results& results,
                        const std::filesystem::path& report_dir) {
  std::string text = verdict.name + "\n" + verdict.why + "\n";
  const RunRecord* run = WorstRun(RunsOf(verdict, results));
  if (run != nullptr) {
    text += fmt::format("rerun: {} rerun {} --in {}\n", OwnCommand(), ShellWord(RunId(run->spec)),
                        ShellWord(report_dir.string()));
    if (!run->last_words.empty()) text += "its last words:\n" + run->last_words;
  }
  return text + "all of it: " + results.rerun;
}

std::string ToJunit(const Results& results, const std::filesystem::path& report_dir) {
  std::size_t failures = 0;
  for (const Verdict& verdict : results.verdicts) failures += verdict.passed ? 0 : 1;
  const auto completed = static_cast<std::size_t>(
      std::count_if(results.runs.begin(), results.runs.end(),
                    [](const RunRecord& run) { return IsComplete(run.status); }));
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("testsuites");
  pugi::xml_node suite = root.append_child("testsuite");
  for (pugi::xml_node node : {root, suite}) {
    Set(node, "name", results.suite);
    Set(node, "tests", std::to_string(results.verdicts.size() + completed));
    Set(node, "failures", std::to_string(failures));
    Set(node, "errors", "0");
    Set(node, "skipped", "0");
    Set(node, "time", fmt::format("{:.1f}", results.wall_s));
  }
  Set(suite, "timestamp", results.started);
  AddProperties(suite, results);
  for (const Verdict& verdict : results.verdicts) AddCase(suite, results, verdict, report_dir);
  for (const RunRecord& run : results.runs) {
    if (IsComplete(run.status)) AddRun(suite, results, run);
  }
  std::ostringstream text;
  document.save(text, " ");
  return text.str();
}

}  // namespace aisle
