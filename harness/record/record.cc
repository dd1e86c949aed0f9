#include "harness/record/record.h"

#include "harness/io/file.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory.h"
#include "harness/record/evo_result.h"
#include "harness/record/frames_csv.h"
#include "harness/record/provenance.h"

namespace aisle {
namespace fs = std::filesystem;

std::string SafeName(const std::string& name) {
  constexpr std::size_t kMaxLength = 80;
  std::string safe;
  for (const char c : name.substr(0, kMaxLength)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '-' || c == '.';
    safe += plain ? c : c == '/' ? '.' : '_';
  }
  return safe.empty() || safe.front() == '.' ? "_" + safe : safe;
}

std::string RunId(const RunSpec& spec) {
  return fmt::format("{}/{}/{}/{}{}", SafeName(spec.scene), SafeName(spec.twin),
                     SafeName(spec.system.name), spec.seed,
                     spec.repeat > 1 ? fmt::format("r{}", spec.repeat) : "");
}

RunRecord MakeRecord(const RunResult& run, const RunScore& score, double rate_hz) {
  RunRecord record;
  record.spec = run.spec;
  record.status = run.status;
  record.status_why = run.status_why;
  record.frames = run.facts.size();
  record.rate_hz = rate_hz;
  record.wall_s = run.wall_s;
  record.threads = run.threads;
  record.content_hash = fmt::format("{:016x}", run.scene_hash);
  record.scores = score.scores;
  record.notes = score.final.notes;
  record.notes.insert(record.notes.end(), run.notes.begin(), run.notes.end());
  record.system_version = run.system_version;
  record.last_words = run.last_words;
  return record;
}

bool SameProgram(const RunRecord& a, const RunRecord& b) {
  if (a.program == b.program) return true;
  // A tree with changes of its own, or none at all, names no program.
  const bool commit_tells = !a.commit.empty() && a.commit != "unknown" && !a.commit.ends_with('+');
  return commit_tells && a.commit == b.commit;
}

RunRecord WriteRun(const RunResult& run, const RunScore& score, RunRecord record,
                   const fs::path& report_dir) {
  const std::string folder = "runs/" + RunId(run.spec);
  const auto write = [&](const std::string& artifact, const std::string& name,
                         const std::string& text) {
    WriteFileAtomically(report_dir / folder / name, text);
    record.artifacts[artifact] = folder + "/" + name;
  };
  std::uint64_t hash = 0;
  for (const auto& [artifact, name, trajectory] :
       {std::tuple("trajectory_live", "live.txt", &run.trajectory.live),
        std::tuple("trajectory_final", "final.txt", &run.trajectory.final),
        std::tuple("trajectory_truth", "truth.txt", &run.truth)}) {
    const std::string text = FormatTrajectory(*trajectory, TrajectoryFormat::kTum);
    write(artifact, name, text);
    hash = Hash(text, hash);
  }
  record.output_hash = fmt::format("{:016x}", hash);
  if (const std::string zip = EvoResultZip(run, score.final); !zip.empty())
    write("evo", "evo.zip", zip);
  write("frames", "frames.csv", ToCsv(MakeFrameRows(run, score)));
  SayWhoMadeIt(&record);
  WriteFileAtomically(report_dir / folder / "result.json", ToJson(record));
  return record;
}

std::optional<RunRecord> ReadRun(const RunSpec& spec, const fs::path& report_dir) {
  const fs::path path = report_dir / "runs" / RunId(spec) / "result.json";
  if (!fs::exists(path)) return std::nullopt;
  try {
    return RecordFromJson(ReadFile(path), path.string());
  } catch (const InputError&) {
    return std::nullopt;  // not ours, or damaged: as good as absent
  }
}

namespace {

/// A limit ended it that is larger now.
bool MayGetFarther(const RunRecord& record, const RunLimits& now) {
  const bool longer = record.limit_s > 0 && WallLimit_s(now, record.spec.system) > record.limit_s;
  return longer || (record.limit_mib > 0 && now.memory_mib > record.limit_mib);
}

}  // namespace

std::optional<RunRecord> ReadFinishedRun(const RunSpec& spec, const std::string& inputs_hash,
                                         const RunLimits& limits, const fs::path& report_dir) {
  std::optional<RunRecord> record = ReadRun(spec, report_dir);
  if (!record || record->inputs_hash != inputs_hash) return std::nullopt;
  if (MayGetFarther(*record, limits)) return std::nullopt;
  if (record->output_hash.empty()) {  // it never came as far as a trajectory
    // Its process died: by its own fault, or because somebody killed it. A fault shows again.
    return record->status == RunStatus::kCrashed ? std::nullopt : record;
  }
  try {
    std::uint64_t hash = 0;
    for (const char* name : {"live.txt", "final.txt", "truth.txt"}) {
      hash = HashFile(report_dir / "runs" / RunId(spec) / name, hash);
    }
    if (record->output_hash != fmt::format("{:016x}", hash)) return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
  return record;
}

}  // namespace aisle
