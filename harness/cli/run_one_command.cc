// One run in a process of its own: what `aisle run` starts for every cell of a suite.
#include <opencv2/imgproc.hpp>

#include "harness/cli/command.h"
#include "harness/cli/external.h"
#include "harness/cli/places.h"
#include "harness/plugs/cached_sequence.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/systems.h"
#include "harness/record/record.h"
#include "harness/report/picture/samples.h"
#include "harness/report/picture/stage_sheets.h"
#include "harness/report/picture/video.h"
#include "harness/run/drive.h"

namespace aisle {
namespace {

constexpr std::size_t kFilmEvery = 2;  ///< frames: half the rate is enough to see what happened

struct Options {
  RunSpec spec;
  std::string out;
  std::string frames;       ///< folder of the shared frames; empty: none are kept
  std::string inputs_hash;  ///< of all that decides the run; filed with its result
  int threads = 0;
  bool video = true;
  bool debug_dynamic = false;
  ExternalSystem external;  ///< without a command: the system is one of ours
  std::string like;         ///< the system of ours that is told spoilt masks; empty: none
  std::vector<double> mask_errors;
  std::string dataset;  ///< folder of the dataset that is exported for it
};

SimulatedSequenceOptions SimulationOf(const Options& options) {
  return {.scene_file = options.spec.scene_file,
          .scene_name = options.spec.scene,
          .assets_dir = AssetsDir().string(),
          .twin = options.spec.twin,
          .seed = options.spec.seed,
          .threads = options.threads};
}

std::unique_ptr<Sequence> OpenSequence(const Options& options, std::uint64_t* content_hash) {
  const SimulatedSequenceOptions simulation = SimulationOf(options);
  const auto open = [simulation](std::uint64_t* hash) { return OpenSimulation(simulation, hash); };
  if (options.frames.empty()) return open(content_hash);
  return OpenCached(FrameStore(options.frames), open, content_hash);
}

/// The scheduler that started this process reads these lines.
void TellProgress(std::size_t done, std::size_t total) {
  fmt::print("@progress {} {}\n", done, total);
  std::fflush(stdout);
}

int RunOneExternal(const Options& options) {
  std::uint64_t content_hash = 0;
  std::unique_ptr<Sequence> kept_open;
  const std::unique_ptr<Sequence> sequence = OpenSequence(options, &content_hash);
  const std::filesystem::path folder =
      std::filesystem::path(options.out) / "runs" / RunId(options.spec);
  const auto open_path = [&] {
    PathOfRig path;
    kept_open = OpenSimulation(SimulationOf(options), nullptr, &path);
    return path;
  };
  ExternalSystem external = options.external;
  external.name = options.spec.system;
  RunResult result = RunExternal(external, *sequence,
                                 {.dataset = options.dataset,
                                  .output = folder / "output.txt",
                                  .log = folder / "system.log",
                                  .seed = options.spec.seed,
                                  .open_path = open_path});
  result.spec = options.spec;
  result.scene_hash = content_hash;
  const RunScore score = ScoreRun(result);
  RunRecord record = MakeRecord(result, score, sequence->rate_hz());
  record.inputs_hash = options.inputs_hash;
  WriteRun(result, score, record, options.out);
  return kAllPassed;
}

MaskMaker MasksFor(const System& system, const Options& options) {
  if (options.like.empty()) return MasksFromTruth(system.mask_source);
  const std::vector<double>& e = options.mask_errors;
  return MasksWithErrors(system.mask_source,
                         {.boundary_px = e.at(0),
                          .miss_below_px = static_cast<int>(e.at(1)),
                          .miss_share = e.at(2),
                          .latency_frames = static_cast<int>(e.at(3))},
                         options.spec.seed);
}

int RunOne(const Options& options) {
  if (!options.external.command.empty()) return RunOneExternal(options);
  const System& system = FindSystem(options.like.empty() ? options.spec.system : options.like);
  std::uint64_t content_hash = 0;
  const std::unique_ptr<Sequence> sequence = OpenSequence(options, &content_hash);
  const std::unique_ptr<Estimator> estimator = system.make(
      sequence->calibration(), {.threads = options.threads, .draw_stages = options.debug_dynamic});

  const std::string folder = "runs/" + RunId(options.spec);
  SamplePictures samples;
  std::optional<Video> film;
  if (options.video && Video::Available()) {
    film.emplace(std::filesystem::path(options.out) / folder / "film.mp4",
                 sequence->rate_hz() / kFilmEvery);
  }
  StageSheets stages({.folder = std::filesystem::path(options.out) / folder,
                      .rate_hz = sequence->rate_hz() / kFilmEvery,
                      .film = options.debug_dynamic && options.video});
  const auto observe = [&](const DrivenFrame& frame) {
    const FrameTruth* truth = frame.shown.truth ? &*frame.shown.truth : nullptr;
    samples.See(frame.index, frame.count, frame.shown.images.left, truth, frame.estimate,
                frame.facts);
    if (film && frame.index % kFilmEvery == 0) {
      cv::Mat3b picture = DrawOverlay(frame.shown.images.left, truth, &frame.estimate, "");
      cv::resize(picture, picture, {picture.cols / 4 * 2, picture.rows / 4 * 2}, 0, 0,
                 cv::INTER_AREA);
      film->Add(picture);
    }
    stages.See(frame.index, truth, frame.estimate, frame.facts);
    TellProgress(frame.index + 1, frame.count);
  };
  RunResult result = Drive(*sequence, *estimator, MasksFor(system, options), {}, observe);
  result.spec = options.spec;
  result.scene_hash = content_hash;
  result.threads = options.threads;

  const RunScore score = ScoreRun(result);
  RunRecord record = MakeRecord(result, score, sequence->rate_hz());
  record.inputs_hash = options.inputs_hash;
  if (film && film->Finish()) record.artifacts["film"] = folder + "/film.mp4";
  for (const auto& [name, path] : stages.Finish()) record.artifacts[name] = folder + "/" + path;
  if (!stages.trouble().empty()) record.notes.push_back(stages.trouble());
  int number = 0;
  for (const std::string& name : samples.Write(std::filesystem::path(options.out) / folder)) {
    record.artifacts[fmt::format("picture_{:02}", number++)] = folder + "/" + name;
  }
  WriteRun(result, score, record, options.out);
  return kAllPassed;
}

}  // namespace

void AddRunOneCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("run-one", "one run of a suite, in this process");
  command->group("");  // `run` calls it; people need not
  command->add_option("--scene", options->spec.scene)->required();
  command->add_option("--scene-file", options->spec.scene_file)->required();
  command->add_option("--twin", options->spec.twin)->required();
  command->add_option("--system", options->spec.system)->required();
  command->add_option("--seed", options->spec.seed)->required();
  command->add_option("--out", options->out)->required();
  command->add_option("--inputs-hash", options->inputs_hash);
  command->add_option("--frames", options->frames);
  command->add_option("--threads", options->threads);
  command->add_option("--external-command", options->external.command);
  command->add_option("--external-dataset", options->external.dataset);
  command->add_option("--external-trajectory", options->external.trajectory);
  command->add_option("--external-timeout", options->external.timeout_s);
  command->add_option("--dataset", options->dataset);
  command->add_flag("!--no-video", options->video);
  command->add_flag("--debug-dynamic", options->debug_dynamic);
  command->add_flag("--vslam-lab", options->external.vslam_lab);
  command->add_option("--like", options->like);
  command->add_option("--mask-errors", options->mask_errors)->delimiter(',')->expected(4);
  command->callback([=] { *action = [=] { return RunOne(*options); }; });
}

}  // namespace aisle
