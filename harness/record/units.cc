#include "harness/record/units.h"

#include "harness/io/input_error.h"
#include "harness/score/score_names.h"

namespace aisle {

void CheckUnits(const Results& results, const std::string& file) {
  for (const RunRecord& run : results.runs) {
    for (const auto& [name, score] : run.scores) {
      if (!score.value || !IsScoreName(name) || score.unit == UnitOf(name)) continue;
      throw InputError(
          file, 0,
          fmt::format(
              "{} of the run {} has the unit '{}', which cannot be compared: expected '{}'; "
              "run the suite again with this version of aisle",
              name, Printable(RunId(run.spec)), Printable(score.unit), UnitOf(name)));
    }
  }
}

}  // namespace aisle
