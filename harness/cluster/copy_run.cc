#include "harness/cluster/copy_run.h"

#include "harness/io/file.h"
#include "harness/record/record.h"

namespace aisle {

namespace fs = std::filesystem;

void CopyRun(const RunSpec& spec, const fs::path& from, const fs::path& to) {
  const fs::path source = from / "runs" / RunId(spec), target = to / "runs" / RunId(spec);
  const std::string result = ReadFile(source / "result.json");
  for (const auto& entry : fs::recursive_directory_iterator(source)) {
    if (!entry.is_regular_file() || entry.path().filename() == "result.json") continue;
    WriteFileAtomically(target / entry.path().lexically_relative(source), ReadFile(entry.path()));
  }
  WriteFileAtomically(target / "result.json", result);
}

}  // namespace aisle
