#include "harness/cli/night_baseline.h"

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/judge/gate.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

fs::path PathOf(const fs::path& out) { return out / "baseline.json"; }

}  // namespace

void WriteNightBaseline(const Results& baseline, const fs::path& out) {
  WriteFileAtomically(PathOf(out), ToJson(baseline));
}

Results ReadNightBaseline(const fs::path& out) {
  if (!fs::exists(PathOf(out))) {
    throw InputError(PathOf(out).string(), 0,
                     "missing: the report was run with --gate and needs it");
  }
  return ResultsFromJson(ReadFile(PathOf(out)), PathOf(out).string());
}

void HoldAgainstBaseline(const Results& baseline, Results* results) {
  for (Verdict& verdict : GateVerdicts(baseline, *results)) {
    results->verdicts.push_back(std::move(verdict));
  }
}

}  // namespace aisle
