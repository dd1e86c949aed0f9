#include "harness/report/page/drive_section.h"

#include <list>

#include "harness/common/seconds.h"
#include "harness/contract/drive_names.h"
#include "harness/record/drive_json.h"
#include "harness/report/chart/drive_chart.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/parts.h"
#include "harness/report/page/scene_tables.h"

namespace aisle {
namespace {

double CrossTrackOf(const RunRecord& run) {
  const auto score = run.scores.find("cross_track_max_m");
  return score == run.scores.end() ? -1 : score->second.value.value_or(-1);
}

double CollisionsOf(const RunRecord& run) {
  const auto score = run.scores.find("collisions");
  return score == run.scores.end() ? 0 : score->second.value.value_or(0);
}

/// The run that went worst as a drive: by what it touched, then by how far off it was.
const RunRecord* WorstDrive(const SystemRuns& system) {
  const RunRecord* worst = nullptr;
  for (const RunRecord* run : system.runs) {
    if (!run->artifacts.contains("drive")) continue;
    const auto key = [](const RunRecord& one) {
      return std::pair(CollisionsOf(one), CrossTrackOf(one));
    };
    if (worst == nullptr || key(*run) > key(*worst)) worst = run;
  }
  return worst;
}

std::string ContactRows(const std::string& name, const DriveLog& log) {
  std::string text;
  for (const Contact& contact : log.track.contacts) {
    text += fmt::format("<tr><td>{}<td>{:.2f}<td class=\"left\">{} ({})<td>{:.2f}\n", Escape(name),
                        ToSeconds(contact.stamp_ns), Escape(contact.with),
                        Escape(contact.object_class), std::abs(contact.speed_mps));
  }
  return text;
}

std::string HowItEnded(const DriveSeries& one) {
  const DriveLog& log = *one.log;
  const DriveSample& end = log.track.samples.back();
  const double off_mm = 1000 * (end.truth.position - log.goal.position).norm();
  const double believed_mm = 1000 * (end.belief.position - log.goal.position).norm();
  const double twin_mm =
      log.truth_steered.samples.empty()
          ? 0
          : 1000 * (log.truth_steered.samples.back().truth.position - log.goal.position).norm();
  if (log.track.end != DriveEnd::kArrived) {
    return fmt::format("{}: {} after {:.1f} s, {:.2f} m before its goal", one.name,
                       Name(log.track.end), log.track.time_s, off_mm / 1000);
  }
  const std::string believed =
      log.taught ? fmt::format("by a map that has it {:.1f} mm elsewhere", believed_mm)
                 : fmt::format("and takes it for {:.1f} mm", believed_mm);
  return fmt::format(
      "{}: stands {:.1f} mm from its goal {}; told the truth it would stand {:.1f} mm off",
      one.name, off_mm, believed, twin_mm);
}

}  // namespace

std::string DriveSection(const SceneRuns& scene, const std::filesystem::path& report_dir,
                         const std::string& root) {
  std::list<DriveLog> logs;
  std::vector<DriveSeries> series;
  std::string films;
  for (const SystemRuns& system : scene.systems) {
    const RunRecord* run = WorstDrive(system);
    if (run == nullptr) continue;
    std::optional<DriveLog> log = ReadDrive(*run, report_dir);
    if (!log || log->track.samples.empty()) continue;
    logs.push_back(*std::move(log));
    series.push_back({system.system + ", " + SeedOf(run->spec), system.color, &logs.back()});
    if (const auto film = run->artifacts.find("drive_film"); film != run->artifacts.end()) {
      films += fmt::format(" <a href=\"{}\">{}</a>", root + EscapeUrl(film->second),
                           Escape(series.back().name));
    }
  }
  if (series.empty()) return "";
  std::string text =
      fmt::format("<h3 id=\"{}_steered\">Steered by its estimate</h3>\n", SceneId(scene));
  text += DriveTable(scene.systems) + "<ul>\n";
  for (const DriveSeries& one : series) text += "<li>" + Escape(HowItEnded(one)) + ".\n";
  text += "</ul>\n";
  text += Figure(DrivePlanChart(series),
                 "From above: planned route (dashed), true paths, and estimated paths (thin); "
                 "footprints where each vehicle was farthest from its route, touched something "
                 "and stopped. The worst seed of each system.");
  text += Figure(DriveErrorChart(series),
                 "Distance of the true vehicle from its route; shaded: held, or without a pose; "
                 "crosses: contacts.");
  if (!films.empty()) {
    text += "<p>Films, from above beside the camera's picture:" + films + ".</p>\n";
  }
  std::string contacts;
  for (const DriveSeries& one : series) contacts += ContactRows(one.name, *one.log);
  if (!contacts.empty()) {
    text +=
        "<div class=\"wide\"><table><tr><th>system<th>time<br>[s]<th class=\"left\">touches"
        "<th>vehicle's speed<br>[m/s]\n" +
        contacts + "</table></div>\n";
  }
  return text;
}

}  // namespace aisle
