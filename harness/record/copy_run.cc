#include "harness/record/copy_run.h"

#include "harness/io/file.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Whole under its name, whatever its size: bags are larger than what is read at once.
void CopyFile(const fs::path& from, const fs::path& to) {
  FileAside copy(to);
  ReadInPieces(from, [&](std::string_view piece) { copy.Append(piece); });
  copy.Commit();
}

/// All files of a run but its result and those in `without`.
void CopyFiles(const fs::path& from, const fs::path& to, const std::set<fs::path>& without = {}) {
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    const fs::path file = entry.path().lexically_relative(from);
    if (!entry.is_regular_file() || file == "result.json" || without.contains(file)) continue;
    CopyFile(entry.path(), to / file);
  }
}

}  // namespace

void CopyRun(const RunSpec& spec, const fs::path& from, const fs::path& to) {
  const fs::path source = from / "runs" / RunId(spec), target = to / "runs" / RunId(spec);
  const std::string result = ReadFile(source / "result.json");
  CopyFiles(source, target);
  WriteFileAtomically(target / "result.json", result);
}

void CopyRunAs(const RunSpec& from, const RunSpec& to, const std::string& hall,
               const fs::path& report_dir) {
  const fs::path source = fs::path("runs") / RunId(from), target = fs::path("runs") / RunId(to);
  const fs::path result = report_dir / source / "result.json";
  RunRecord record = RecordFromJson(ReadFile(result), result.string());
  record.spec = to;
  record.hall = hall;
  record.notes.push_back("the inputs equal those of " + RunId(from) + ": run once for both");
  for (auto& [name, path] : record.artifacts) {
    path = (target / fs::path(path).lexically_relative(source)).string();
  }
  CopyFiles(report_dir / source, report_dir / target, {"job.json"});
  WriteFileAtomically(report_dir / target / "result.json", ToJson(record));
}

}  // namespace aisle
