#include "harness/report/picture/drive_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/common/seconds.h"
#include "harness/report/picture/video.h"

namespace aisle {
namespace {

constexpr int kShift = 4;  // sub-pixel bits of OpenCV's drawing
const cv::Scalar kFloor(240, 238, 236), kThing(175, 160, 150), kThingEdge(120, 105, 95),
    kRoute(150, 150, 150), kTrue(60, 60, 200), kBelieved(200, 120, 30), kPerson(60, 150, 60),
    kTruck(40, 130, 235), kTouched(40, 40, 230), kInk(40, 40, 40);

const char* InWords(DriveMode mode) {
  switch (mode) {
    case DriveMode::kDriving:
      return "driving";
    case DriveMode::kWaiting:
      return "waiting";
    case DriveMode::kDegraded:
      return "no pose: creeps by its wheels";
    case DriveMode::kStopped:
      return "lost: protective stop";
    case DriveMode::kScanner:
      return "held by its scanner";
    case DriveMode::kArrived:
      break;
  }
  return "takes itself to be at its goal";
}

/// Paper whose middle is a place of the floor.
class Sheet {
 public:
  Sheet(cv::Size size, double px_per_m, const Eigen::Vector2d& middle)
      : picture(size, cv::Vec3b(236, 238, 240)), px_per_m_(px_per_m), middle_(middle) {
    picture.setTo(kFloor);
  }

  cv::Point At(const Eigen::Vector2d& point) const {
    constexpr int kUnit = 1 << kShift;
    const Eigen::Vector2d px = (point - middle_) * px_per_m_;
    // What lies far outside would overflow the drawing's fixed point.
    const auto clamp = [](double v) { return std::clamp(v, -20000.0, 20000.0); };
    return {static_cast<int>(clamp(picture.cols / 2.0 + px.x()) * kUnit),
            static_cast<int>(clamp(picture.rows / 2.0 - px.y()) * kUnit)};
  }
  void Fill(const std::vector<Eigen::Vector2d>& outline, const cv::Scalar& colour) {
    const std::vector<cv::Point> points = Points(outline);
    cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{points}, colour, cv::LINE_AA, kShift);
  }
  void Edge(const std::vector<Eigen::Vector2d>& outline, const cv::Scalar& colour, bool closed,
            int width = 1) {
    cv::polylines(picture, Points(outline), closed, colour, width, cv::LINE_AA, kShift);
  }
  void Capsule(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_m,
               const cv::Scalar& colour) {
    const int radius = static_cast<int>(radius_m * px_per_m_);
    cv::line(picture, At(from), At(to), colour, std::max(1, 2 * radius), cv::LINE_AA, kShift);
    for (const Eigen::Vector2d& end : {from, to}) {
      cv::circle(picture, At(end), radius << kShift, colour, cv::FILLED, cv::LINE_AA, kShift);
    }
  }
  void Text(const std::string& text, int line) {
    cv::putText(picture, text, {6, 14 + 14 * line}, cv::FONT_HERSHEY_SIMPLEX, 0.36, kInk, 1,
                cv::LINE_AA);
  }

  cv::Mat3b picture;

 private:
  std::vector<cv::Point> Points(const std::vector<Eigen::Vector2d>& outline) const {
    std::vector<cv::Point> points;
    for (const Eigen::Vector2d& corner : outline) points.push_back(At(corner));
    return points;
  }
  double px_per_m_;
  Eigen::Vector2d middle_;
};

std::vector<Eigen::Vector2d> Placed(const DriveLog& log, const FloorPose& pose) {
  std::vector<Eigen::Vector2d> placed;
  for (const Eigen::Vector2d& corner : log.footprint) placed.push_back(pose * corner);
  return placed;
}

/// Contacts of the last second, which colour the vehicle.
const Contact* JustTouched(const DriveTrack& track, std::int64_t stamp_ns) {
  for (const Contact& contact : track.contacts) {
    if (contact.stamp_ns <= stamp_ns && stamp_ns < contact.stamp_ns + 1'000'000'000) {
      return &contact;
    }
  }
  return nullptr;
}

}  // namespace

DriveView::DriveView(const DriveLog& log, cv::Size size, double px_per_m)
    : log_(log), size_(size), px_per_m_(px_per_m) {}

cv::Mat3b DriveView::At(std::size_t index) const {
  const DriveTrack& track = log_.track;
  const DriveSample& now = track.samples[std::min(index, track.samples.size() - 1)];
  Sheet sheet(size_, px_per_m_, now.truth.position);
  for (const FloorThing& thing : log_.things) {
    sheet.Fill(thing.outline, kThing);
    sheet.Edge(thing.outline, kThingEdge, true);
  }
  std::vector<Eigen::Vector2d> route, true_way, believed_way;
  for (const FloorPose& pose : log_.route) route.push_back(pose.position);
  for (std::size_t i = 0; i <= index && i < track.samples.size(); ++i) {
    true_way.push_back(track.samples[i].truth.position);
    believed_way.push_back(track.samples[i].belief.position);
  }
  sheet.Edge(route, kRoute, false);
  for (const ActorTrack& actor : track.actors) {
    if (index >= actor.from.size()) continue;
    sheet.Capsule(actor.from[index], actor.to[index], actor.radius_m,
                  actor.object_class == "person" ? kPerson : kTruck);
  }
  const Contact* touched = JustTouched(track, now.stamp_ns);
  sheet.Fill(Placed(log_, now.truth), touched != nullptr ? kTouched : cv::Scalar(205, 205, 245));
  sheet.Edge(Placed(log_, now.truth), kTrue, true, 2);
  sheet.Edge(Placed(log_, now.belief), kBelieved, true);
  sheet.Edge(true_way, kTrue, false, 2);
  sheet.Edge(believed_way, kBelieved, false);
  sheet.Text(fmt::format("{:.1f} s  {:.2f} m/s  {}", ToSeconds(now.stamp_ns), now.speed_mps,
                         InWords(now.mode)),
             0);
  sheet.Text(fmt::format("off its route {:+.1f} cm", 100 * now.cross_track_m), 1);
  sheet.Text(fmt::format("estimate {:.1f} cm off",
                         100 * (now.belief.position - now.truth.position).norm()),
             2);
  if (touched != nullptr) sheet.Text("touches " + touched->with, 3);
  return sheet.picture;
}

void DriveFilm::Keep(std::int64_t stamp_ns, const cv::Mat3b& picture) {
  std::vector<unsigned char> packed;
  cv::imencode(".jpg", picture, packed, {cv::IMWRITE_JPEG_QUALITY, 88});
  pictures_.emplace_back(stamp_ns, std::move(packed));
}

bool DriveFilm::Write(const DriveLog& log, const std::filesystem::path& file,
                      double rate_hz) const {
  if (pictures_.empty() || log.track.samples.empty() || !Video::Available()) return false;
  constexpr double kAcross_m = 9;
  Video video(file, rate_hz);
  for (const auto& [stamp_ns, packed] : pictures_) {
    const cv::Mat3b camera = cv::imdecode(packed, cv::IMREAD_COLOR);
    const auto after =
        std::ranges::upper_bound(log.track.samples, stamp_ns, {}, &DriveSample::stamp_ns);
    const auto index = std::max<std::ptrdiff_t>(0, after - log.track.samples.begin() - 1);
    const cv::Size size(camera.rows / 2 * 2, camera.rows);
    cv::Mat3b both;
    cv::hconcat(camera,
                DriveView(log, size, size.width / kAcross_m).At(static_cast<std::size_t>(index)),
                both);
    video.Add(both);
  }
  return video.Finish();
}

}  // namespace aisle
