#include "harness/report/paper/into_page.h"

#include <fmt/ranges.h>

#include <set>

#include "harness/io/input_error.h"
#include "harness/report/paper/tables.h"

namespace aisle {

namespace {

std::vector<NumberTable> Titled(std::vector<NumberTable> tables, const std::string& titled) {
  std::vector<std::string> titles;
  for (const NumberTable& table : tables) titles.push_back(table.title);
  std::erase_if(tables, [&](const NumberTable& table) {
    return table.title.find(titled) == std::string::npos;
  });
  if (tables.empty()) {
    throw InputError(fmt::format("no table's title holds '{}'; there are: {}", Printable(titled),
                                 fmt::join(titles, "; ")));
  }
  return tables;
}

}  // namespace

std::string WithTables(const std::string& page, const BlockPlace& place, const Results& results,
                       const std::string& titled) {
  std::set<std::uint64_t> seeds;
  for (const RunRecord& run : results.runs) seeds.insert(run.spec.seed);
  const std::string of =
      fmt::format("Suite {}, {} runs, {} seed{}.\n\n", results.suite, results.runs.size(),
                  seeds.size(), seeds.size() == 1 ? "" : "s");
  return WithBlock(page, place,
                   of + ToMarkdown(Titled(PaperTables(GroupByScene(results)), titled)) +
                       BlockFoot(results.provenance, results.rerun, results.started));
}

}  // namespace aisle
