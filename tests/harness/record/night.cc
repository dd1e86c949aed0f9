#include "tests/harness/record/night.h"

#include "harness/io/image.h"

namespace aisle {

RunResult MakeRun(const std::string& scene, const std::string& system, std::uint64_t seed,
                  double push_m, std::size_t frames) {
  RunResult run;
  run.spec = {.scene = scene,
              .scene_file = "scenes/" + scene + ".yaml",
              .twin = "live",
              .system = BuiltIn(system),
              .seed = seed};
  for (int k = 0; k < static_cast<int>(frames); ++k) {
    const double s = k / 20.0;
    const double movers = std::max(0.0, 0.3 - 0.05 * std::abs(s - 7));
    const double jitter = 1e-3 * static_cast<double>((k * 7919 + 31 * static_cast<int>(seed)) % 17);
    Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
    truth.translation() << 0.9 * s, 0.2 * std::sin(0.4 * s), 1.1;
    Eigen::Isometry3d estimated = truth;
    estimated.translation().y() +=
        push_m * (movers > 0.05 ? movers : 0.02 * std::sin(3 * s)) + 0.2 * jitter;
    FrameEstimate estimate;
    estimate.id = k;
    estimate.stamp_ns = k * 50'000'000LL;
    estimate.state = TrackingState::kTracking;
    estimate.T_world_rig = estimated;
    estimate.stage_ms = {{"extract", 14.0 + k % 3}, {"stereo", 6}, {"track", 4}, {"map", 9}};
    FrameFacts facts;
    facts.stamp_ns = estimate.stamp_ns;
    facts.T_world_rig = truth;
    facts.movers_share = movers;
    facts.difficulty = {.static_texture_share = 0.4 - movers,
                        .flow_px = 5 + 100 * jitter,
                        .blur_px = 1 + 20 * jitter,
                        .parallax_px = 3 + 50 * jitter};
    facts.features = 1000;
    facts.features_on_movers = system == "oracle" ? 0 : static_cast<int>(900 * movers);
    facts.render_ms = 180;
    facts.process_ms = 35;
    if (system == "oracle") {
      facts.mask.emplace();
      facts.mask->corners_rejected = static_cast<int>(900 * movers);
      facts.mask->true_positives = static_cast<std::int64_t>(1000 * movers);
    }
    run.truth.push_back({estimate.stamp_ns, truth});
    run.trajectory.live.push_back({estimate.stamp_ns, estimated});
    run.estimates.push_back(estimate);
    run.facts.push_back(facts);
  }
  run.trajectory.final = run.trajectory.live;
  return run;
}

void AddPictures(const std::filesystem::path& folder, RunRecord* record) {
  const std::string runs = "runs/" + RunId(record->spec);
  int number = 0;
  for (const int frame : {20, 60, 100, 140}) {
    const std::string name =
        fmt::format("{}/frame_{:06}{}.jpg", runs, frame, frame == 140 ? "_worst_error" : "");
    WriteImage(folder / name, cv::Mat1b(126, 188, static_cast<unsigned char>(60 + frame)));
    record->artifacts[fmt::format("picture_{:04}", number++)] = name;
  }
}

Results MakeNight(const NightOptions& options, const std::filesystem::path& folder) {
  Results results;
  results.provenance = {"0.1.0", "abc1234", "some processor", "Debian", 2};
  results.suite = "night";
  results.question = "What got worse since yesterday?";
  results.started = "2026-01-31T02:00:00Z";
  results.rerun = "./aisle run scenes/suites/nightly.yaml";
  for (const std::string& system : options.systems) {
    for (std::uint64_t seed = 1; seed <= options.seeds; ++seed) {
      const double push_m =
          (system == "oracle" ? 0.02 : 0.3) * (1 + 0.1 * static_cast<double>(seed));
      RunResult run = MakeRun("", system, seed, push_m, options.frames);
      const RunScore score = ScoreRun(run);
      RunRecord record = MakeRecord(run, score, 20);
      for (std::size_t scene = 1; scene <= options.scenes; ++scene) {
        run.spec.scene = record.spec.scene = fmt::format("paper/scene{}", scene);
        RunRecord shown = record;
        if (options.pictures) AddPictures(folder, &shown);
        results.runs.push_back(WriteRun(run, score, shown, folder));
      }
    }
  }
  return results;
}

}  // namespace aisle
