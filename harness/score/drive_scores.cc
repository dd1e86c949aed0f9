#include "harness/score/drive_scores.h"

#include <algorithm>
#include <optional>

#include "harness/common/seconds.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr const char* kNotBegun = "the drive has not begun";

struct Deviation {
  double rms = 0, max = 0;
};
/// samples: one or more.
template <class Value>
Deviation DeviationOf(const std::vector<DriveSample>& samples, const Value& value) {
  Deviation deviation;
  for (const DriveSample& sample : samples) {
    const double off = std::abs(value(sample));
    deviation.rms += off * off;
    deviation.max = std::max(deviation.max, off);
  }
  deviation.rms = std::sqrt(deviation.rms / static_cast<double>(samples.size()));
  return deviation;
}

double CrossTrack(const DriveSample& sample) { return sample.cross_track_m; }

struct Docking {
  double m = 0, rad = 0;
};
/// Of a track with one sample or more.
Docking DockingOf(const DriveLog& log, const DriveTrack& track) {
  const FloorPose& end = track.samples.back().truth;
  return {(end.position - log.goal.position).norm(),
          std::abs(WrapAngle(end.heading_rad - log.goal.heading_rad))};
}

/// Until the drive ended, or by now where it is under way; nothing before it began.
std::optional<double> TimeOf(const DriveTrack& track) {
  if (track.time_s > 0) return track.time_s;
  if (track.samples.empty()) return std::nullopt;
  return ToSeconds(track.samples.back().stamp_ns);
}

void AddErrors(const DriveLog& log, Scorecard* scores) {
  const std::vector<DriveSample>& samples = log.track.samples;
  const std::size_t n = samples.size();
  const Deviation across = DeviationOf(samples, CrossTrack);
  const Deviation turn =
      DeviationOf(samples, [](const DriveSample& s) { return s.heading_error_rad; });
  const Deviation belief = DeviationOf(
      samples, [](const DriveSample& s) { return (s.belief.position - s.truth.position).norm(); });
  (*scores)["cross_track_rms_m"] = Present(across.rms, "m", n, "none");
  (*scores)["cross_track_max_m"] = Present(across.max, "m", n, "none");
  (*scores)["heading_error_max_deg"] = Present(turn.max / kDegree, "deg", n, "none");
  (*scores)["belief_error_rms_m"] = Present(belief.rms, "m", n, "none");
  (*scores)["belief_error_max_m"] = Present(belief.max, "m", n, "none");
  const Docking docking = DockingOf(log, log.track);
  (*scores)["docking_error_m"] = Present(docking.m, "m", 1, "none");
  (*scores)["docking_error_deg"] = Present(docking.rad / kDegree, "deg", 1, "none");
}

void AddNoErrors(Scorecard* scores) {
  for (const char* name : {"cross_track_rms_m", "cross_track_max_m", "belief_error_rms_m",
                           "belief_error_max_m", "docking_error_m"}) {
    (*scores)[name] = Absent("m", kNotBegun);
  }
  for (const char* name : {"heading_error_max_deg", "docking_error_deg"}) {
    (*scores)[name] = Absent("deg", kNotBegun);
  }
}

void AddWay(const DriveLog& log, Scorecard* scores) {
  double farthest = 0;
  for (const DriveSample& sample : log.track.samples) {
    farthest = std::max(farthest, sample.route_m);
  }
  const bool arrived = log.track.end == DriveEnd::kArrived;
  const double completion = log.route_m > 0 ? std::min(1.0, farthest / log.route_m) : 1;
  const bool whole = arrived && farthest > log.route_m - kLegEnd_m;
  (*scores)["goal_reached"] = Present(ReachedGoal(log, log.track) ? 1 : 0, "1", 1);
  (*scores)["route_completion"] = Present(whole ? 1 : completion, "1", 1);
  log.track.samples.empty() ? AddNoErrors(scores) : AddErrors(log, scores);
}

void AddTruthSteered(const DriveLog& log, Scorecard* scores) {
  const std::vector<DriveSample>& samples = log.truth_steered.samples;
  if (samples.empty()) {
    for (const char* name : {"cross_track_truth_steered_rms_m", "cross_track_truth_steered_max_m",
                             "docking_error_truth_steered_m"}) {
      (*scores)[name] = Absent("m", "no vehicle was steered by truth");
    }
    return;
  }
  const Deviation across = DeviationOf(samples, CrossTrack);
  (*scores)["cross_track_truth_steered_rms_m"] = Present(across.rms, "m", samples.size(), "none");
  (*scores)["cross_track_truth_steered_max_m"] = Present(across.max, "m", samples.size(), "none");
  (*scores)["docking_error_truth_steered_m"] =
      Present(DockingOf(log, log.truth_steered).m, "m", 1, "none");
}

void AddTimes(const DriveLog& log, Scorecard* scores) {
  const DriveTrack& track = log.track;
  const std::optional<double> time_s = TimeOf(track);
  (*scores)["drive_time_s"] = time_s ? Present(*time_s, "s", 1) : Absent("s", kNotBegun);
  (*scores)["time_over_planned"] = !time_s             ? Absent("1", kNotBegun)
                                   : log.planned_s > 0 ? Present(*time_s / log.planned_s, "1", 1)
                                                       : Absent("1", "the way takes no time");
  (*scores)["stops"] = Present(track.stops, "1", 1);
  (*scores)["scanner_stops"] = Present(track.scanner_stops, "1", 1);
  (*scores)["stopped_s"] = Present(track.stopped_s, "s", 1);
  (*scores)["lost_s"] = Present(track.lost_s, "s", 1);
  const auto due = static_cast<std::size_t>(track.frames_due);
  (*scores)["frames_dropped"] = RatioScore(track.frames_due - track.frames_shown, track.frames_due,
                                           "the camera took no frame");
  (*scores)["frames_dropped"].n = due;
}

void AddContacts(const DriveLog& log, Scorecard* scores) {
  const DriveTrack& track = log.track;
  double all = 0, standing = 0, people = 0, vehicles = 0, fastest = 0;
  for (const Contact& contact : track.contacts) {
    if (contact.is_actor && std::abs(contact.speed_mps) <= kUnderWay_mps) continue;
    ++all;
    standing += contact.is_actor ? 0 : 1;
    const bool is_person = contact.object_class == "person";
    people += is_person ? 1 : 0;
    vehicles += contact.is_actor && !is_person ? 1 : 0;
    fastest = std::max(fastest, std::abs(contact.speed_mps));
  }
  (*scores)["collisions"] = Present(all, "1", 1);
  (*scores)["collisions_static"] = Present(standing, "1", 1);
  (*scores)["collisions_person"] = Present(people, "1", 1);
  (*scores)["collisions_vehicle"] = Present(vehicles, "1", 1);
  (*scores)["collision_speed_max_mps"] =
      all > 0 ? Present(fastest, "m/s", static_cast<std::size_t>(all))
              : Absent("m/s", "nothing was touched");
  const auto clearance = [&](const char* name, double least, const char* why) {
    (*scores)[name] =
        std::isfinite(least) ? Present(least, "m", track.samples.size()) : Absent("m", why);
  };
  clearance("min_clearance_static_m", track.min_clearance_static_m, "nothing stands near the way");
  clearance("min_clearance_person_m", track.min_clearance_person_m, "there is nobody");
  clearance("min_clearance_vehicle_m", track.min_clearance_vehicle_m, "there is no other vehicle");
  (*scores)["time_to_collision_min_s"] =
      std::isfinite(track.min_time_to_collision_s)
          ? Present(track.min_time_to_collision_s, "s", track.samples.size())
          : Absent("s", "nobody came nearer");
  (*scores)["zone_violations"] = Present(static_cast<double>(track.violations.size()), "1", 1);
}

}  // namespace

bool ReachedGoal(const DriveLog& log, const DriveTrack& track) {
  if (track.samples.empty()) return false;
  const Docking docking = DockingOf(log, track);
  return track.end == DriveEnd::kArrived && docking.m <= log.goal_tolerance_m &&
         docking.rad <= log.goal_tolerance_rad;
}

Scorecard ScoreDrive(const DriveLog& log) {
  Scorecard scores;
  AddWay(log, &scores);
  AddTruthSteered(log, &scores);
  AddTimes(log, &scores);
  AddContacts(log, &scores);
  return scores;
}

}  // namespace aisle
