#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>

#include "harness/contract/map_id.h"
#include "harness/contract/state_name.h"
#include "harness/io/input_error.h"
#include "harness/plugs/steering_options.h"
#include "harness/plugs/systems.h"
#include "harness/plugs/wheel_odometry.h"
#include "harness/python/arrays.h"
#include "harness/python/module.h"
#include "harness/python/systems.h"
#include "harness/python/track.h"

namespace aisle::python {
namespace {

/// What a drive or a recording would heed: here it would do nothing, without a word.
void RefuseWithoutEffect(const SystemSpec& spec) {
  for (const auto& [path, value] : spec.options) {
    if (!IsSteeringOption(path)) continue;
    throw InputError(path + ": a Slam steers nothing; aisle.Drive takes it");
  }
  if (WantsOdometry(spec)) throw InputError("odometry: track() is told of no wheels");
}

class Slam {
 public:
  Slam(const StereoCalibration& calibration, const py::dict& options, const std::string& system,
       int threads, const std::filesystem::path& load_map, bool localise_only)
      : calibration_(calibration) {
    const SystemSetup setup{
        .threads = threads, .load_map = load_map, .localise_only = localise_only};
    const SystemSpec spec = SpecFrom(system, options);
    RefuseWithoutEffect(spec);
    const py::gil_scoped_release others_may_run;
    try {
      estimator_ = MakeSystem(spec, calibration, setup);
    } catch (const std::runtime_error& error) {
      throw InputError(error.what());  // the files a system starts from are input
    }
  }

  FrameEstimate Track(const ByteArray& left, const ByteArray& right, std::int64_t stamp_ns,
                      const std::optional<ByteArray>& mask,
                      const std::optional<ByteArray>& mask_right) {
    StereoFrame frame{0, stamp_ns, ImageFrom(left, "left"), ImageFrom(right, "right")};
    const ExternalMask rejected{MaskFrom(mask, "mask"), MaskFrom(mask_right, "mask_right")};
    CheckSize(frame.left, "left");
    CheckSize(frame.right, "right");
    if (mask) CheckSize(rejected.left, "mask");
    if (mask_right) CheckSize(rejected.right, "mask_right");
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    if (finished_) throw std::runtime_error("finish() has ended this drive: make another Slam");
    frame.id = frames_;
    FrameEstimate estimate = estimator_->Process(frame, rejected);
    ++frames_;  // not of one that was refused
    if (MapIdOf(estimate) != map_id_) live_.poses.clear();
    map_id_ = MapIdOf(estimate);
    if (estimate.T_world_rig) live_.poses.push_back({stamp_ns, *estimate.T_world_rig});
    return estimate;
  }

  python::Track Finish() {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    if (!finished_) final_.poses = estimator_->Finish();
    finished_ = true;
    return final_;
  }

  void SaveMap(const std::filesystem::path& file) {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    estimator_->SaveMap(file);
  }

  python::Track Live() const {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard one_at_a_time(mutex_);
    return live_;
  }

 private:
  void CheckSize(const cv::Mat1b& image, const char* name) const {
    if (image.cols == calibration_.width && image.rows == calibration_.height) return;
    throw py::value_error(
        fmt::format("{} is {} x {}, but the calibration says {} x {} (width x height)", name,
                    image.cols, image.rows, calibration_.width, calibration_.height));
  }

  StereoCalibration calibration_;
  std::unique_ptr<Estimator> estimator_;
  mutable std::mutex mutex_;  ///< one frame at a time, whichever thread brings it
  python::Track live_, final_;
  int map_id_ = 0;  ///< of live_
  std::int64_t frames_ = 0;
  bool finished_ = false;
};

py::array KeypointsOf(const FrameEstimate& estimate) {
  py::array_t<float> points({static_cast<py::ssize_t>(estimate.keypoints.size()), py::ssize_t{2}});
  auto at = points.mutable_unchecked<2>();
  for (std::size_t i = 0; i < estimate.keypoints.size(); ++i) {
    at(static_cast<py::ssize_t>(i), 0) = estimate.keypoints[i].x;
    at(static_cast<py::ssize_t>(i), 1) = estimate.keypoints[i].y;
  }
  return points;
}

py::array InliersOf(const FrameEstimate& estimate) {
  py::array_t<bool> inliers(static_cast<py::ssize_t>(estimate.keypoint_is_inlier.size()));
  for (std::size_t i = 0; i < estimate.keypoint_is_inlier.size(); ++i) {
    inliers.mutable_at(static_cast<py::ssize_t>(i)) = estimate.keypoint_is_inlier[i];
  }
  return inliers;
}

void BindEstimate(py::module_& module) {
  py::class_<FrameEstimate>(module, "Estimate", "What a SLAM says of a frame, at that frame.")
      .def_readonly("stamp_ns", &FrameEstimate::stamp_ns)
      .def_property_readonly(
          "state", [](const FrameEstimate& estimate) { return StateName(estimate.state); },
          "\"initializing\", \"tracking\" or \"lost\".")
      .def_property_readonly(
          "pose",
          [](const FrameEstimate& estimate) -> py::object {
            if (!estimate.T_world_rig) return py::none();
            return ToArray(*estimate.T_world_rig);
          },
          "float64 (4, 4): T_world_rig in a world of the SLAM's own, metres; None while lost.")
      .def_property_readonly(
          "map_id", &MapIdOf,
          "Which world pose is of: rises where the SLAM gives up its map and begins "
          "another; poses of different ids\ncannot be compared.")
      .def_property_readonly(
          "mask", [](const FrameEstimate& estimate) { return ToArray(estimate.regions.mask); },
          "uint8 (height, width): 255 where it rejected what moves; None if it makes no masks.")
      .def_property_readonly("keypoints", KeypointsOf,
                             "float32 (n, 2): x, y in the left image, pixels.")
      .def_property_readonly("inliers", InliersOf,
                             "bool (n,): the keypoint took part in the pose; may be empty.")
      .def_readonly("counts", &FrameEstimate::counts, "{name: number}: features, inliers, ...")
      .def_readonly("stage_ms", &FrameEstimate::stage_ms, "{stage: wall time in milliseconds}.")
      .def("__repr__", [](const FrameEstimate& estimate) {
        return fmt::format("<aisle.Estimate at {} ns, {}>", estimate.stamp_ns,
                           StateName(estimate.state));
      });
}

py::dict SystemsByName() {
  py::dict systems;
  for (const System& system : Systems()) systems[py::str(system.name)] = system.description;
  return systems;
}

py::dict OptionsByPath(const std::string& system) {
  py::dict options;
  for (const SystemOption& option : OptionsOf(FindSystem(system))) {
    options[py::str(option.path)] = py::make_tuple(option.value, option.unit, option.help);
  }
  return options;
}

}  // namespace

void BindSlam(py::module_& module) {
  BindEstimate(module);
  py::class_<Slam>(module, "Slam",
                   "A stereo SLAM, one for each drive. The same frames give the same poses to the "
                   "bit.")
      .def(
          py::init<const StereoCalibration&, const py::dict&, const std::string&, int,
                   const std::filesystem::path&, bool>(),
          py::arg("calibration"), py::arg("options") = py::dict(), py::kw_only(),
          py::arg("system") = "robust", py::arg("threads") = 0, py::arg("load_map") = "",
          py::arg("localise_only") = false,
          "options: {path: value}, see options(system), but for drive.* and odometry. system: one "
          "of systems().\nload_map: a map of an earlier drive to go on in; localise_only leaves it "
          "as it is. Raises InputError for an option\nthat is none or would have no effect, or a "
          "map that cannot be read.")
      .def(
          "track", &Slam::Track, py::arg("left"), py::arg("right"), py::arg("stamp_ns"),
          py::arg("mask") = py::none(), py::arg("mask_right") = py::none(),
          "left, right: uint8 (height, width), rectified grey. stamp_ns: rising nanoseconds. mask: "
          "uint8 or bool, not 0 = do not use,\nof the left and of the right image. Returns "
          "Estimate; a hard "
          "frame is not an error but \"lost\". Other Python threads\nrun meanwhile.")
      .def(
          "finish", &Slam::Finish,
          "Ends the drive, waits for background work: the final Trajectory after all optimisation.")
      .def_property_readonly(
          "live", &Slam::Live,
          "Trajectory so far, each pose as known at its frame, those of the last map_id; a "
          "copy.")
      .def("save_map", &Slam::SaveMap, py::arg("file"), "Writes the map for a later load_map.");
  module.def("systems", SystemsByName, "{name: description} of the systems that come with aisle.");
  module.def("options", OptionsByPath, py::arg("system") = "robust",
             "{path: (value, unit, sentence)} of every option of a system.");
}

}  // namespace aisle::python
