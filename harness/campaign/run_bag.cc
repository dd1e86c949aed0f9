#include "harness/campaign/run_bag.h"

#include "harness/bag/beside_bag.h"
#include "harness/ros/drawing.h"

namespace aisle {

std::filesystem::path RunBagName(bool with_frames) {
  return with_frames ? "bag/drive.mcap" : "estimate.mcap";
}

RunBag::RunBag(const std::filesystem::path& file, const std::string& system,
               const StereoCalibration& calibration, std::int64_t epoch_ns, bool with_frames)
    : file_(file),
      system_(system),
      with_frames_(with_frames),
      bag_(file, calibration, {.epoch_ns = epoch_ns}) {}

void RunBag::See(const DrivenFrame& frame) {
  if (with_frames_) bag_.AddFrame(frame.shown);
  FrameEstimate estimate = frame.estimate;
  estimate.stamp_ns = frame.request.stamp_ns;
  bag_.AddEstimate(system_, estimate, frame.shown.truth ? &*frame.shown.truth : nullptr);
}

std::map<std::string, std::string> ScoresAsMetadata(const Scorecard& scores) {
  std::map<std::string, std::string> values;
  for (const auto& [name, score] : scores) values[name] = ToText(score);
  return values;
}

void RunBag::Finish(const RunResult& result, const RunScore& score, const DriveLog* drive) {
  bag_.AddFinalTrack(system_, result.trajectory.final);
  if (drive != nullptr) {
    for (const Contact& contact : drive->track.contacts) {
      bag_.AddEvent(system_, contact.stamp_ns, ros::kError,
                    fmt::format("contact with {} ({}) at {:.2f} m/s", contact.with,
                                contact.object_class, contact.speed_mps));
    }
    for (const ZoneViolation& violation : drive->track.violations) {
      bag_.AddEvent(system_, violation.stamp_ns, ros::kWarning,
                    fmt::format("in zone {} at {:.2f} m/s", violation.zone, violation.speed_mps));
    }
  }
  bag_.AddMetadata(fmt::format("scores/{}", system_), ScoresAsMetadata(score.scores));
  const McapWriter& written = bag_.Finish();
  if (with_frames_) WriteBesideBag(file_, written, {system_});
}

}  // namespace aisle
