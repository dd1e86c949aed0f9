#include "harness/campaign/run_pictures.h"

#include <opencv2/imgproc.hpp>

#include "harness/campaign/progress.h"

namespace aisle {
namespace {

constexpr std::size_t kFilmEvery = 2;  ///< frames: half the rate is enough to see what happened

}  // namespace

RunPictures::RunPictures(const Job& job, double rate_hz)
    : out_(job.out),
      folder_(std::filesystem::path("runs") / RunId(job.spec)),
      rate_hz_(rate_hz),
      album_(FramesKeptFromName(job.frames_in_report)),
      stages_({.folder = job.out / folder_,
               .rate_hz = rate_hz / kFilmEvery,
               .film = job.debug_dynamic && job.video}) {
  if (job.video && Video::Available()) {
    film_.emplace(out_ / folder_ / "film.mp4", rate_hz / kFilmEvery);
  }
}

void RunPictures::See(const DrivenFrame& frame) {
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

void RunPictures::FinishDrive(const DriveLog& drive, RunRecord* record) const {
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

void RunPictures::Finish(const TrajectoryScore& live, RunRecord* record) {
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

FrameObserver Observe(RunPictures* pictures, RunBag* bag) {
  return [pictures, bag](const DrivenFrame& frame) {
    pictures->See(frame);
    if (bag != nullptr) bag->See(frame);
    TellProgress(frame.index + 1, frame.count);
  };
}

}  // namespace aisle
