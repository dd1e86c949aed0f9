#include "simulator/scene/check_beams.h"

#include <fmt/format.h>

#include <set>

#include "simulator/scene/check_given.h"
#include "simulator/scene/degree.h"
#include "simulator/scene/hall.h"

namespace aisle::sim {
namespace {

/// As of a sun's moves: lower, hardly a ray comes through a window.
constexpr double kLowestSun_deg = 1;

class BeamChecker {
 public:
  BeamChecker(const Scene& scene, const BeamSpec& one, std::string key, Issues* issues)
      : hall_(scene.hall), one_(one), key_(std::move(key)), issues_(issues) {}

  void Run() {
    CheckPlace();
    if (one_.kind == BeamKind::kSpot) {
      CheckSpot();
    } else {
      CheckSun();
    }
  }

 private:
  void Say(const std::string& part, const std::string& what) {
    issues_->Add(one_.mark, key_ + part, what);
  }

  void CheckPlace() {
    const Eigen::Vector3d& at = one_.at;
    if (!InHall(hall_, at.head<2>(), 0)) {
      Say(".at_m", fmt::format("[{:g}, {:g}] is outside {}", at.x(), at.y(), HallText(hall_)));
    }
    if (at.z() < 0 || at.z() > hall_.height_m) {
      Say(".at_m", fmt::format("{:g} m is below the floor or above the roof at {:g} m", at.z(),
                               hall_.height_m));
    }
  }

  void CheckSpot() {
    CheckGiven(one_.given, {"a spot", {"width_deg", "rate_hz", "from_s", "until_s"}}, key_,
               issues_);
    if (one_.run.to_s < one_.run.from_s + one_.run.ramp_s) {
      Say(".until_s",
          fmt::format("must be at least {:g} s after `from_s`, the time it takes to speed up",
                      one_.run.ramp_s));
    }
  }

  void CheckSun() {
    CheckGiven(one_.given,
               {"a sun", {"size_m", "facing_deg", "in_roof", "columns", "rows", "bar_m", "moves"}},
               key_, issues_);
    if (one_.elevation_rad < (kLowestSun_deg - 1e-9) * kDegree) {
      Say(".elevation_deg",
          fmt::format(
              "the sun must be {1:g} degrees high or higher, got {0:g}; example: elevation_deg: 35",
              one_.elevation_rad / kDegree, kLowestSun_deg));
    }
    if (hall_.walls == WallKind::kSky) Say("", "a scene under a sky has no windows");
    std::vector<JointMove> times;
    for (const SunMove& move : one_.moves) times.push_back({move.at_s, 0, move.over_s});
    const std::string wrong = MovesError(times);
    if (!wrong.empty()) Say(".moves", wrong);
  }

  const HallSpec& hall_;
  const BeamSpec& one_;
  std::string key_;
  Issues* issues_;
};

}  // namespace

void CheckBeams(const Scene& scene, Issues* issues) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.beams.size(); ++i) {
    const BeamSpec& beam = scene.beams[i];
    const std::string key = fmt::format("beams[{}]", i);
    BeamChecker(scene, beam, key, issues).Run();
    if (!beam.name.empty() && !names.insert(beam.name).second) {
      issues->Add(
          beam.mark, key + ".name",
          fmt::format("another beam is already named '{}'; names must be unique", beam.name));
    }
  }
}

}  // namespace aisle::sim
