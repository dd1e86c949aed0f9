#include "harness/campaign/teaching.h"

#include <map>
#include <nlohmann/json.hpp>

#include "harness/contract/system_fault.h"
#include "harness/io/file.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/loop/localiser.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kSchema = 1;
constexpr const char* kPosesName = "teaching.json";
constexpr const char* kMapName = "taught.map";
constexpr std::size_t kLargestMap = std::size_t{8} << 30;

/// Below this share of frames with a pose nothing has been taught.
constexpr double kLeastShare = 0.5;
/// Pictures' noise hangs on the frame's number: these are of no drive.
constexpr std::int64_t kFirstTaughtFrame = 1'000'000;

/// Shows the system what the led vehicle's camera sees; asks it nothing.
class Looking : public Localiser {
 public:
  Looking(const DriveScene& scene, Estimator& estimator, const MaskMaker& masks)
      : scene_(scene), estimator_(estimator), masks_(masks) {}

  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    Exposure taught = exposure;
    taught.id += kFirstTaughtFrame;
    const SequenceFrame frame = scene_.Take(taught);
    estimator_.Process(frame.images, masks_(frame));
    T_site_rig_[exposure.stamp_ns] = exposure.T_world_rig;
    return std::nullopt;
  }

  const std::map<std::int64_t, Eigen::Isometry3d>& T_site_rig() const { return T_site_rig_; }

 private:
  const DriveScene& scene_;
  Estimator& estimator_;
  const MaskMaker& masks_;
  std::map<std::int64_t, Eigen::Isometry3d> T_site_rig_;  ///< by stamp
};

}  // namespace

Teaching Teach(const DriveScene& scene, Estimator& estimator, const MaskMaker& masks,
               std::uint64_t seed, const fs::path& map_file) {
  Looking looking(scene, estimator, masks);
  const LoopOptions led{.steering = {.steered_by_truth = true}, .seed = seed};
  const DriveTrack track = DriveClosed(scene, &looking, led);
  const Trajectory said = estimator.Finish();
  const std::size_t shown = looking.T_site_rig().size();
  if (track.end != DriveEnd::kArrived ||
      static_cast<double>(said.size()) < kLeastShare * static_cast<double>(shown) || said.empty()) {
    throw SystemFault(
        RunStatus::kLost,
        fmt::format(
            "the path could not be taught: the system had a pose for only {} of {} frames along it",
            said.size(), shown));
  }
  // Where the teaching began the map is the site's.
  const auto T_site_rig = [&](const StampedPose& pose) {
    return looking.T_site_rig().at(pose.stamp_ns);
  };
  Teaching teaching;
  teaching.T_site_slam = T_site_rig(said.front()) * said.front().T_world_rig.inverse();
  const Eigen::Isometry3d T_rig_vehicle = scene.course().T_vehicle_rig.inverse();
  for (const StampedPose& pose : said) {
    teaching.poses.push_back({FromAbove(T_site_rig(pose) * T_rig_vehicle),
                              FromAbove(teaching.T_site_slam * pose.T_world_rig * T_rig_vehicle)});
  }
  try {
    estimator.SaveMap(map_file);
  } catch (const std::runtime_error& error) {
    throw SystemFault(RunStatus::kCrashed, error.what());
  }
  return teaching;
}

TaughtCourse TaughtBy(const Teaching& teaching, const Course& course) {
  return {TaughtWay(course.way, teaching.poses), teaching.T_site_slam};
}

void KeepTeaching(const Teaching& teaching, const fs::path& map_file, const fs::path& folder) {
  const std::string map = ReadFile(map_file, kLargestMap);
  Json json = {{"schema", kSchema}, {"map_hash", Hash(map)}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      json["T_site_slam"].push_back(teaching.T_site_slam.matrix()(row, column));
    }
  }
  for (const TaughtPose& pose : teaching.poses) {
    json["poses"].push_back({pose.led.position.x(), pose.led.position.y(), pose.led.heading_rad,
                             pose.said.position.x(), pose.said.position.y(),
                             pose.said.heading_rad});
  }
  // Who finds the poses finds the map that they belong to.
  WriteFileAtomically(folder / kMapName, map, Durability::kSurvivesProcessLoss);
  WriteFileAtomically(folder / kPosesName, json.dump(), Durability::kSurvivesProcessLoss);
}

std::optional<Teaching> ReadTeaching(const fs::path& folder, const fs::path& map_file) {
  std::error_code error;
  if (!fs::exists(folder / kPosesName, error)) return std::nullopt;
  try {
    const Json json = Json::parse(ReadFile(folder / kPosesName));
    const std::string map = ReadFile(folder / kMapName, kLargestMap);
    if (json.at("schema") != kSchema || json.at("map_hash") != Hash(map)) return std::nullopt;
    Teaching teaching;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        teaching.T_site_slam.matrix()(row, column) = json.at("T_site_slam").at(4 * row + column);
      }
    }
    for (const Json& pose : json.at("poses")) {
      const auto floor = [&](std::size_t at) {
        return FloorPose{{pose.at(at).get<double>(), pose.at(at + 1).get<double>()},
                         pose.at(at + 2).get<double>()};
      };
      teaching.poses.push_back({floor(0), floor(3)});
    }
    WriteFileAtomically(map_file, map, Durability::kSurvivesProcessLoss);
    fs::last_write_time(folder, fs::file_time_type::clock::now(),
                        error);  // used: not to be deleted
    return teaching;
  } catch (const InputError&) {  // deleted under our hands
  } catch (const Json::exception&) {
  }
  return std::nullopt;
}

}  // namespace aisle
