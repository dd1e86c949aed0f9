#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory.h"
#include "harness/python/arrays.h"
#include "harness/python/track.h"

namespace aisle::python {
namespace {

using StampArray = py::array_t<std::int64_t, py::array::c_style>;

/// Whole numbers of any type that int64 holds. NumPy would cut a list of floats to whole ones,
/// without a word.
StampArray StampsFrom(const py::object& stamps_ns) {
  const py::array given = py::array::ensure(stamps_ns);
  if (given && given.size() == 0) return StampArray(0);  // whose numbers have no type to tell
  if (const StampArray whole = StampArray::ensure(given)) return whole;
  throw py::type_error(
      "stamps_ns: nanoseconds are whole numbers (int64); of seconds make them by "
      "np.round(1e9 * seconds).astype(np.int64)");
}

Track TrackFrom(const py::object& stamps, const NumberArray& poses) {
  const StampArray stamps_ns = StampsFrom(stamps);
  const bool fits = stamps_ns.ndim() == 1 && poses.ndim() == 3 &&
                    poses.shape(0) == stamps_ns.shape(0) && poses.shape(1) == 4 &&
                    poses.shape(2) == 4;
  if (!fits) throw py::value_error("expected stamps_ns int64 (n,) and poses (n, 4, 4)");
  Track track;
  for (py::ssize_t i = 0; i < stamps_ns.shape(0); ++i) {
    const std::int64_t stamp_ns = stamps_ns.at(i);
    if (i > 0 && stamp_ns < track.poses.back().stamp_ns) {
      throw py::value_error(fmt::format("stamps_ns falls at index {}", i));
    }
    const NumberArray pose({4, 4}, poses.data(i, 0, 0), poses);
    track.poses.push_back({stamp_ns, PoseFrom(pose, fmt::format("poses[{}]", i))});
  }
  return track;
}

py::array StampsOf(const Track& track) {
  py::array_t<std::int64_t> stamps(static_cast<py::ssize_t>(track.poses.size()));
  for (std::size_t i = 0; i < track.poses.size(); ++i) {
    stamps.mutable_at(static_cast<py::ssize_t>(i)) = track.poses[i].stamp_ns;
  }
  return stamps;
}

py::array PosesOf(const Track& track) {
  py::array_t<double> poses(
      {static_cast<py::ssize_t>(track.poses.size()), py::ssize_t{4}, py::ssize_t{4}});
  auto at = poses.mutable_unchecked<3>();
  for (std::size_t i = 0; i < track.poses.size(); ++i) {
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        at(static_cast<py::ssize_t>(i), row, column) =
            track.poses[i].T_world_rig.matrix()(row, column);
      }
    }
  }
  return poses;
}

Track Read(const std::filesystem::path& file, const std::optional<std::string>& format,
           const std::filesystem::path& times) {
  const TrajectoryFormat is =
      format ? TrajectoryFormatFromName(*format) : GuessTrajectoryFormat(file);
  if (!times.empty() && is != TrajectoryFormat::kKitti) {
    throw InputError("times: this file has stamps of its own; it is for KITTI's");
  }
  return {ReadTrajectory(file, is, times)};
}

void Write(const Track& track, const std::filesystem::path& file, const std::string& format) {
  WriteFileAtomically(file, FormatTrajectory(track.poses, TrajectoryFormatFromName(format)));
}

}  // namespace

void BindTrack(py::module_& module) {
  py::class_<Track>(module, "Trajectory", "Poses by time: stamps do not fall.")
      .def(py::init(&TrackFrom), py::arg("stamps_ns"), py::arg("poses"),
           "stamps_ns: int64 (n,). poses: (n, 4, 4), each T_world_rig in metres.")
      .def_static("read", &Read, py::arg("file"), py::arg("format") = py::none(),
                  py::arg("times") = "",
                  "From a file in TUM's, KITTI's or EuRoC's format; by its content unless `format` "
                  "says \"tum\", \"kitti\" or\n\"euroc\". times: of a file in KITTI's format its "
                  "sequence's times.txt; without it row k is "
                  "at k * 0.1 s. Raises\nInputError with file and line.")
      .def("write", &Write, py::arg("file"), py::arg("format") = "tum",
           "To a file; every number of TUM's format reads back to the bit.")
      .def_property_readonly("stamps_ns", StampsOf, "int64 (n,).")
      .def_property_readonly("poses", PosesOf, "float64 (n, 4, 4): T_world_rig.")
      .def("__len__", [](const Track& track) { return track.poses.size(); })
      .def("__repr__",
           [](const Track& track) {
             return fmt::format("<aisle.Trajectory of {} poses>", track.poses.size());
           })
      .def(py::pickle(
          [](const Track& track) { return py::make_tuple(StampsOf(track), PosesOf(track)); },
          [](const py::tuple& parts) {
            return TrackFrom(parts[0], parts[1].cast<NumberArray>());
          }));
}

}  // namespace aisle::python
