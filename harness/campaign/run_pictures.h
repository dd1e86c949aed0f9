#pragma once

#include <filesystem>
#include <optional>

#include "harness/campaign/job.h"
#include "harness/campaign/run_bag.h"
#include "harness/record/record.h"
#include "harness/report/picture/drive_film.h"
#include "harness/report/picture/frame_album.h"
#include "harness/report/picture/stage_sheets.h"
#include "harness/report/picture/video.h"
#include "harness/run/drive.h"

namespace aisle {

/// What people look at in the morning: single frames, a film, the stages of the rejection, as far
/// as the job asks for them. All of it lies in the run's folder.
class RunPictures {
 public:
  RunPictures(const Job& job, double rate_hz);

  void See(const DrivenFrame& frame);

  /// The vehicle is steered: its drive becomes a film of its own.
  void ExpectDrive() { steered_ = true; }
  void FinishDrive(const DriveLog& drive, RunRecord* record) const;

  /// Writes what is left to write and names it all in the record. `live`: the errors that say
  /// which frames are worth a look.
  void Finish(const TrajectoryScore& live, RunRecord* record);

 private:
  const std::filesystem::path out_, folder_;
  const double rate_hz_;
  bool steered_ = false;
  DriveFilm drive_film_;
  FrameAlbum album_;
  std::optional<Video> film_;
  StageSheets stages_;
};

/// Shows every frame to the pictures, to the bag where there is one, and to who waits for the run.
FrameObserver Observe(RunPictures* pictures, RunBag* bag);

}  // namespace aisle
