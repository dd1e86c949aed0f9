#include "harness/report/summary_csv.h"

namespace aisle {

std::string ToSummaryCsv(const Results& results) {
  std::map<std::string, std::string> units;  // by score name: the union over the runs
  for (const RunRecord& run : results.runs) {
    for (const auto& [name, score] : run.scores) units[name] = score.unit;
  }
  std::string text = "scene,twin,system,seed,status,frames";
  for (const auto& [name, unit] : units) text += "," + name;
  text += "\n";
  for (const RunRecord& run : results.runs) {
    text += fmt::format("{},{},{},{},{},{}", run.spec.scene, run.spec.twin, run.spec.system.name,
                        run.spec.seed, Name(run.status), run.frames);
    for (const auto& [name, unit] : units) {
      const auto score = run.scores.find(name);
      const bool has = score != run.scores.end() && score->second.value;
      text += has ? fmt::format(",{}", *score->second.value) : ",";
    }
    text += "\n";
  }
  return text;
}

}  // namespace aisle
