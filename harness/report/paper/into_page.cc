#include "harness/report/paper/into_page.h"

#include <set>

#include "harness/report/paper/tables.h"

namespace aisle {

std::string WithTables(const std::string& page, const BlockPlace& place, const Results& results) {
  std::set<std::uint64_t> seeds;
  for (const RunRecord& run : results.runs) seeds.insert(run.spec.seed);
  const std::string of =
      fmt::format("Suite {}, {} runs, {} seed{}.\n\n", results.suite, results.runs.size(),
                  seeds.size(), seeds.size() == 1 ? "" : "s");
  return WithBlock(page, place,
                   of + ToMarkdown(PaperTables(GroupByScene(results))) + "\n" +
                       BlockFoot(results.provenance, results.rerun, results.started));
}

}  // namespace aisle
