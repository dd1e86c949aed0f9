#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>

#include "harness/contract/drive_names.h"
#include "harness/contract/map_id.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/loop/closed_drive.h"
#include "harness/plugs/simulated_drive.h"
#include "harness/plugs/steering_options.h"
#include "harness/plugs/systems.h"
#include "harness/plugs/wheel_odometry.h"
#include "harness/python/arrays.h"
#include "harness/python/frame.h"
#include "harness/python/module.h"
#include "harness/python/systems.h"
#include "harness/run/mask_makers.h"
#include "harness/score/drive_scores.h"

namespace aisle::python {
namespace {

/// A vehicle under way, steered by one of our systems or by who calls Step.
class Drive {
 public:
  Drive(const std::filesystem::path& scene, std::optional<std::string> system, std::uint64_t seed,
        const py::dict& options, int threads)
      : seed_(seed), threads_(threads) {
    // Without a system only the steering can have options; any system checks those.
    const SystemSpec spec = SpecFrom(system.value_or("plain"), options);
    if (const auto others = WithoutSteering(spec.options); !system && !others.empty()) {
      throw InputError(others.begin()->first +
                       ": without a system the steering alone has options (drive.*)");
    }
    steering_ = SteeringOf(spec.options);
    if (steering_.taught)
      throw py::value_error("drive.taught: a suite teaches, this drive does not");
    if (system) {
      spec_ = spec;
      masks_ = MasksFromTruth(FindSystem(*system).mask_source);
    }
    const SimulatedSequenceOptions simulated{.scene_file = SceneFile(scene.string()),
                                             .scene_name = scene.string(),
                                             .assets_dir = AssetsDir().string(),
                                             .seed = seed,
                                             .threads = threads};
    const py::gil_scoped_release others_may_run;
    scene_ = OpenSimulatedDrive(simulated);
    if (WantsOdometry(spec)) scene_ = WithOdometry(std::move(scene_));
  }

  FramePtr Reset() {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    if (spec_) estimator_ = MakeSystem(*spec_, scene_->calibration(), {.threads = threads_});
    drive_.emplace(*scene_, LoopOptions{.steering = steering_, .seed = seed_});
    estimate_.reset();
    return TakeNext();
  }

  FramePtr Step(const std::optional<NumberArray>& pose) {
    if (spec_ && pose) throw py::value_error("pose: this drive is steered by " + spec_->name);
    std::optional<Eigen::Isometry3d> said;
    int map_id = 0;
    if (pose) said = PoseFrom(*pose, "pose");
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    if (!frame_) throw std::runtime_error("no drive is under way: call reset() first");
    if (spec_) {
      estimate_ = estimator_->Process(frame_->shown.images, masks_(frame_->shown));
      said = estimate_->T_world_rig;
      map_id = MapIdOf(*estimate_);
    }
    drive_->Tell(said, map_id);
    return TakeNext();
  }

  /// With the twin that is told the truth, as the scores want it.
  Scorecard Scores() const {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    DriveLog log = LogOf(scene_->course(), steering_);
    log.track = UnderWay().track();
    TruthLocaliser truth;
    log.truth_steered = DriveClosed(*scene_, &truth, {.steering = steering_, .seed = seed_});
    return ScoreDrive(log);
  }

  DriveSample Now() const {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    return UnderWay().Now();
  }
  std::vector<DriveSample> Samples() const {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    return UnderWay().track().samples;
  }
  std::optional<std::string> End() const {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    return drive_ && !frame_ ? std::optional<std::string>(Name(drive_->track().end)) : std::nullopt;
  }
  const DriveScene& scene() const { return *scene_; }
  std::optional<FrameEstimate> Estimate() const {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    return estimate_;
  }

 private:
  const ClosedDrive& UnderWay() const {
    if (!drive_) throw std::runtime_error("no drive is under way: call reset() first");
    return *drive_;
  }
  FramePtr TakeNext() {
    frame_ = nullptr;
    const Exposure* exposure = drive_->Next();
    if (exposure == nullptr) return nullptr;
    auto frame = std::make_shared<Frame>();
    frame->request = {exposure->id, exposure->stamp_ns, exposure->T_world_rig};
    frame->shown = scene_->Take(*exposure);
    frame_ = frame;
    return frame;
  }

  std::uint64_t seed_;
  int threads_;
  Steering steering_;
  mutable std::mutex mutex_;        ///< one call at a time, whichever thread makes it
  std::optional<SystemSpec> spec_;  ///< none: who calls Step steers
  MaskMaker masks_;
  std::unique_ptr<DriveScene> scene_;
  std::unique_ptr<Estimator> estimator_;
  std::optional<ClosedDrive> drive_;
  std::optional<FrameEstimate> estimate_;
  FramePtr frame_;  ///< that nothing has been said of yet; null: over, or not begun
};

py::array ToArray(const FloorPose& pose) {
  const double numbers[] = {pose.position.x(), pose.position.y(), pose.heading_rad};
  return py::array_t<double>(3, numbers);
}

void BindVehicle(py::module_& module) {
  py::class_<DriveSample>(module, "Vehicle", "The vehicle of a closed drive at one instant.")
      .def_readonly("stamp_ns", &DriveSample::stamp_ns)
      .def_property_readonly(
          "truth", [](const DriveSample& vehicle) { return ToArray(vehicle.truth); },
          "float64 (3,): x, y in metres, heading in radians, of the middle of its fixed axle.")
      .def_property_readonly(
          "belief", [](const DriveSample& vehicle) { return ToArray(vehicle.belief); },
          "The same, where it takes itself to be.")
      .def_readonly("speed_mps", &DriveSample::speed_mps, "True; backwards negative.")
      .def_readonly("yaw_rate_rad_s", &DriveSample::yaw_rate_rad_s, "True.")
      .def_readonly("cross_track_m", &DriveSample::cross_track_m,
                    "Of the true vehicle from its planned route, left positive.")
      .def_readonly("heading_error_rad", &DriveSample::heading_error_rad,
                    "Of the true vehicle from the route's heading.")
      .def_readonly("route_m", &DriveSample::route_m, "How far along its route it truly is.")
      .def_readonly("estimate_age_s", &DriveSample::estimate_age_s,
                    "Of the pose that it steers by.")
      .def_readonly("clearance_static_m", &DriveSample::clearance_static_m,
                    "To the nearest thing that stands; inf: far.")
      .def_readonly("clearance_actor_m", &DriveSample::clearance_actor_m,
                    "To the nearest person or vehicle; inf: far.")
      .def_property_readonly(
          "mode", [](const DriveSample& vehicle) { return Name(vehicle.mode); },
          "\"driving\", \"waiting\", \"degraded\", \"stopped\", \"scanner\" or \"arrived\".")
      .def("__repr__", [](const DriveSample& vehicle) {
        return fmt::format("<aisle.Vehicle at {:.2f} s, {:.2f} m along its route, {}>",
                           1e-9 * static_cast<double>(vehicle.stamp_ns), vehicle.route_m,
                           Name(vehicle.mode));
      });
}

}  // namespace

void BindDrive(py::module_& module) {
  BindVehicle(module);
  py::class_<Drive>(module, "Drive",
                    "A vehicle in a scene with a `drive`, steered by what a system says of each "
                    "picture, taken where the vehicle\ntruly is. Time is the scene's: the same "
                    "answers give the same drive to the bit.")
      .def(py::init<const std::filesystem::path&, std::optional<std::string>, std::uint64_t,
                    const py::dict&, int>(),
           py::arg("scene"), py::arg("system") = "robust", py::arg("seed") = 1,
           py::arg("options") = py::dict(), py::kw_only(), py::arg("threads") = 0,
           "system: one of systems(); None: your own, which tells each pose to step(). options: "
           "those of the system and of\nthe steering, for example {\"drive.latency_ms\": 100}; "
           "without a "
           "system the steering's alone.")
      .def("reset", &Drive::Reset,
           "Puts the vehicle to its start, with a new system. Returns the first Frame.")
      .def("step", &Drive::Step, py::arg("pose") = py::none(),
           "The system looks at the last frame and the vehicle drives on to the next one that it "
           "looks at: that Frame, or None\nwhen the drive is over. pose, where system is None: 4 x "
           "4 "
           "T_world_rig of the last frame in a world of your own\n(the same throughout), or None "
           "for "
           "lost.")
      .def_property_readonly("vehicle", &Drive::Now, "Vehicle now.")
      .def_property_readonly("samples", &Drive::Samples, "A list of Vehicle so far, 20 a second.")
      .def_property_readonly("estimate", &Drive::Estimate,
                             "Estimate of the frame before, of a system of aisle's; else None.")
      .def_property_readonly("end", &Drive::End,
                             "\"arrived\", \"contact\", \"no progress\" or \"timeout\"; None while "
                             "under way.")
      .def("scores", &Drive::Scores,
           "{name: Score} of the drive so far: goal, distance from the route, docking, contacts, "
           "times; beside them those of\nthe same vehicle steered by truth.")
      .def_property_readonly(
          "calibration", [](const Drive& drive) { return drive.scene().calibration(); },
          "Calibration of the vehicle's camera.")
      .def_property_readonly(
          "planned_s", [](const Drive& drive) { return drive.scene().course().planned_s; },
          "Seconds that the route takes as planned.");
}

}  // namespace aisle::python
