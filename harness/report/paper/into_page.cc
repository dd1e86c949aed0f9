#include "harness/report/paper/into_page.h"

#include <set>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

/// Where the only such line begins.
std::size_t LineOf(const std::string& page, const std::string& file, const std::string& line) {
  const std::size_t at = page.find(line);
  if (at != std::string::npos && page.find(line, at + 1) == std::string::npos) return at;
  throw InputError(fmt::format(
      "{}: the line '{}' {}; expected '{}' and, after it, '{}' once: the tables stand between them",
      file, line, at == std::string::npos ? "is missing" : "is there twice", kTablesBegin,
      kTablesEnd));
}

std::string Heading(const Results& results) {
  const Provenance& from = results.provenance;
  std::set<std::uint64_t> seeds;
  for (const RunRecord& run : results.runs) seeds.insert(run.spec.seed);
  return fmt::format(
      "Suite {}, {} runs, {} seed{}; begun {}; aisle {} ({}) on {}, {} threads:\n\n    {}\n",
      results.suite, results.runs.size(), seeds.size(), seeds.size() == 1 ? "" : "s",
      results.started, from.version, from.commit, from.cpu, from.threads, results.rerun);
}

}  // namespace

std::string WithTables(const std::string& page, const std::string& file, const Results& results) {
  const std::size_t begin = LineOf(page, file, kTablesBegin);
  const std::size_t end = LineOf(page, file, kTablesEnd);
  if (end < begin) {
    throw InputError(fmt::format("{}: '{}' must come before '{}'", file, kTablesBegin, kTablesEnd));
  }
  std::string tables = ToMarkdown(PaperTables(GroupByScene(results)));
  while (tables.ends_with('\n')) tables.pop_back();
  return page.substr(0, begin) + kTablesBegin + "\n\n" + Heading(results) + "\n" + tables + "\n\n" +
         page.substr(end);
}

}  // namespace aisle
