#include "harness/record/evo_result.h"

#include "harness/common/seconds.h"
#include "harness/io/trajectory.h"
#include "harness/io/zip.h"
#include "harness/record/record_json.h"
#include "harness/score/statistics.h"

namespace aisle {

std::string EvoResultZip(const RunResult& run, const TrajectoryScore& final) {
  const Trajectory& estimate = run.trajectory.final;
  if (final.errors.empty()) return {};
  std::vector<double> stamps_s, since_start_s;
  Trajectory aligned;
  for (const PoseError& error : final.errors) {
    const StampedPose& pose = estimate[error.pair.estimate];
    aligned.push_back({pose.stamp_ns, Apply(final.alignment, pose.T_world_rig)});
    stamps_s.push_back(ToSeconds(pose.stamp_ns));
    since_start_s.push_back(stamps_s.back() - stamps_s.front());
  }
  const std::vector<double> errors = Translations(final.errors);
  const Statistics s = Summarize(errors);
  const nlohmann::ordered_json info = {{"title", "APE w.r.t. translation part (m)\n(alignment: " +
                                                     final.scores.at("ate_rmse_m").alignment +
                                                     ", association: " + final.association + ")"},
                                       {"label", "APE (m)"},
                                       {"ref_name", "truth"},
                                       {"est_name", run.spec.system.name}};
  const nlohmann::ordered_json stats = {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median},
                                        {"std", s.std},   {"min", s.min},   {"max", s.max},
                                        {"sse", s.sse}};
  return MakeZip({{"info.json", Dump(info)},
                  {"stats.json", Dump(stats)},
                  {"error_array.npy", MakeNpy(errors)},
                  {"timestamps.npy", MakeNpy(stamps_s)},
                  {"seconds_from_start.npy", MakeNpy(since_start_s)},
                  {"estimate.tum", FormatTrajectory(aligned, TrajectoryFormat::kTum)},
                  {"truth.tum", FormatTrajectory(run.truth, TrajectoryFormat::kTum)}});
}

}  // namespace aisle
