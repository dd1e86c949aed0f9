#include "harness/loop/closed_drive.h"

#include <algorithm>
#include <numeric>

#include "harness/common/mix.h"
#include "harness/common/seconds.h"
#include "harness/loop/contact_watch.h"
#include "harness/loop/server.h"
#include "harness/loop/traffic.h"
#include "harness/vehicle/pilot.h"

namespace aisle {
namespace {

constexpr std::int64_t kTick_ns = 10'000'000;  // of control
constexpr std::int64_t kSampleEvery_ns = 50'000'000;
static_assert(kSampleEvery_ns % kTick_ns == 0, "samples are taken in ticks");
constexpr double kSettle_s = 0.3;  // standing at the goal before the drive is over

std::int64_t Milliseconds(double ms) { return std::llround(1e6 * ms); }

/// How long each frame takes.
std::function<std::int64_t(std::int64_t)> LatencyOf(const Steering& steering, std::uint64_t seed) {
  const std::vector<double>& profile = steering.latency_profile_ms;
  if (profile.empty()) {
    return [ns = Milliseconds(steering.latency_ms)](std::int64_t) { return ns; };
  }
  return [profile, seed](std::int64_t frame) {
    const std::uint64_t drawn = Mix(Mix(seed + kGolden) + static_cast<std::uint64_t>(frame));
    return Milliseconds(profile[drawn % profile.size()]);
  };
}

double MeanLatency_ms(const Steering& steering) {
  const std::vector<double>& profile = steering.latency_profile_ms;
  if (profile.empty()) return steering.latency_ms;
  return std::accumulate(profile.begin(), profile.end(), 0.0) / static_cast<double>(profile.size());
}

/// The longest that the system takes for a frame.
double LongestLatency_s(const Steering& steering) {
  const std::vector<double>& profile = steering.latency_profile_ms;
  const double ms = profile.empty() ? steering.latency_ms : *std::ranges::max_element(profile);
  return 1e-3 * ms;
}

PilotOptions PilotOf(const Course& course, double frame_s, const LoopOptions& loop) {
  const Steering& steering = loop.steering;
  PilotOptions options;
  if (loop.taught) options.T_site_slam = loop.taught->T_site_slam;
  options.driver = course.driver;
  options.driver.law = steering.driver.value_or(course.driver.law);
  // The longest that a healthy system is silent: it works, and its next frame is yet to come.
  options.watch.latency_s = LongestLatency_s(steering) + frame_s;
  options.T_vehicle_rig = course.T_vehicle_rig;
  return options;
}

}  // namespace

class ClosedDrive::Loop {
 public:
  Loop(const DriveScene& scene, const LoopOptions& options)
      : scene_(scene),
        course_(scene.course()),
        options_(options),
        server_(options.steering.queue, LatencyOf(options.steering, options.seed)),
        pilot_(options.taught ? options.taught->way : course_.way, course_.start,
               PilotOf(course_, 1 / scene.rate_hz(), options)),
        odometer_(course_.odometry, course_.plant, options.seed),
        traffic_(scene),
        contacts_(course_, &track_) {
    plant_.pose = course_.start;
    for (const CourseActor& actor : course_.actors) {
      track_.actors.push_back({.name = actor.name, .object_class = actor.object_class});
    }
    const auto is_drive = [](const WayLeg& leg) { return leg.kind == WayLeg::Kind::kDrive; };
    on_leg_ =
        static_cast<std::size_t>(std::ranges::find_if(course_.way, is_drive) - course_.way.begin());
    contacts_.See(Now(), 0, 0);
  }

  const Exposure* Next() {
    const std::int64_t limit_ns = std::llround(
        1e9 * (options_.timeout_over_planned * course_.planned_s + options_.timeout_extra_s));
    while (!over_) {
      // Who is done as a frame arrives and takes the newest takes this one; who drops what comes
      // while it works has to be done before it comes.
      if (server_.rule() == QueueRule::kNewest) PhotographIfDue();
      Listen();
      if (const Exposure* asked = server_.asked()) return asked;
      if (PhotographIfDue()) continue;
      if (now_ns_ % kTick_ns == 0) Tick();
      if (now_ns_ >= limit_ns && !over_) End(DriveEnd::kTimeout);
      if (failed_) End(DriveEnd::kFailed);
      if (!over_) Advance(NextEvent() - now_ns_);
    }
    return nullptr;
  }

  void Tell(const std::optional<Eigen::Isometry3d>& T_slam_rig, int map_id) {
    const Exposure* asked = server_.asked();
    if (asked == nullptr) throw std::logic_error("no frame waits for an answer");
    if (!options_.steering.steered_by_truth) return server_.Tell(T_slam_rig, map_id);
    server_.Tell(Eigen::Isometry3d(asked->T_world_rig));  // shown, and told the truth instead
  }

  void Fail() { failed_ = true; }

  DriveSample Sample() const {
    const WayLeg& on = course_.way[on_leg_];
    const double back = on.reverse ? std::numbers::pi : 0;
    const bool on_way = mode_ != DriveMode::kWaiting && pilot_.driver().leg == on_leg_;
    DriveSample sample{.stamp_ns = now_ns_, .truth = plant_.pose, .belief = pilot_.belief()};
    sample.speed_mps = Speed();
    sample.yaw_rate_rad_s = plant_.turn_rate_rad_s;
    sample.cross_track_m = truth_.cross_track_m;
    sample.heading_error_rad =
        on_way ? WrapAngle(plant_.pose.heading_rad + back - truth_.heading_rad) : 0;
    sample.route_m = before_leg_m_ + on_leg_m_;
    if (const auto by = pilot_.steers_by_ns()) sample.estimate_age_s = ToSeconds(now_ns_ - *by);
    sample.clearance_static_m = contacts_.clearance_static_m();
    sample.clearance_actor_m = contacts_.clearance_actor_m();
    sample.mode = mode_;
    return sample;
  }

  const DriveTrack& track() const { return track_; }

 private:
  std::int64_t NextEvent() const {
    const std::int64_t tick = (now_ns_ / kTick_ns + 1) * kTick_ns;
    const std::int64_t event = std::min(tick, scene_.Stamp(frame_));
    const std::optional<std::int64_t> due = server_.NextDue();
    return due && *due > now_ns_ ? std::min(event, *due) : event;
  }

  double Speed() const { return plant_.AheadSpeed(course_.plant.kind); }

  Encounter Now() const {
    return {now_ns_, plant_.pose, Speed(), traffic_.capsules(), plant_.turn_rate_rad_s};
  }

  void Listen() {
    for (const Answer& answer : server_.Due(now_ns_)) {
      pilot_.Told(answer.frame_ns, now_ns_, answer.T_slam_rig, answer.map_id);
    }
    track_.frames_shown = server_.shown();  // one that waited may have been begun
  }

  /// False where no frame is due, or the system is yet to tell of one.
  bool PhotographIfDue() {
    if (now_ns_ != scene_.Stamp(frame_) || server_.asked() != nullptr) return false;
    Photograph();
    return true;
  }

  void Photograph() {
    ++track_.frames_due;
    Exposure exposure{.id = frame_++, .stamp_ns = now_ns_};
    exposure.T_world_rig = scene_.RigAt(plant_.pose, now_ns_);
    exposure.clocks = traffic_.clocks();
    exposure.wheels = wheels_;
    // The camera's own motion, jolts included, from where it is a little before and after.
    constexpr std::int64_t kHalf_ns = 2'000'000;
    const auto rig_at = [&](std::int64_t offset_ns) {
      const double s = ToSeconds(offset_ns);
      return scene_.RigAt(AlongArc(plant_.pose, Speed() * s, plant_.turn_rate_rad_s * s),
                          now_ns_ + offset_ns);
    };
    const Eigen::Isometry3d before = rig_at(-kHalf_ns), after = rig_at(kHalf_ns);
    const double over_s = ToSeconds(2 * kHalf_ns);
    const Eigen::Matrix3d back = exposure.T_world_rig.linear().transpose();
    exposure.velocity_mps = back * (after.translation() - before.translation()) / over_s;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(before.linear().transpose() * after.linear()));
    exposure.turn_rate_rad_s = turn.angle() * turn.axis() / over_s;
    server_.Offer(exposure);
  }

  void Tick() {
    const double tick_s = ToSeconds(kTick_ns);
    command_ = pilot_.Decide(now_ns_, tick_s);
    mode_ = pilot_.mode();
    if (options_.steering.scanner) HoldByScanner(tick_s);
    CountTime(tick_s);
    FollowTruth();
    if (now_ns_ % kSampleEvery_ns == 0) AddSample();
    LookForTheEnd(tick_s);
  }

  /// Who is held and stands without a pose asks for nothing: whether its field is clear is judged
  /// by what it asked for last. While its route lets it stand there is nothing to judge.
  void HoldByScanner(double tick_s) {
    if (mode_ == DriveMode::kWaiting || mode_ == DriveMode::kArrived) return;
    const bool wants = std::abs(command_.speed_mps) > 0 || std::abs(command_.turn_rate_rad_s) > 0;
    if (wants) asked_ = command_;
    const bool blocked =
        (wants || held_) && (asked_.speed_mps == 0 ? IsTurnBlocked() : IsWayBlocked());
    clear_s_ = blocked ? 0 : clear_s_ + tick_s;
    if (blocked && !held_) ++track_.scanner_stops;
    if (blocked) held_ = true;
    if (held_ && clear_s_ >= options_.scanner.clear_s) held_ = false;
    if (!held_) return;
    command_ = {.protective_stop = true};
    mode_ = DriveMode::kScanner;
  }

  bool IsWayBlocked() const {
    const ScannerOptions& scanner = options_.scanner;
    const double toward = asked_.speed_mps < 0 ? -1 : 1;
    const double speed = std::max(std::abs(Speed()), held_ ? scanner.restart_mps : 0.0);
    const Polygon field =
        ProtectiveField(course_.footprint, toward * speed, course_.plant, scanner);
    return IsBlocked(course_, plant_.pose, field, traffic_.capsules());
  }

  /// On the spot, as far as it turns before it can stand.
  bool IsTurnBlocked() const {
    const ScannerOptions& scanner = options_.scanner;
    const double toward = asked_.turn_rate_rad_s < 0 ? -1 : 1;
    const double rate =
        std::max(std::abs(plant_.turn_rate_rad_s), held_ ? scanner.restart_rad_s : 0.0);
    const double turn = rate * scanner.reaction_s + StoppingTurn(rate, course_.plant);
    const double way_per_rad = TurningRadius(course_.plant);
    const Polygon field = TurningField(course_.footprint, scanner);
    constexpr double kStep_rad = 0.05;
    const int steps = static_cast<int>(std::ceil(turn / kStep_rad));
    for (int k = 0; k <= steps; ++k) {
      const double by = std::min(k * kStep_rad, turn);
      const FloorPose there = AlongArc(plant_.pose, by * way_per_rad, toward * by);
      if (IsBlocked(course_, there, field, traffic_.capsules())) return true;
    }
    return false;
  }

  void CountTime(double tick_s) {
    // The first frame is taken as the drive begins.
    const bool never_told =
        !pilot_.steers_by_ns() && ToSeconds(now_ns_) > LongestLatency_s(options_.steering);
    // Also while the scanner holds it.
    const DriveMode driver = pilot_.mode();
    const bool lost = driver == DriveMode::kDegraded || driver == DriveMode::kStopped || never_told;
    const bool stopped = mode_ == DriveMode::kStopped || mode_ == DriveMode::kScanner;
    if (lost) track_.lost_s += tick_s;
    if (stopped) track_.stopped_s += tick_s;
    if (mode_ == DriveMode::kStopped && last_mode_ != DriveMode::kStopped) ++track_.stops;
    last_mode_ = mode_;
  }

  /// Where the true vehicle is on its route: on the leg that the driver drives, or drove last. What
  /// it did not reach of a leg that the driver believes to have ended it never drives.
  void FollowTruth() {
    const std::size_t leg = pilot_.driver().leg;
    const bool drives = leg < course_.way.size() && course_.way[leg].kind == WayLeg::Kind::kDrive;
    if (drives && leg != on_leg_) {
      const double length = course_.way[on_leg_].length_m();
      before_leg_m_ += farthest_on_leg_m_ > length - kLegEnd_m ? length : farthest_on_leg_m_;
      on_leg_ = leg;
      on_leg_m_ = farthest_on_leg_m_ = 0;
    }
    const WayLeg& on = course_.way[on_leg_];
    truth_ = Nearest(on, plant_.pose.position, on_leg_m_);
    on_leg_m_ = std::clamp(truth_.distance_m, 0.0, on.length_m());
    farthest_on_leg_m_ = std::max(farthest_on_leg_m_, on_leg_m_);
  }

  void AddSample() {
    track_.samples.push_back(Sample());
    for (std::size_t i = 0; i < track_.actors.size(); ++i) {
      const Capsule& capsule = traffic_.capsules()[i];
      track_.actors[i].radius_m = capsule.radius_m;
      track_.actors[i].from.push_back(capsule.from);
      track_.actors[i].to.push_back(capsule.to);
    }
  }

  void LookForTheEnd(double tick_s) {
    if (contacts_.hit_static()) return End(DriveEnd::kContact);
    settled_s_ = pilot_.arrived() ? settled_s_ + tick_s : 0;
    if (settled_s_ >= kSettle_s) return End(DriveEnd::kArrived);
    const DriverState& driver = pilot_.driver();
    // Who has no pose does not pause: it stands.
    const bool pauses = mode_ == DriveMode::kWaiting && pilot_.steers_by_ns() &&
                        driver.leg < course_.way.size() &&
                        course_.way[driver.leg].kind == WayLeg::Kind::kPause;
    const bool steers = std::abs(plant_.steering_rad - steered_rad_) > 0.01 * tick_s;
    steered_rad_ = plant_.steering_rad;
    const bool goes_on = pauses || steers || std::abs(Speed()) > 0.01 ||
                         std::abs(plant_.turn_rate_rad_s) > 0.01 || pilot_.arrived();
    stands_s_ = goes_on ? 0 : stands_s_ + tick_s;
    if (stands_s_ >= options_.no_progress_after_s) End(DriveEnd::kNoProgress);
  }

  void End(DriveEnd end) {
    over_ = true;
    track_.end = end;
    track_.time_s = ToSeconds(now_ns_);
    if (track_.samples.empty() || track_.samples.back().stamp_ns != now_ns_) {
      AddSample();
    }
  }

  void Advance(std::int64_t duration_ns) {
    const PlantStep step = Move(plant_, command_, ToSeconds(duration_ns), course_.plant);
    plant_ = step.state;
    now_ns_ += duration_ns;
    const FloorPose measured = odometer_.Measure(step);
    wheels_.Add(measured);
    pilot_.Rolled(now_ns_, measured);
    traffic_.Advance(duration_ns, plant_.pose, Speed(), plant_.turn_rate_rad_s);
    contacts_.See(Now(), step.way_m, step.turn_rad);
  }

  const DriveScene& scene_;
  const Course& course_;
  const LoopOptions options_;
  DriveTrack track_;
  Server server_;
  Pilot pilot_;
  Odometer odometer_;
  Reckoning wheels_;
  Traffic traffic_;
  ContactWatch contacts_;
  PlantState plant_;
  DriveCommand command_, asked_;  ///< asked_: the last that was to move it
  DriveMode mode_ = DriveMode::kWaiting, last_mode_ = DriveMode::kWaiting;
  std::int64_t now_ns_ = 0, frame_ = 0;
  std::size_t on_leg_ = 0;  ///< of the way: the drive that the true vehicle is held against
  double on_leg_m_ = 0, farthest_on_leg_m_ = 0, before_leg_m_ = 0;
  OnWay truth_;
  double settled_s_ = 0, stands_s_ = 0, clear_s_ = 0;
  double steered_rad_ = 0;  ///< a tick ago
  bool held_ = false, over_ = false, failed_ = false;
};

ClosedDrive::ClosedDrive(const DriveScene& scene, const LoopOptions& options)
    : loop_(std::make_unique<Loop>(scene, options)) {}
ClosedDrive::ClosedDrive(ClosedDrive&&) noexcept = default;
ClosedDrive::~ClosedDrive() = default;

const Exposure* ClosedDrive::Next() { return loop_->Next(); }
void ClosedDrive::Tell(const std::optional<Eigen::Isometry3d>& T_slam_rig, int map_id) {
  loop_->Tell(T_slam_rig, map_id);
}
void ClosedDrive::Fail() { loop_->Fail(); }
DriveSample ClosedDrive::Now() const { return loop_->Sample(); }
const DriveTrack& ClosedDrive::track() const { return loop_->track(); }

std::string Validate(const Steering& steering) {
  const auto is_latency = [](double ms) { return ms >= 0 && ms <= kLongestLatency_ms; };
  if (!is_latency(steering.latency_ms)) {
    return fmt::format("latency_ms is {:g}, expected 0 to {:g}", steering.latency_ms,
                       kLongestLatency_ms);
  }
  if (steering.latency_ms > 0 && !steering.latency_profile_ms.empty()) {
    return "latency_ms and latency_profile_ms are both given: a frame takes the one or one of the "
           "other's; leave one out";
  }
  for (const double ms : steering.latency_profile_ms) {
    if (!is_latency(ms)) {
      return fmt::format("a latency of the profile is {:g} ms, expected 0 to {:g}", ms,
                         kLongestLatency_ms);
    }
  }
  if (steering.taught && steering.steered_by_truth) {
    return "taught and steered_by_truth are both true: set one of them to false";
  }
  return "";
}

DriveTrack DriveClosed(const DriveScene& scene, Localiser* localiser, const LoopOptions& options) {
  ClosedDrive drive(scene, options);
  while (const Exposure* frame = drive.Next()) {
    const std::optional<Eigen::Isometry3d> T_slam_rig = localiser->Locate(*frame);
    drive.Tell(T_slam_rig, localiser->map_id());
    if (localiser->failed()) drive.Fail();
  }
  return drive.track();
}

namespace {

/// What stands near enough to the route to be worth drawing.
std::vector<FloorThing> ThingsNear(const std::vector<FloorPose>& route,
                                   const std::vector<StandingThing>& things) {
  constexpr double kNear_m = 5;
  constexpr std::size_t kEvery = 25;  // points of the route
  std::vector<FloorThing> near;
  for (const StandingThing& thing : things) {
    for (std::size_t i = 0; i < route.size(); i += kEvery) {
      const Capsule place{route[i].position, route[i].position, kNear_m};
      if (Distance(thing.outline, place) > 0) continue;
      near.push_back({thing.name, thing.object_class, thing.outline});
      break;
    }
  }
  return near;
}

}  // namespace

DriveLog LogOf(const Course& course, const Steering& steering) {
  DriveLog log;
  for (const WayLeg& leg : course.way) {
    const double back = leg.reverse ? std::numbers::pi : 0;
    for (const WayPoint& point : leg.points) {
      log.route.push_back({point.position, point.heading_rad + back});
    }
    log.route_m += leg.length_m();
  }
  log.planned_s = course.planned_s;
  log.goal = log.route.empty() ? course.start : log.route.back();
  for (const WayLeg& leg : course.way) {
    if (leg.kind == WayLeg::Kind::kTurn) log.goal.heading_rad = leg.turn_to_rad;
    if (leg.kind == WayLeg::Kind::kDrive) {
      log.goal.heading_rad = leg.points.back().heading_rad + (leg.reverse ? std::numbers::pi : 0);
    }
  }
  log.goal_tolerance_m = course.goal_tolerance_m;
  log.goal_tolerance_rad = course.goal_tolerance_rad;
  log.footprint = course.footprint;
  log.things = ThingsNear(log.route, course.things);
  log.latency_ms = MeanLatency_ms(steering);
  log.steered_by = steering.steered_by_truth ? "truth" : "estimate";
  return log;
}

}  // namespace aisle
