#include "harness/bag/bag.h"
#include "harness/cli/bag_notes.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/slam_stream.h"
#include "harness/cli/system_choice.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/mask_folder.h"
#include "harness/plugs/calibration.h"
#include "harness/plugs/recorded_sequence.h"
#include "harness/plugs/systems.h"
#include "harness/plugs/wheel_odometry.h"
#include "harness/run/drive.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string dataset, format, output, live;  ///< format empty: a folder's is euroc
  BagRecordingOptions bag;
  std::vector<std::string> calibration;  ///< files of the rig, for a bag without camera_info
  std::string load_map, save_map;        ///< empty: none
  bool localise_only = false;
  std::string masks;  ///< folder of masks to reject by; empty: none
  SystemChoice system{.name = "plain", .set = {}};
  int threads = 0;
  bool free_running = false;
  bool stream = false;  ///< no dataset: frames come over stdin
};

void PrintScores(const RunResult& run) {
  const Scorecard scores = ScoreRun(run).scores;
  for (const char* name : {"ate_rmse_m", "ate_live_rmse_m", "rpe_trans_rmse_m", "t_rel_percent",
                           "t_rel_short_percent", "coverage", "ms_process_mean"}) {
    const auto score = scores.find(name);
    if (score != scores.end()) fmt::print("{:24} {}\n", name, ToText(score->second));
  }
}

/// The user's masks; counts the frames that have one.
MaskMaker MasksOf(const Options& options, std::size_t* masked) {
  if (options.masks.empty()) return MasksFromTruth(MaskSource::kNone);
  return [folder = MaskFolder(options.masks), masked](const SequenceFrame& frame) {
    ExternalMask mask = folder.Find(frame.images);
    *masked += mask.left.empty() && mask.confidence.empty() ? 0 : 1;
    return mask;
  };
}

std::unique_ptr<Estimator> MakeEstimator(const SystemSpec& system,
                                         const StereoCalibration& calibration,
                                         const Options& options) {
  if (!options.save_map.empty() &&
      !fs::is_directory(fs::absolute(options.save_map).parent_path())) {
    throw InputError(options.save_map, 0, "its folder does not exist");
  }
  try {
    return MakeSystem(system, calibration,
                      {.threads = options.threads,
                       .load_map = options.load_map,
                       .localise_only = options.localise_only,
                       .free_running = options.free_running});
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());  // the files a system starts from are input
  } catch (const std::invalid_argument& error) {
    throw InputError(options.dataset.empty() ? "stdin" : options.dataset, 0, error.what());
  }
}

std::unique_ptr<Sequence> Open(const Options& options) {
  const fs::path path = options.dataset;
  if (IsBagFile(path) || fs::exists(path / "metadata.yaml")) {
    if (!options.format.empty()) {
      throw InputError(options.dataset, 0, "is a bag; --format is for folders of images");
    }
    BagRecordingOptions bag = options.bag;
    if (!options.calibration.empty()) bag.cameras = ReadCalibration(options.calibration);
    StereoRecording recording = ReadBagRecording(path, bag);
    TellNotes(options.dataset, recording.notes);
    return MakeRecordedSequence(std::move(recording), options.dataset, path.stem().string());
  }
  if (!options.bag.topics.empty() || options.bag.baseline_m || !options.calibration.empty() ||
      !options.bag.odometry.empty()) {
    throw InputError(options.dataset, 0,
                     "not a bag; --topic, --baseline, --odometry and --calibration are for bags "
                     "(for a folder's wheel odometry, use --set odometry=true)");
  }
  const auto format = DatasetFormatFromName(options.format.empty() ? "euroc" : options.format);
  StereoRecording recording = ReadRecording(path, format);
  TellNotes(options.dataset, recording.notes);
  const fs::path folder = (fs::absolute(path) / "").lexically_normal().parent_path();
  return MakeRecordedSequence(std::move(recording), options.dataset, folder.filename().string());
}

/// What a stream has no use for: frames come in and poses go out by it alone.
void RefuseBesideStream(const Options& options) {
  for (const auto& [name, given] :
       {std::pair("a DATASET", !options.dataset.empty()), std::pair("-o", !options.output.empty()),
        std::pair("--live", !options.live.empty()), std::pair("--masks", !options.masks.empty()),
        std::pair("--format", !options.format.empty()),
        std::pair("--topic", !options.bag.topics.empty()),
        std::pair("--baseline", options.bag.baseline_m.has_value()),
        std::pair("--odometry", !options.bag.odometry.empty()),
        std::pair("--calibration", !options.calibration.empty())}) {
    if (!given) continue;
    throw InputError(fmt::format(
        "slam --stream: {} is not supported, as frames and poses go over stdin and stdout", name));
  }
}

int RunStream(const SystemSpec& system, const Options& options) {
  RefuseBesideStream(options);
  const auto make = [&](const StereoCalibration& calibration) {
    return MakeEstimator(system, calibration, options);
  };
  const auto finish = [&](Estimator* estimator) {
    if (!options.save_map.empty()) estimator->SaveMap(options.save_map);
  };
  const std::size_t frames = AnswerStream("aisle " + system.name, make, finish);
  fmt::print(stderr, "{} frames answered\n", frames);
  return kAllPassed;
}

/// Whoever names the topic of the wheels wants the system to be handed them.
SystemSpec SystemOf(const Options& options) {
  SystemChoice choice = options.system;
  if (!options.bag.odometry.empty()) choice.set.push_back(fmt::format("{}=true", kOdometryOption));
  return SpecOf(choice);
}

int RunSlam(const Options& options) {
  const SystemSpec system = SystemOf(options);
  if (FindSystem(system.like).mask_source != MaskSource::kNone) {
    throw InputError("system '" + system.name +
                     "' needs the truth about moving objects, which a recording does not have");
  }
  if (options.stream) return RunStream(system, options);
  if (options.dataset.empty() || options.output.empty()) {
    throw InputError(
        "slam: expected a DATASET and -o FILE, or --stream; example: ./aisle slam V1_01_easy -o "
        "v101.txt");
  }
  for (const std::string& file : {options.output, options.live}) CheckCanBeWritten(file);
  auto sequence = Open(options);
  if (WantsOdometry(system)) sequence = WithOdometry(std::move(sequence), 1);
  const auto estimator = MakeEstimator(system, sequence->calibration(), options);
  ProgressLine line;
  std::size_t masked = 0;
  const RunResult run =
      Drive(*sequence, *estimator, MasksOf(options, &masked), {}, [&](const DrivenFrame& frame) {
        line.Show(fmt::format("frame {} of {}", frame.index + 1, frame.count));
      });
  line.Clear();
  TellNotes(options.dataset, run.notes);
  if (options.free_running) {
    fmt::print(stderr, "aisle: free running: results differ from run to run\n");
  }
  WriteFileAtomically(options.output,
                      FormatTrajectory(run.trajectory.final, TrajectoryFormat::kTum));
  if (!options.live.empty()) {
    WriteFileAtomically(options.live,
                        FormatTrajectory(run.trajectory.live, TrajectoryFormat::kTum));
  }
  fmt::print("{} frames, {} with a pose, {:.1f} ms each -> {}\n", run.facts.size(),
             run.trajectory.live.size(),
             run.facts.empty() ? 0.0 : 1e3 * run.wall_s / static_cast<double>(run.facts.size()),
             options.output);
  if (!options.save_map.empty()) {
    estimator->SaveMap(options.save_map);
    fmt::print("map -> {}\n", options.save_map);
  }
  if (!options.masks.empty()) {
    fmt::print("{} of {} frames have a mask in {}\n", masked, run.facts.size(), options.masks);
    if (masked == 0) {
      throw InputError(options.masks, 0,
                       "no mask matches a frame: name masks by timestamp in nanoseconds or by "
                       "six-digit frame number, for example 000042.png");
    }
  }
  if (!run.truth.empty()) PrintScores(run);
  if (run.status == RunStatus::kOk) return kAllPassed;
  fmt::print(stderr, "aisle: {}\n", run.status_why);
  return kVerdictFailed;
}

void AddRecordingOptions(CLI::App* command, Options* options) {
  command->add_option("DATASET", options->dataset,
                      "Folder of the recording, or a ROS 2 bag (.mcap, .db3)");
  command->option_defaults()->group("Recording");
  AddFolderFormat(command, &options->format);
  command
      ->add_option("--topic", options->bag.topics,
                   "Topic of a bag's left camera if it has several pairs, and of the right one if "
                   "its name does not follow from it")
      ->delimiter(',');
  command
      ->add_option("--baseline", options->bag.baseline_m,
                   "Metres between the cameras, for a bag whose camera_info lacks it")
      ->check(CLI::PositiveNumber);
  command->add_option("--odometry", options->bag.odometry,
                      "Topic of a bag's wheel odometry, to give to the system, for example /odom");
  command
      ->add_option(
          "--calibration", options->calibration,
          "Calibration of a bag without camera_info: Kalibr's camchain, OpenCV's files, or "
          "the left and the right camera's file in EuRoC's or ROS's format")
      ->delimiter(',')
      ->expected(1, 2);
  command->add_option("--masks", options->masks,
                      "Folder of masks to reject by: grey PNGs named by timestamp or frame number, "
                      "in which anything but 0 is rejected; the right camera's in right/; in "
                      "confidence/, 255 is full trust and 0 hardly any");
  command->add_flag("--stream", options->stream,
                    "Read frames from stdin instead of a DATASET and answer on stdout "
                    "(reports/docs/stream.md)");
}

void AddMapOptions(CLI::App* command, Options* options) {
  command->option_defaults()->group("Map");
  CLI::Option* load = command
                          ->add_option("--load-map", options->load_map,
                                       "Continue in the map of an earlier drive with this rig")
                          ->check(CLI::ExistingFile);
  command->add_option("--save-map", options->save_map, "Write the map to this file at the end");
  command
      ->add_flag("--localise-only", options->localise_only,
                 "Localise in the loaded map without changing it")
      ->needs(load);
}

}  // namespace

void AddSlamCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("slam", "Run a system on recorded stereo images");
  AddRecordingOptions(command, options.get());
  command->option_defaults()->group("System");
  AddSystemChoice(command, &options->system);
  AddThreads(command, &options->threads, "never changes a result");
  command->add_flag("--free-running", options->free_running,
                    "Let frames not wait for mapping, which takes effect as threads happen to run: "
                    "NOT REPEATABLE");
  AddMapOptions(command, options.get());
  command->option_defaults()->group("Output");
  AddOutput(command, &options->output, "File for the final trajectory, in TUM format");
  command->add_option("--live", options->live, "File for the live trajectory, in TUM format");
  command->footer(
      "Example: ./aisle slam V1_01_easy --format euroc -o v101.txt --save-map v1.map\n"
      "         ./aisle slam drive.mcap --topic /front/left/image_rect -o drive.txt\n"
      "         ./aisle slam V1_02_medium -o v102.txt --load-map v1.map --localise-only");
  command->callback([=] { *action = [=] { return RunSlam(*options); }; });
}

}  // namespace aisle
