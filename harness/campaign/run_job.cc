#include "harness/campaign/run_job.h"

#include "harness/campaign/closed_run.h"
#include "harness/campaign/external_run.h"
#include "harness/campaign/guest_output.h"
#include "harness/campaign/job_sequence.h"
#include "harness/campaign/process.h"
#include "harness/campaign/progress.h"
#include "harness/campaign/run_bag.h"
#include "harness/campaign/run_pictures.h"
#include "harness/campaign/source.h"
#include "harness/campaign/stream_system.h"
#include "harness/campaign/teaching.h"
#include "harness/contract/stream.h"
#include "harness/contract/system_fault.h"
#include "harness/contract/twin.h"
#include "harness/io/input_error.h"
#include "harness/io/keep.h"
#include "harness/io/places.h"
#include "harness/plugs/cached_drive.h"
#include "harness/plugs/simulated_drive.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/steering_options.h"
#include "harness/plugs/systems.h"
#include "harness/plugs/wheel_odometry.h"
#include "harness/record/drive_json.h"
#include "harness/record/provenance.h"
#include "harness/record/record.h"
#include "harness/run/drive.h"
#include "harness/run/playback.h"
#include "harness/score/drive_scores.h"
#include "harness/suite/recording.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

std::filesystem::path FolderOf(const Job& job) {
  return std::filesystem::path("runs") / RunId(job.spec);
}

RunRecord RecordOf(const Job& job, const RunResult& result, const RunScore& score, double rate_hz) {
  RunRecord record = MakeRecord(result, score, rate_hz);
  record.inputs_hash = job.inputs_hash;
  record.hall = HallOfSource(job.spec.scene_file, job.spec.seed);
  // Its own times are among its inputs; how much memory it may take is not.
  if (record.status == RunStatus::kTimeout) record.limit_mib = job.memory_mib;
  return record;
}

/// Where truth lies (the scene, those it extends, the frames and datasets) and what other runs and
/// nights left.
std::vector<std::filesystem::path> HiddenFromGuests(const Job& job) {
  std::vector<std::filesystem::path> hidden{job.out, CacheDir(), ShippedBaselines()};
  hidden.insert(hidden.end(), job.hidden.begin(), job.hidden.end());
  for (const std::string& file : FilesOfSource(job.spec.scene_file)) hidden.emplace_back(file);
  return hidden;
}

/// The run as a bag; null where the job asks for none.
std::unique_ptr<RunBag> BagOf(const Job& job, const StereoCalibration& calibration,
                              bool with_frames) {
  if (!job.mcap) return nullptr;
  return std::make_unique<RunBag>(job.out / FolderOf(job) / RunBagName(with_frames),
                                  job.spec.system.name, calibration,
                                  IsRecording(job.spec.scene_file) ? 0 : kBagEpochNs, with_frames);
}

/// What a foreign system printed is kept beside its run.
void NameLog(const Job& job, RunRecord* record) {
  if (!job.spec.system.external) return;
  record->artifacts["log"] = (FolderOf(job) / kSystemLogName).string();
}

/// Said while a foreign system works: its own count of frames, or how long it has been at it.
void TellForeignProgress(double seconds, int done, int total, double timeout_s) {
  if (total > 0)
    return TellProgress(static_cast<std::size_t>(done), static_cast<std::size_t>(total));
  TellProgress(0, 0);
  TellStage(fmt::format("driving, {:.0f} s of at most {:g}", seconds, timeout_s));
}

/// Holds a foreign drive against truth, with what it left beside its trajectory, and draws it.
void Show(const Job& job, const Sequence& sequence, RunResult* result,
          const FrameObserver& observer) {
  TellStage("looking at what it left");
  try {
    PlayBack(sequence, Leftovers(job.out / FolderOf(job)), observer, result);
  } catch (const InputError& wrong) {
    result->notes.push_back(fmt::format("not used: {}", wrong.what()));
  }
}

/// Nothing where the system does not ask for it.
std::optional<WheelMotions> OdometryFor(const Job& job, const Sequence& sequence) {
  if (!WantsOdometry(job.spec.system)) return std::nullopt;
  return MeasureByWheels(sequence, job.spec.seed);
}

void RunForeign(const Job& job) {
  const ExternalSystem& system = *job.spec.system.external;
  std::uint64_t content_hash = 0;
  std::unique_ptr<Sequence> kept_open;
  const std::unique_ptr<Sequence> sequence = OpenSequence(job, &content_hash);
  const std::filesystem::path folder = job.out / FolderOf(job);
  const auto open_path = [&] {
    PathOfRig path;
    kept_open = OpenSimulation(SimulationOf(job), nullptr, &path);
    return path;
  };
  const auto progress = [&](double seconds, int done, int total) {
    TellForeignProgress(seconds, done, total, system.timeout_s);
  };
  RunResult result = RunExternal(system, *sequence,
                                 {.dataset = job.dataset,
                                  .folder = folder,
                                  .hidden = HiddenFromGuests(job),
                                  .seed = job.spec.seed,
                                  .memory_mib = job.memory_mib,
                                  .odometry = OdometryFor(job, *sequence),
                                  .open_path = open_path,
                                  .progress = progress});
  result.spec = job.spec;
  result.scene_hash = content_hash;
  SpreadWallTime(&result);
  RunPictures pictures(job, sequence->rate_hz());
  const std::unique_ptr<RunBag> bag = BagOf(job, sequence->calibration(), false);
  if (!result.trajectory.live.empty()) {
    Show(job, *sequence, &result, Observe(&pictures, bag.get()));
  }
  const RunScore score = ScoreRun(result);
  if (bag) bag->Finish(result, score, nullptr);
  RunRecord record = RecordOf(job, result, score, sequence->rate_hz());
  NameLog(job, &record);
  if (std::filesystem::exists(folder / kFeaturesName)) {
    record.artifacts["features"] = (FolderOf(job) / kFeaturesName).string();
  }
  pictures.Finish(score.live, &record);
  WriteRun(result, score, record, job.out);
}

MaskMaker MasksOf(const Job& job) {
  const SystemSpec& spec = job.spec.system;
  return MasksWithErrors(TraitsOf(spec).masks, spec.mask_errors, job.spec.seed);
}

/// One of ours, or a foreign one behind a stream, which answers frame by frame as ours do.
std::unique_ptr<Estimator> EstimatorOf(const Job& job, const StereoCalibration& calibration,
                                       double rate_hz, const std::filesystem::path& map = {}) {
  if (const auto& external = job.spec.system.external) {
    return std::make_unique<StreamEstimator>(*external, calibration,
                                             StreamRun{.folder = job.out / FolderOf(job),
                                                       .hidden = HiddenFromGuests(job),
                                                       .seed = job.spec.seed,
                                                       .rate_hz = rate_hz,
                                                       .memory_mib = job.memory_mib});
  }
  return MakeSystem(job.spec.system, calibration,
                    {.threads = job.threads, .load_map = map, .draw_stages = job.debug_dynamic});
}

/// Scores a drive of one of ours and writes it all down.
void File(const Job& job, double rate_hz, RunResult result, RunPictures* pictures, RunBag* bag,
          const DriveLog* drive = nullptr) {
  result.spec = job.spec;
  result.threads = job.threads;
  RunScore score = ScoreRun(result);
  if (drive != nullptr) score.scores.merge(ScoreDrive(*drive));
  if (bag != nullptr) bag->Finish(result, score, drive);
  RunRecord record = RecordOf(job, result, score, rate_hz);
  NameLog(job, &record);
  pictures->Finish(score.live, &record);
  if (drive != nullptr) {
    WriteDrive(*drive, job.out, &record);
    if (bag != nullptr) record.artifacts["bag"] = (FolderOf(job) / RunBagName(true)).string();
    pictures->FinishDrive(*drive, &record);
  }
  WriteRun(result, score, record, job.out);
}

/// A system that did not even begin: its verdict, without a frame.
void FileStillborn(const Job& job, double rate_hz, const SystemFault& fault) {
  RunResult result;
  result.spec = job.spec;
  result.status = fault.status;
  result.status_why = fault.what();
  const std::filesystem::path log = job.out / FolderOf(job) / kSystemLogName;
  if (job.spec.system.external && std::filesystem::exists(log)) {
    result.last_words = LastWords(ReadFile(log));
  }
  const RunScore score = ScoreRun(result);
  RunRecord record = RecordOf(job, result, score, rate_hz);
  NameLog(job, &record);
  WriteRun(result, score, record, job.out);
}

/// What a foreign system behind a stream said of itself, and what it took.
void Introduce(const Estimator& estimator, RunResult* result) {
  const auto* stream = dynamic_cast<const StreamEstimator*>(&estimator);
  if (stream == nullptr) return;
  result->system_version = stream->version();
  result->last_words = LastWords(stream->log());
  result->peak_rss_mib = stream->peak_rss_mib();
}

/// The frames of a job as its system is shown them.
std::unique_ptr<Sequence> SequenceOf(const Job& job, std::uint64_t* content_hash) {
  std::unique_ptr<Sequence> sequence = OpenSequence(job, content_hash);
  if (!WantsOdometry(job.spec.system)) return sequence;
  return WithOdometry(std::move(sequence), job.spec.seed);
}

void RunOurs(const Job& job) {
  std::uint64_t content_hash = 0;
  const std::unique_ptr<Sequence> sequence = SequenceOf(job, &content_hash);
  std::unique_ptr<Estimator> estimator;
  try {
    estimator = EstimatorOf(job, sequence->calibration(), sequence->rate_hz());
  } catch (const SystemFault& fault) {
    return FileStillborn(job, sequence->rate_hz(), fault);
  }
  RunPictures pictures(job, sequence->rate_hz());
  const std::unique_ptr<RunBag> bag = BagOf(job, sequence->calibration(), false);
  RunResult result = Drive(*sequence, *estimator, MasksOf(job), {}, Observe(&pictures, bag.get()));
  result.scene_hash = content_hash;
  Introduce(*estimator, &result);
  File(job, sequence->rate_hz(), std::move(result), &pictures, bag.get());
}

/// `kept`: where its pictures are shared; empty: they are this run's alone.
std::unique_ptr<DriveScene> OpenDrive(const Job& job, const std::string& twin,
                                      std::uint64_t* content_hash,
                                      const std::filesystem::path& kept = {}) {
  TellStage("opening the scene");
  SimulatedSequenceOptions options = SimulationOf(job);
  options.twin = twin;
  std::unique_ptr<DriveScene> scene = OpenSimulatedDrive(options, content_hash);
  if (!kept.empty()) scene = WithKeptFrames(std::move(scene), FrameStore(kept));
  return WantsOdometry(job.spec.system) ? WithOdometry(std::move(scene)) : std::move(scene);
}

/// Leads the vehicle through the scene before anybody is there, or takes what is kept of that. The
/// map is written to `map_file`.
Teaching TeachFirst(const Job& job, const std::filesystem::path& map_file) {
  if (!job.teaching.empty()) {
    if (auto kept = ReadTeaching(job.teaching, map_file)) return *std::move(kept);
  }
  const std::unique_ptr<DriveScene> scene = OpenDrive(job, twin::kEmpty, nullptr, job.led_frames);
  const auto estimator = EstimatorOf(job, scene->calibration(), scene->rate_hz());
  TellStage("being led along its path");
  Teaching teaching = Teach(*scene, *estimator, MasksOf(job), job.spec.seed, map_file);
  if (!job.teaching.empty()) {
    KeepWherePossible([&] { KeepTeaching(teaching, map_file, job.teaching); });
  }
  return teaching;
}

/// A file that is gone when it is.
struct PassingFile {
  ~PassingFile() {
    std::error_code error;
    if (!path.empty()) std::filesystem::remove(path, error);
  }
  const std::filesystem::path path;
};

/// Who steers through a scene, and what it was taught before.
struct SteeredScene {
  std::unique_ptr<DriveScene> scene;
  std::uint64_t content_hash = 0;
  std::unique_ptr<Estimator> estimator;
  std::optional<TaughtCourse> taught = {};
};

/// Teaches the way where it is to be taught, then opens the scene and begins the system. Throws
/// SystemFault; `steered` has what there was by then.
void Begin(const Job& job, bool is_taught, SteeredScene* steered) {
  const PassingFile map{is_taught ? job.out / FolderOf(job) / "taught.map" : ""};
  std::optional<Teaching> teaching;
  if (is_taught) teaching = TeachFirst(job, map.path);
  steered->scene = OpenDrive(job, job.spec.twin, &steered->content_hash);
  const DriveScene& scene = *steered->scene;
  steered->estimator = EstimatorOf(job, scene.calibration(), scene.rate_hz(), map.path);
  if (teaching) steered->taught = TaughtBy(*teaching, scene.course());
}

/// A scene whose vehicle the system steers: its frames are this run's alone.
void RunSteering(const Job& job) {
  const Steering steering = SteeringOf(job.spec.system.options);
  SteeredScene steered;
  try {
    Begin(job, steering.taught, &steered);
  } catch (const SystemFault& fault) {
    if (!steered.scene) steered.scene = OpenDrive(job, job.spec.twin, nullptr);  // it has the rate
    return FileStillborn(job, steered.scene->rate_hz(), fault);
  }
  const DriveScene& scene = *steered.scene;
  RunPictures pictures(job, scene.rate_hz());
  pictures.ExpectDrive();
  const std::unique_ptr<RunBag> bag = BagOf(job, scene.calibration(), true);
  ClosedRun run = RunClosed(scene, *steered.estimator, MasksOf(job), steering, job.spec.seed,
                            Observe(&pictures, bag.get()), steered.taught);
  if (steered.taught) {
    run.result.notes.push_back(
        "the system was taught the path: it was led along it once, without actors, and drove with "
        "the map of that");
  }
  run.result.scene_hash = steered.content_hash;
  Introduce(*steered.estimator, &run.result);
  File(job, scene.rate_hz(), std::move(run.result), &pictures, bag.get(), &run.drive);
}

}  // namespace

void RunJob(const Job& job) {
  const auto& external = job.spec.system.external;
  if (external && !IsStream(*external)) return RunForeign(job);
  if (IsDriveSource(job.spec.scene_file)) return RunSteering(job);
  RunOurs(job);
}

}  // namespace aisle
