#include "harness/campaign/run_job.h"

#include <opencv2/imgproc.hpp>

#include "harness/campaign/closed_run.h"
#include "harness/campaign/external_run.h"
#include "harness/campaign/guest_output.h"
#include "harness/campaign/job_sequence.h"
#include "harness/campaign/process.h"
#include "harness/campaign/run_bag.h"
#include "harness/campaign/source.h"
#include "harness/campaign/stream_system.h"
#include "harness/campaign/teaching.h"
#include "harness/contract/stream.h"
#include "harness/contract/system_fault.h"
#include "harness/io/input_error.h"
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
#include "harness/report/picture/drive_film.h"
#include "harness/report/picture/frame_album.h"
#include "harness/report/picture/stage_sheets.h"
#include "harness/report/picture/video.h"
#include "harness/run/drive.h"
#include "harness/run/playback.h"
#include "harness/score/drive_scores.h"
#include "harness/suite/recording.h"

namespace aisle {
namespace {

constexpr std::size_t kFilmEvery = 2;  ///< frames: half the rate is enough to see what happened

void TellProgress(std::size_t done, std::size_t total) {
  fmt::print("@progress {} {}\n", done, total);
  std::fflush(stdout);
}

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
  if (!job.goes_to.empty()) hidden.push_back(job.goes_to);
  for (const std::string& file : FilesOfSource(job.spec.scene_file)) hidden.emplace_back(file);
  return hidden;
}

/// What people look at in the morning: single frames, a film, the stages of the rejection.
class Pictures {
 public:
  Pictures(const Job& job, double rate_hz)
      : out_(job.out),
        folder_(FolderOf(job)),
        rate_hz_(rate_hz),
        album_(FramesKeptFromName(job.frames_in_report)),
        stages_({.folder = job.out / folder_,
                 .rate_hz = rate_hz / kFilmEvery,
                 .film = job.debug_dynamic && job.video}) {
    if (job.video && Video::Available()) {
      film_.emplace(out_ / folder_ / "film.mp4", rate_hz / kFilmEvery);
    }
  }

  void See(const DrivenFrame& frame) {
    const FrameTruth* truth = frame.shown.truth ? &*frame.shown.truth : nullptr;
    cv::Mat3b picture = album_.See(frame.index, frame.count, frame.shown.images.left, truth,
                                   frame.estimate, frame.facts);
    if (film_ && frame.index % kFilmEvery == 0) {
      if (picture.empty()) {
        picture = DrawOverlay(frame.shown.images.left, truth, &frame.estimate, "");
      }
      cv::resize(picture, picture, {picture.cols / 4 * 2, picture.rows / 4 * 2}, 0, 0,
                 cv::INTER_AREA);
      film_->Add(picture);
      if (steered_) drive_film_.Keep(frame.request.stamp_ns, picture);
    }
    stages_.See(frame.index, truth, frame.estimate, frame.facts);
  }

  /// The vehicle is steered: its drive becomes a film of its own.
  void ExpectDrive() { steered_ = true; }
  void FinishDrive(const DriveLog& drive, RunRecord* record) const {
    // Frames that the busy system never saw are missing: as fast as it went all the same.
    const DriveTrack& track = drive.track;
    const double share = track.frames_due > 0 ? static_cast<double>(track.frames_shown) /
                                                    static_cast<double>(track.frames_due)
                                              : 1;
    const double rate_hz = std::max(1.0, share * rate_hz_ / kFilmEvery);
    if (film_ && drive_film_.Write(drive, out_ / folder_ / "drive.mp4", rate_hz)) {
      record->artifacts["drive_film"] = (folder_ / "drive.mp4").string();
    }
  }

  /// Writes what is left to write and names it all in the record. `live`: the errors that say
  /// which frames are worth a look.
  void Finish(const TrajectoryScore& live, RunRecord* record) {
    auto& artifacts = record->artifacts;
    if (film_ && film_->Finish()) artifacts["film"] = (folder_ / "film.mp4").string();
    for (const auto& [name, path] : stages_.Finish()) artifacts[name] = (folder_ / path).string();
    if (!stages_.trouble().empty()) record->notes.push_back(stages_.trouble());
    std::map<std::size_t, double> error_m;
    for (const PoseError& error : live.errors) error_m[error.pair.truth] = error.translation_m;
    int number = 0;
    for (const std::string& name : album_.Write(out_ / folder_, error_m)) {
      artifacts[fmt::format("picture_{:04}", number++)] = (folder_ / name).string();
    }
  }

 private:
  const std::filesystem::path out_, folder_;
  const double rate_hz_;
  bool steered_ = false;
  DriveFilm drive_film_;
  FrameAlbum album_;
  std::optional<Video> film_;
  StageSheets stages_;
};

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
  TellStage(fmt::format("driving, {:.0f} s of at most {:g}", seconds, timeout_s).c_str());
}

/// Holds a foreign drive against truth, with what it left beside its trajectory, and draws it.
void Show(const Job& job, const Sequence& sequence, RunResult* result, Pictures* pictures,
          RunBag* bag) {
  TellStage("looking at what it left");
  try {
    PlayBack(
        sequence, Leftovers(job.out / FolderOf(job)),
        [&](const DrivenFrame& frame) {
          pictures->See(frame);
          if (bag != nullptr) bag->See(frame);
          TellProgress(frame.index + 1, frame.count);
        },
        result);
  } catch (const InputError& wrong) {
    result->notes.push_back(fmt::format("not used: {}", wrong.what()));
  }
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
                                  .open_path = open_path,
                                  .progress = progress});
  result.spec = job.spec;
  result.scene_hash = content_hash;
  SpreadWallTime(&result);
  Pictures pictures(job, sequence->rate_hz());
  const std::unique_ptr<RunBag> bag = BagOf(job, sequence->calibration(), false);
  if (!result.trajectory.live.empty()) Show(job, *sequence, &result, &pictures, bag.get());
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
  if (spec.external) return MasksFromTruth(MaskSource::kNone);
  const MaskSource source = FindSystem(spec.like).mask_source;
  return spec.mask_errors == MaskErrors{}
             ? MasksFromTruth(source)
             : MasksWithErrors(source, spec.mask_errors, job.spec.seed);
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
void File(const Job& job, double rate_hz, RunResult result, Pictures* pictures, RunBag* bag,
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
  Pictures pictures(job, sequence->rate_hz());
  const std::unique_ptr<RunBag> bag = BagOf(job, sequence->calibration(), false);
  RunResult result = Drive(*sequence, *estimator, MasksOf(job), {}, [&](const DrivenFrame& frame) {
    pictures.See(frame);
    if (bag) bag->See(frame);
    TellProgress(frame.index + 1, frame.count);
  });
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
  const std::unique_ptr<DriveScene> scene = OpenDrive(job, "empty", nullptr, job.led_frames);
  const auto estimator = EstimatorOf(job, scene->calibration(), scene->rate_hz());
  TellStage("being led along its way");
  Teaching teaching = Teach(*scene, *estimator, MasksOf(job), job.spec.seed, map_file);
  if (!job.teaching.empty()) KeepTeaching(teaching, map_file, job.teaching);
  return teaching;
}

/// A scene whose vehicle the system steers: its frames are this run's alone.
void RunSteering(const Job& job) {
  const Steering steering = SteeringOf(job.spec.system.options);
  const std::filesystem::path map =
      steering.taught ? job.out / FolderOf(job) / "taught.map" : std::filesystem::path();
  std::optional<Teaching> teaching;
  std::optional<SystemFault> fault;
  try {
    if (steering.taught) teaching = TeachFirst(job, map);
  } catch (const SystemFault& taught_nothing) {
    fault = taught_nothing;
  }
  std::uint64_t content_hash = 0;
  const std::unique_ptr<DriveScene> scene = OpenDrive(job, job.spec.twin, &content_hash);
  std::unique_ptr<Estimator> estimator;
  try {
    if (!fault) estimator = EstimatorOf(job, scene->calibration(), scene->rate_hz(), map);
  } catch (const SystemFault& stillborn) {
    fault = stillborn;
  }
  std::error_code error;
  std::filesystem::remove(map, error);
  if (fault) return FileStillborn(job, scene->rate_hz(), *fault);
  Pictures pictures(job, scene->rate_hz());
  pictures.ExpectDrive();
  const std::unique_ptr<RunBag> bag = BagOf(job, scene->calibration(), true);
  const MaskMaker masks = MasksOf(job);
  const auto observer = [&](const DrivenFrame& frame) {
    pictures.See(frame);
    if (bag) bag->See(frame);
    TellProgress(frame.index + 1, frame.count);
  };
  const auto taught = teaching ? std::optional(TaughtBy(*teaching, scene->course())) : std::nullopt;
  ClosedRun run = RunClosed(*scene, *estimator, masks, steering, job.spec.seed, observer, taught);
  if (taught) {
    run.result.notes.push_back(
        "its way was taught: it was led along it once, without actors, and drove by its map of "
        "that");
  }
  run.result.scene_hash = content_hash;
  Introduce(*estimator, &run.result);
  File(job, scene->rate_hz(), std::move(run.result), &pictures, bag.get(), &run.drive);
}

}  // namespace

void RunJob(const Job& job) {
  const auto& external = job.spec.system.external;
  if (external && !IsStream(*external)) return RunForeign(job);
  if (IsDriveSource(job.spec.scene_file)) return RunSteering(job);
  RunOurs(job);
}

}  // namespace aisle
