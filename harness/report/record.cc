#include "harness/report/record.h"

#include "harness/io/file.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory.h"
#include "harness/report/evo_result.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Of the truth's frames, by index: where the estimate lies after alignment and how far off.
struct TrackOnTruth {
  std::vector<std::optional<Eigen::Vector3d>> position_m;
  std::vector<std::optional<double>> error_m;
};

TrackOnTruth LayOnTruth(const Trajectory& truth, const Trajectory& estimate,
                        const ScoreOptions& options) {
  TrackOnTruth track{std::vector<std::optional<Eigen::Vector3d>>(truth.size()),
                     std::vector<std::optional<double>>(truth.size())};
  const TrajectoryScore score = ScoreTrajectory(truth, estimate, options);
  for (const PoseError& error : score.errors) {
    const StampedPose& pose = estimate[error.pair.estimate];
    track.position_m[error.pair.truth] = Apply(score.alignment, pose.T_world_rig).translation();
    track.error_m[error.pair.truth] = error.translation_m;
  }
  return track;
}

std::optional<double> MaskIou(const std::optional<MaskFacts>& mask) {
  if (!mask) return std::nullopt;
  const auto whole =
      static_cast<double>(mask->true_positives + mask->false_positives + mask->false_negatives);
  if (whole == 0) return std::nullopt;
  return static_cast<double>(mask->true_positives) / whole;
}

}  // namespace

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
  return fmt::format("{}/{}/{}/{}", SafeName(spec.scene), SafeName(spec.twin),
                     SafeName(spec.system), spec.seed);
}

RunRecord MakeRecord(const RunResult& run, double rate_hz, const ScoreOptions& options) {
  RunRecord record;
  record.spec = run.spec;
  record.status = run.status;
  record.status_why = run.status_why;
  record.frames = run.facts.size();
  record.rate_hz = rate_hz;
  record.wall_s = run.wall_s;
  record.threads = run.threads;
  record.content_hash = fmt::format("{:016x}", run.scene_hash);
  record.scores = ScoreRun(run, options);
  record.notes = ScoreTrajectory(run.truth, run.trajectory.final, options).notes;
  return record;
}

std::vector<FrameRow> MakeFrameRows(const RunResult& run, const ScoreOptions& options) {
  const bool has_truth = run.truth.size() == run.facts.size();
  const Trajectory truth = has_truth ? run.truth : Trajectory{};
  const TrackOnTruth live = LayOnTruth(truth, run.trajectory.live, options);
  const TrackOnTruth final = LayOnTruth(truth, run.trajectory.final, options);
  std::vector<FrameRow> rows;
  for (std::size_t i = 0; i < run.facts.size(); ++i) {
    const FrameFacts& facts = run.facts[i];
    FrameRow row{
        .id = run.estimates[i].id,
        .stamp_ns = facts.stamp_ns,
        .state = run.estimates[i].state,
        .truth_m = facts.T_world_rig.translation(),
        .movers_share = facts.movers_share,
        .actors_share = facts.actors_share,
        .features = facts.features,
        .features_on_movers = facts.features_on_movers,
        .inliers_on_movers = facts.inliers_on_movers,
        .mask_iou = MaskIou(facts.mask),
        .corners_rejected = facts.mask ? std::optional(facts.mask->corners_rejected) : std::nullopt,
        .difficulty = facts.difficulty,
        .render_ms = facts.render_ms,
        .process_ms = facts.process_ms};
    if (has_truth) {
      row.live_m = live.position_m[i];
      row.live_error_m = live.error_m[i];
      row.final_m = final.position_m[i];
      row.final_error_m = final.error_m[i];
    }
    rows.push_back(row);
  }
  return rows;
}

FrameFile ReadFrameFile(const RunRecord& run, const fs::path& report_dir) {
  const auto artifact = run.artifacts.find("frames");
  if (artifact == run.artifacts.end()) return {};
  const fs::path path = report_dir / artifact->second;
  if (!fs::exists(path)) return {};
  try {
    return {FrameRowsFromCsv(ReadFile(path), path.string()), ""};
  } catch (const InputError& error) {
    return {{}, error.what()};
  }
}

RunRecord WriteRun(const RunResult& run, RunRecord record, const fs::path& report_dir) {
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
  if (const std::string zip = EvoResultZip(run); !zip.empty()) write("evo", "evo.zip", zip);
  write("frames", "frames.csv", ToCsv(MakeFrameRows(run)));
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

std::optional<RunRecord> ReadFinishedRun(const RunSpec& spec, const std::string& inputs_hash,
                                         const fs::path& report_dir) {
  std::optional<RunRecord> record = ReadRun(spec, report_dir);
  if (!record || record->inputs_hash != inputs_hash) return std::nullopt;
  if (record->output_hash.empty()) return record;  // it never came as far as a trajectory
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

std::vector<std::string> DifferentBits(const RunRecord& a, const RunRecord& b) {
  std::vector<std::string> lines;
  const auto compare = [&](const std::string& what, const std::string& x, const std::string& y) {
    if (x != y) lines.push_back(fmt::format("{}: {} and {}", what, x, y));
  };
  compare("status", Name(a.status), Name(b.status));
  compare("content hash", a.content_hash, b.content_hash);
  compare("trajectories", a.output_hash, b.output_hash);
  for (const auto& [name, score] : a.scores) {
    if (name.starts_with("ms_") || name == "peak_rss_mib") continue;
    const auto other = b.scores.find(name);
    if (other == b.scores.end()) {
      // Penalties are ratios to a twin's run: a run on its own has none.
      if (name != "dynamic_penalty") lines.push_back(name + ": missing in one");
    } else if (score.value != other->second.value) {
      lines.push_back(fmt::format("{}: {} and {}", name, ToText(score), ToText(other->second)));
    }
  }
  return lines;
}

}  // namespace aisle
