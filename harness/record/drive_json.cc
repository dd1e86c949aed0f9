#include "harness/record/drive_json.h"

#include <array>

#include "harness/contract/drive_names.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/json_text.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Enum, std::size_t N>
Enum FromName(const std::array<const char*, N>& names, const std::string& name) {
  for (std::size_t k = 0; k < N; ++k) {
    if (name == names[k]) return static_cast<Enum>(k);
  }
  throw std::invalid_argument("unknown name '" + name + "'");
}

/// Infinite is null: nothing was there.
Json Finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
double OrInfinite(const Json& json) { return json.is_null() ? kInfinity : json.get<double>(); }

Json ToJson(const FloorPose& pose) {
  return {pose.position.x(), pose.position.y(), pose.heading_rad};
}
FloorPose PoseFromJson(const Json& json) {
  return {{json.at(0).get<double>(), json.at(1).get<double>()}, json.at(2).get<double>()};
}

/// A sample as a row, in the order of kColumns.
constexpr const char* kColumns =
    "stamp_ns true_x true_y true_heading believed_x believed_y believed_heading speed_mps "
    "yaw_rate_rad_s cross_track_m heading_error_rad route_m estimate_age_s clearance_static_m "
    "clearance_actor_m mode";

Json ToJson(const DriveSample& s) {
  return {s.stamp_ns,
          s.truth.position.x(),
          s.truth.position.y(),
          s.truth.heading_rad,
          s.belief.position.x(),
          s.belief.position.y(),
          s.belief.heading_rad,
          s.speed_mps,
          s.yaw_rate_rad_s,
          s.cross_track_m,
          s.heading_error_rad,
          s.route_m,
          s.estimate_age_s,
          Finite(s.clearance_static_m),
          Finite(s.clearance_actor_m),
          Name(s.mode)};
}

DriveSample SampleFromJson(const Json& row) {
  const auto number = [&](std::size_t i) { return row.at(i).get<double>(); };
  DriveSample s;
  s.stamp_ns = row.at(0).get<std::int64_t>();
  s.truth = {{number(1), number(2)}, number(3)};
  s.belief = {{number(4), number(5)}, number(6)};
  s.speed_mps = number(7);
  s.yaw_rate_rad_s = number(8);
  s.cross_track_m = number(9);
  s.heading_error_rad = number(10);
  s.route_m = number(11);
  s.estimate_age_s = number(12);
  s.clearance_static_m = OrInfinite(row.at(13));
  s.clearance_actor_m = OrInfinite(row.at(14));
  s.mode = FromName<DriveMode>(kDriveModeNames, row.at(15).get<std::string>());
  return s;
}

Json ToJson(const Contact& contact) {
  return {{"stamp_ns", contact.stamp_ns},       {"with", contact.with},
          {"class", contact.object_class},      {"speed_mps", contact.speed_mps},
          {"vehicle", ToJson(contact.vehicle)}, {"actor", contact.is_actor}};
}

Contact ContactFromJson(const Json& json) {
  return {json.at("stamp_ns").get<std::int64_t>(), json.at("with").get<std::string>(),
          json.at("class").get<std::string>(),     json.at("speed_mps").get<double>(),
          PoseFromJson(json.at("vehicle")),        json.at("actor").get<bool>()};
}

Json ToJson(const std::vector<Eigen::Vector2d>& points) {
  Json json = Json::array();
  for (const Eigen::Vector2d& point : points) json.push_back({point.x(), point.y()});
  return json;
}

std::vector<Eigen::Vector2d> PointsFromJson(const Json& json) {
  std::vector<Eigen::Vector2d> points;
  for (const Json& point : json) {
    points.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
  }
  return points;
}

Json ToJson(const ActorTrack& actor) {
  return {{"name", actor.name},
          {"class", actor.object_class},
          {"radius_m", actor.radius_m},
          {"from", ToJson(actor.from)},
          {"to", ToJson(actor.to)}};
}

ActorTrack ActorFromJson(const Json& json) {
  return {json.at("name").get<std::string>(), json.at("class").get<std::string>(),
          json.at("radius_m").get<double>(), PointsFromJson(json.at("from")),
          PointsFromJson(json.at("to"))};
}

Json ToJson(const DriveTrack& track) {
  Json json = {{"end", Name(track.end)},
               {"time_s", track.time_s},
               {"min_clearance_static_m", Finite(track.min_clearance_static_m)},
               {"min_clearance_person_m", Finite(track.min_clearance_person_m)},
               {"min_clearance_vehicle_m", Finite(track.min_clearance_vehicle_m)},
               {"min_time_to_collision_s", Finite(track.min_time_to_collision_s)},
               {"stops", track.stops},
               {"scanner_stops", track.scanner_stops},
               {"stopped_s", track.stopped_s},
               {"lost_s", track.lost_s},
               {"frames_due", track.frames_due},
               {"frames_shown", track.frames_shown}};
  for (const char* list : {"contacts", "violations", "samples", "actors"})
    json[list] = Json::array();
  for (const Contact& contact : track.contacts) json["contacts"].push_back(ToJson(contact));
  for (const ZoneViolation& violation : track.violations) {
    json["violations"].push_back({{"stamp_ns", violation.stamp_ns},
                                  {"zone", violation.zone},
                                  {"speed_mps", violation.speed_mps}});
  }
  for (const DriveSample& sample : track.samples) json["samples"].push_back(ToJson(sample));
  for (const ActorTrack& actor : track.actors) json["actors"].push_back(ToJson(actor));
  return json;
}

DriveTrack TrackFromJson(const Json& json) {
  DriveTrack track;
  track.end = FromName<DriveEnd>(kDriveEndNames, json.at("end").get<std::string>());
  track.time_s = json.at("time_s").get<double>();
  track.min_clearance_static_m = OrInfinite(json.at("min_clearance_static_m"));
  track.min_clearance_person_m = OrInfinite(json.at("min_clearance_person_m"));
  track.min_clearance_vehicle_m = OrInfinite(json.at("min_clearance_vehicle_m"));
  track.min_time_to_collision_s = OrInfinite(json.at("min_time_to_collision_s"));
  track.stops = json.at("stops").get<int>();
  track.scanner_stops = json.at("scanner_stops").get<int>();
  track.stopped_s = json.at("stopped_s").get<double>();
  track.lost_s = json.at("lost_s").get<double>();
  track.frames_due = json.at("frames_due").get<int>();
  track.frames_shown = json.at("frames_shown").get<int>();
  for (const Json& contact : json.at("contacts")) {
    track.contacts.push_back(ContactFromJson(contact));
  }
  for (const Json& violation : json.at("violations")) {
    track.violations.push_back({violation.at("stamp_ns").get<std::int64_t>(),
                                violation.at("zone").get<std::string>(),
                                violation.at("speed_mps").get<double>()});
  }
  for (const Json& sample : json.at("samples")) track.samples.push_back(SampleFromJson(sample));
  for (const Json& actor : json.at("actors")) track.actors.push_back(ActorFromJson(actor));
  return track;
}

DriveLog FromJson(const Json& json) {
  if (json.at("schema") != kSchema) {
    throw std::invalid_argument(fmt::format("schema is not {}", kSchema));
  }
  DriveLog log;
  for (const Json& pose : json.at("route")) log.route.push_back(PoseFromJson(pose));
  log.route_m = json.at("route_m").get<double>();
  log.planned_s = json.at("planned_s").get<double>();
  log.goal = PoseFromJson(json.at("goal"));
  log.goal_tolerance_m = json.at("goal_tolerance_m").get<double>();
  log.goal_tolerance_rad = json.at("goal_tolerance_rad").get<double>();
  log.footprint = PointsFromJson(json.at("footprint"));
  for (const Json& thing : json.at("things")) {
    log.things.push_back({thing.at("name").get<std::string>(), thing.at("class").get<std::string>(),
                          PointsFromJson(thing.at("outline"))});
  }
  log.latency_ms = json.at("latency_ms").get<double>();
  log.steered_by = json.at("steered_by").get<std::string>();
  log.taught = json.value("taught", false);
  log.track = TrackFromJson(json.at("track"));
  log.truth_steered = TrackFromJson(json.at("truth_steered"));
  return log;
}

}  // namespace

std::string ToJson(const DriveLog& log) {
  Json json = {{"schema", kSchema},
               {"columns", kColumns},
               {"route", Json::array()},
               {"route_m", log.route_m},
               {"planned_s", log.planned_s},
               {"goal", ToJson(log.goal)},
               {"goal_tolerance_m", log.goal_tolerance_m},
               {"goal_tolerance_rad", log.goal_tolerance_rad},
               {"footprint", ToJson(log.footprint)},
               {"things", Json::array()},
               {"latency_ms", log.latency_ms},
               {"steered_by", log.steered_by},
               {"taught", log.taught},
               {"track", ToJson(log.track)},
               {"truth_steered", ToJson(log.truth_steered)}};
  for (const FloorPose& pose : log.route) json["route"].push_back(ToJson(pose));
  for (const FloorThing& thing : log.things) {
    json["things"].push_back(
        {{"name", thing.name}, {"class", thing.object_class}, {"outline", ToJson(thing.outline)}});
  }
  return json.dump() + "\n";
}

DriveLog DriveLogFromJson(const std::string& text, const std::string& file) {
  try {
    return FromJson(ParseJson(text));
  } catch (const std::exception& error) {
    throw InputError(file, 0, "not a drive file: " + Printable(error.what(), 200));
  }
}

void WriteDrive(const DriveLog& log, const std::filesystem::path& report_dir, RunRecord* record) {
  const std::string path = "runs/" + RunId(record->spec) + "/" + kDriveName;
  WriteFileAtomically(report_dir / path, ToJson(log));
  record->artifacts["drive"] = path;
}

std::optional<DriveLog> ReadDrive(const RunRecord& run, const std::filesystem::path& report_dir) {
  const auto file = run.artifacts.find("drive");
  if (file == run.artifacts.end()) return std::nullopt;
  try {
    return DriveLogFromJson(ReadFile(report_dir / file->second), file->second);
  } catch (const InputError&) {
    return std::nullopt;  // removed or damaged: as good as absent
  }
}

}  // namespace aisle
