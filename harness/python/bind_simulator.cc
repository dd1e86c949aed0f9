#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <thread>

#include "harness/contract/twin.h"
#include "harness/io/places.h"
#include "harness/python/arrays.h"
#include "harness/python/frame.h"
#include "harness/python/module.h"
#include "harness/python/track.h"

namespace aisle::python {
namespace {

/// Ctrl-C while the light is solved; Python's own error is set.
struct Interrupted : std::exception {};

/// Lets Python look after its signals now and then. They belong to the thread that called; others
/// that help it pass by.
TellLightWork AnswerSignals() {
  return [caller = std::this_thread::get_id()](const LightWork&) {
    if (std::this_thread::get_id() != caller) return;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw Interrupted();
  };
}

class Simulator {
 public:
  Simulator(const std::filesystem::path& scene, std::uint64_t seed, std::string twin, int threads)
      : scene_(scene.string()), twin_(std::move(twin)), seed_(seed), threads_(threads) {
    const SimulatedSequenceOptions options{.scene_file = SceneFile(scene_),
                                           .scene_name = scene_,
                                           .assets_dir = AssetsDir().string(),
                                           .twin = twin_,
                                           .seed = seed,
                                           .threads = threads,
                                           .any_lens = true,
                                           .light_progress = AnswerSignals()};
    try {
      const py::gil_scoped_release others_may_run;
      source_ = std::make_shared<SimulationForExport>(OpenForExport(options));
      schedule_ = source_->sequence->Schedule();
    } catch (const Interrupted&) {
      throw py::error_already_set();
    }
  }

  FramePtr Render(std::int64_t index, const std::optional<NumberArray>& pose,
                  std::optional<std::int64_t> stamp_ns) const {
    const auto count = static_cast<std::int64_t>(schedule_.size());
    if (index < 0) index += count;  // as sequences have it
    if (index < 0 || index >= count) {
      throw py::index_error(
          fmt::format("frame {}: the scene has frames 0 to {}", index, count - 1));
    }
    const auto frame = std::make_shared<Frame>();
    frame->request = schedule_[static_cast<std::size_t>(index)];
    frame->source = source_;
    frame->planned = !pose && !stamp_ns;
    if (stamp_ns) {
      if (*stamp_ns < 0) throw py::value_error("stamp_ns: scenes begin at 0");
      frame->request.stamp_ns = *stamp_ns;
      frame->request.T_world_rig = source_->path(*stamp_ns);
    }
    if (pose) frame->request.T_world_rig = PoseFrom(*pose, "pose");
    const py::gil_scoped_release others_may_run;
    frame->shown = source_->sequence->At(frame->request);
    return frame;
  }

  Track Planned() const {
    Track track;
    for (const FrameRequest& frame : schedule_) {
      track.poses.push_back({frame.stamp_ns, frame.T_world_rig});
    }
    return track;
  }

  const SimulationForExport& source() const { return *source_; }
  std::size_t size() const { return schedule_.size(); }
  py::tuple arguments() const { return py::make_tuple(scene_, seed_, twin_, threads_); }
  std::string name() const { return scene_; }

 private:
  std::string scene_, twin_;
  std::uint64_t seed_;
  int threads_;
  Source source_;
  std::vector<FrameRequest> schedule_;
};

void BindThings(py::module_& module) {
  py::class_<LabelInfo>(module, "Thing", "What a number in Frame.labels stands for.")
      .def_readonly("name", &LabelInfo::name, "As the scene calls it.")
      .def_readonly("object_class", &LabelInfo::object_class, "\"person\", \"rack\", ...")
      .def_readonly("class_id", &LabelInfo::class_id, "The class as a number, 0 to 255.")
      .def_readonly("can_move", &LabelInfo::moving, "May move at some time.")
      .def("__repr__", [](const LabelInfo& thing) {
        return fmt::format("<aisle.Thing {} ({})>", thing.name, thing.object_class);
      });
}

}  // namespace

void BindSimulator(py::module_& module) {
  BindTrack(module);
  BindThings(module);
  py::class_<Simulator>(
      module, "Simulator",
      "A scene that can be photographed at any time from any pose. A frame is a function of "
      "(scene, "
      "seed, index,\ntime, pose) alone: the same arguments give the same bytes, in any order, from "
      "any number of threads.")
      .def(
          py::init<const std::filesystem::path&, std::uint64_t, std::string, int>(),
          py::arg("scene"), py::arg("seed") = 1, py::arg("twin") = twin::kLive,
          py::arg("threads") = 0,
          "scene: a file, or the name of one that comes with aisle (\"paper/scene2\"). twin: live, "
          "empty (no actors),\nfrozen (they stand), or none, low, mid, high (level of dynamics). "
          "threads: 0 takes all; never changes a pixel.\nThe first time a scene is opened its "
          "light "
          "is solved, seconds to minutes, and kept; Ctrl-C ends that.\nRaises InputError with "
          "file, "
          "line and fix for a bad scene.")
      .def(
          "render", &Simulator::Render, py::arg("index"), py::kw_only(),
          py::arg("pose") = py::none(), py::arg("stamp_ns") = py::none(),
          "Frame number `index` (negative: from the end): as the scene plans it; or at `pose`, a 4 "
          "x 4 T_world_rig in\nmetres; or at another time, nanoseconds from the scene's start. The "
          "index seeds the sensor's noise; while the\nshutter is open the rig moves as on its "
          "route. Other Python threads run meanwhile.")
      .def(
          "__getitem__",
          [](const Simulator& simulator, std::int64_t index) {
            return simulator.Render(index, std::nullopt, std::nullopt);
          },
          py::arg("index"), "The same as render(index), so that a scene can be iterated over.")
      .def("__len__", &Simulator::size, "Frames as planned.")
      .def_property_readonly("name", &Simulator::name, "The scene as it was asked for.")
      .def_property_readonly(
          "calibration",
          [](const Simulator& simulator) { return simulator.source().sequence->calibration(); },
          "Calibration of the pair; of a scene with a distorted lens see `lens`.")
      .def_property_readonly(
          "lens",
          [](const Simulator& simulator) {
            const LensCalibration& lens = simulator.source().lens;
            return std::pair(lens.model, lens.coefficients);
          },
          "(model, [k1, k2, p1, p2]): \"none\" is a rectified pair, else \"radial-tangential\" or "
          "\"equidistant\".")
      .def_property_readonly(
          "rate_hz",
          [](const Simulator& simulator) { return simulator.source().sequence->rate_hz(); },
          "Frames a second.")
      .def_property_readonly(
          "things", [](const Simulator& simulator) { return simulator.source().labels; },
          "A list of Thing; the index is the number in Frame.labels.")
      .def_property_readonly("trajectory", &Simulator::Planned,
                             "Trajectory of the rig as planned: the truth of every frame.")
      .def_property_readonly(
          "content_hash",
          [](const Simulator& simulator) { return simulator.source().content_hash; },
          "Of all that decides the pixels: scene, assets, seed, twin.")
      .def("__repr__",
           [](const Simulator& simulator) {
             return fmt::format("<aisle.Simulator {}, {} frames>", simulator.name(),
                                simulator.size());
           })
      .def(py::pickle([](const Simulator& simulator) { return simulator.arguments(); },
                      [](const py::tuple& arguments) {
                        return Simulator(py::cast<std::string>(arguments[0]),
                                         py::cast<std::uint64_t>(arguments[1]),
                                         py::cast<std::string>(arguments[2]),
                                         py::cast<int>(arguments[3]));
                      }));
}

}  // namespace aisle::python
