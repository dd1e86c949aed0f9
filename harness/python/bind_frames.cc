#include <pybind11/stl.h>

#include "harness/python/arrays.h"
#include "harness/python/frame.h"
#include "harness/python/module.h"

namespace aisle::python {
namespace {

const FrameTruth& TruthOf(const Frame& frame) { return *frame.shown.truth; }

/// Correspondences to the scene's next frame, made once.
const FrameMotion& MotionOf(const Frame& frame) {
  if (frame.source == nullptr || !frame.planned) {
    throw py::value_error(
        "this frame is none of the scene's plan, so nothing says which is next: ask "
        "motion_to(other frame)");
  }
  const py::gil_scoped_release others_may_run;
  std::call_once(frame.once, [&] { frame.motion = frame.source->motion(frame.request); });
  return frame.motion;
}

FrameMotion MotionBetween(const Frame& from, const Frame& to) {
  if (from.source == nullptr || from.source != to.source) {
    throw py::value_error("motion_to: both frames must be of one Simulator");
  }
  const py::gil_scoped_release others_may_run;
  return from.source->motion_between(from.request, to.request);
}

py::array BoxesOf(const Frame& frame) {
  const std::vector<ObjectTruth>& objects = TruthOf(frame).objects;
  py::array_t<double> boxes({static_cast<py::ssize_t>(objects.size()), py::ssize_t{4}});
  auto at = boxes.mutable_unchecked<2>();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const cv::Rect2d& box = objects[i].box_visible;
    const auto row = static_cast<py::ssize_t>(i);
    at(row, 0) = box.x;
    at(row, 1) = box.y;
    at(row, 2) = box.width;
    at(row, 3) = box.height;
  }
  return boxes;
}

void BindCalibration(py::module_& module) {
  py::class_<StereoCalibration>(module, "Calibration",
                                "A rectified stereo rig. Camera: x right, y down, z forward; the "
                                "rig is the left camera, the right\none stands at (baseline_m, 0, "
                                "0). The centre of pixel (0, 0) is u = 0, v = 0.")
      .def(py::init([](int width, int height, double fx, double fy, double cx, double cy,
                       double baseline_m) {
             if (width <= 0 || height <= 0 || !(fx > 0 && fy > 0 && baseline_m > 0)) {
               throw py::value_error("width, height, fx, fy and baseline_m must be positive");
             }
             return StereoCalibration{width, height, fx, fy, cx, cy, baseline_m};
           }),
           py::arg("width"), py::arg("height"), py::arg("fx"), py::arg("fy"), py::arg("cx"),
           py::arg("cy"), py::arg("baseline_m"), "Sizes, focal lengths and centre in pixels.")
      .def_readonly("width", &StereoCalibration::width, "Pixels.")
      .def_readonly("height", &StereoCalibration::height, "Pixels.")
      .def_readonly("fx", &StereoCalibration::fx, "Pixels.")
      .def_readonly("fy", &StereoCalibration::fy, "Pixels.")
      .def_readonly("cx", &StereoCalibration::cx, "Pixels.")
      .def_readonly("cy", &StereoCalibration::cy, "Pixels.")
      .def_readonly("baseline_m", &StereoCalibration::baseline_m, "Metres.")
      .def("__repr__", [](const StereoCalibration& rig) {
        return fmt::format(
            "Calibration(width={}, height={}, fx={:g}, fy={:g}, cx={:g}, cy={:g}, baseline_m={:g})",
            rig.width, rig.height, rig.fx, rig.fy, rig.cx, rig.cy, rig.baseline_m);
      });
}

void BindObjects(py::module_& module) {
  py::class_<ObjectTruth>(module, "Object", "What truth says of one person or vehicle.")
      .def_readonly("label", &ObjectTruth::instance, "Its number in Frame.labels.")
      .def_readonly("object_class", &ObjectTruth::object_class, "\"person\", \"forklift\", ...")
      .def_property_readonly(
          "box", [](const ObjectTruth& object) { return ToArray(object.box_visible); },
          "float64 (4,): x, y, width, height of the pixels that show it.")
      .def_property_readonly(
          "box_full", [](const ObjectTruth& object) { return ToArray(object.box_full); },
          "The same as if nothing stood in front.")
      .def_property_readonly(
          "center_m", [](const ObjectTruth& object) { return ToArray(object.center_m); },
          "float64 (3,): of its 3-D box, world.")
      .def_property_readonly(
          "extent_m", [](const ObjectTruth& object) { return ToArray(object.extent_m); },
          "float64 (3,): full sizes of that box along its own axes.")
      .def_property_readonly(
          "pose", [](const ObjectTruth& object) { return ToArray(object.T_world_object); },
          "float64 (4, 4): T_world_object, z up, x ahead.")
      .def_property_readonly(
          "velocity_mps", [](const ObjectTruth& object) { return ToArray(object.velocity_mps); },
          "float64 (3,): metres a second, world.")
      .def_readonly("visible_share", &ObjectTruth::visible_fraction,
                    "Of its pixels, those that nothing hides: 0 to 1.")
      .def_readonly("visible_pixels", &ObjectTruth::visible_pixels)
      .def_readonly("moving_pixels", &ObjectTruth::dynamic_pixels,
                    "Of these, those on a surface that moves now.")
      .def("__repr__", [](const ObjectTruth& object) {
        return fmt::format("<aisle.Object {} {}, {} pixels>", object.instance, object.object_class,
                           object.visible_pixels);
      });
}

void BindMotion(py::module_& module) {
  py::class_<FrameMotion>(module, "Motion", "Where each left pixel's surface point is elsewhere.")
      .def_property_readonly(
          "flow", [](const FrameMotion& motion) { return ToArray(motion.flow); },
          "float32 (height, width, 2): x, y in pixels; NaN where it is not in front.")
      .def_property_readonly(
          "scene_flow", [](const FrameMotion& motion) { return ToArray(motion.scene_flow); },
          "float32 (height, width, 3): the point's own way, metres, world.")
      .def_property_readonly(
          "disparity", [](const FrameMotion& motion) { return ToArray(motion.disparity); },
          "float32 (height, width): left u - right u in pixels; 0 where nothing was hit.")
      .def_property_readonly(
          "occluded", [](const FrameMotion& motion) { return ToArray(motion.occluded); },
          "uint8 (height, width): 255 where the right camera does not see the point.")
      .def_property_readonly(
          "moving_shadow", [](const FrameMotion& motion) { return ToArray(motion.moving_shadow); },
          "uint8 (height, width): 255 where the surface rests in the shadow of what moves.");
}

using FrameClass = py::class_<Frame, FramePtr>;

void BindPictures(FrameClass* frame) {
  frame
      ->def_property_readonly(
          "index", [](const Frame& frame) { return frame.request.id; },
          "Number of the frame, from 0 on.")
      .def_property_readonly(
          "stamp_ns", [](const Frame& frame) { return frame.request.stamp_ns; },
          "Nanoseconds from the scene's start; the middle of the exposure.")
      .def_property_readonly(
          "left", [](const Frame& frame) { return ToArray(frame.shown.images.left); },
          "uint8 (height, width): grey.")
      .def_property_readonly(
          "right", [](const Frame& frame) { return ToArray(frame.shown.images.right); },
          "uint8 (height, width): grey, the same instant exactly.")
      .def_property_readonly(
          "pose", [](const Frame& frame) { return ToArray(TruthOf(frame).T_world_rig); },
          "float64 (4, 4): T_world_rig, true; metres, world right-handed with z up.");
}

void BindTruth(FrameClass* frame) {
  frame
      ->def_property_readonly(
          "depth", [](const Frame& frame) { return ToArray(TruthOf(frame).depth); },
          "float32 (height, width): z of the left camera in metres, inf where nothing was hit.")
      .def_property_readonly(
          "depth_right", [](const Frame& frame) { return ToArray(TruthOf(frame).depth_right); },
          "The same of the right camera.")
      .def_property_readonly(
          "labels", [](const Frame& frame) { return ToArray(TruthOf(frame).instance); },
          "uint16 (height, width): which thing, see Simulator.things; 0 where nothing was hit.")
      .def_property_readonly(
          "labels_right", [](const Frame& frame) { return ToArray(TruthOf(frame).instance_right); },
          "The same of the right camera.")
      .def_property_readonly(
          "moving", [](const Frame& frame) { return ToArray(TruthOf(frame).dynamic); },
          "uint8 (height, width): 255 where the pixel's surface moves in the world now.")
      .def_property_readonly(
          "moving_right", [](const Frame& frame) { return ToArray(TruthOf(frame).dynamic_right); },
          "The same of the right camera.")
      .def_property_readonly(
          "actors", [](const Frame& frame) { return ToArray(TruthOf(frame).actor); },
          "uint8 (height, width): 255 on people, vehicles and mechanisms, moving or not.")
      .def_property_readonly(
          "actors_right", [](const Frame& frame) { return ToArray(TruthOf(frame).actor_right); },
          "The same of the right camera.")
      .def_property_readonly(
          "objects", [](const Frame& frame) { return TruthOf(frame).objects; },
          "A list of Object: people, vehicles and mechanisms in the left image.")
      .def_property_readonly("boxes", BoxesOf,
                             "float64 (objects, 4): the box of each object, see Object.box.");
}

void BindFlow(FrameClass* frame) {
  frame
      ->def_property_readonly(
          "flow", [](const Frame& frame) { return ToArray(MotionOf(frame).flow); },
          "float32 (height, width, 2): to the scene's next frame, see Motion.flow. Made when first "
          "asked for.")
      .def_property_readonly(
          "motion", [](const Frame& frame) { return MotionOf(frame); },
          "Motion to the scene's next frame, made when first asked for.")
      .def("motion_to", MotionBetween, py::arg("other"),
           "Motion to another frame of the same Simulator: any time, any pose.")
      .def("__repr__", [](const Frame& frame) {
        const cv::Mat1b& left = frame.shown.images.left;
        return fmt::format("<aisle.Frame {}, {} x {}, {} objects>", frame.request.id, left.cols,
                           left.rows, TruthOf(frame).objects.size());
      });
}

}  // namespace

void BindFrames(py::module_& module) {
  BindCalibration(module);
  BindObjects(module);
  BindMotion(module);
  FrameClass frame(module, "Frame",
                   "A stereo pair and its truth. Arrays are the renderer's own memory, without a "
                   "copy; they are yours.\nTruth is the left camera's unless the name says "
                   "otherwise.");
  BindPictures(&frame);
  BindTruth(&frame);
  BindFlow(&frame);
}

}  // namespace aisle::python
