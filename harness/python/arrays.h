#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace aisle::python {

namespace py = pybind11;

/// Images come in as they are, of bytes (truth values count as such): another type is a mistake,
/// not a reason to convert.
using ByteArray = py::array_t<std::uint8_t, py::array::c_style>;
/// Poses and the like: whatever converts to doubles.
using NumberArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The image's own memory as an array of its type, (height, width) or (height, width, channels);
/// it lives as long as the array or a slice of it. None for an empty image.
py::object ToArray(const cv::Mat& image);

/// 4 x 4.
py::array ToArray(const Eigen::Isometry3d& pose);
/// (n,) of any vector of numbers, copied.
py::array ToArray(const Eigen::Vector3d& vector);
/// (4,): x, y, width, height.
py::array ToArray(const cv::Rect2d& box);

/// A 4 x 4 rigid motion. Throws py::value_error that names the argument.
Eigen::Isometry3d PoseFrom(const NumberArray& array, const std::string& name);

/// The array's own memory as an image; an empty one for None. Throws py::value_error that names
/// the argument where it has not two dimensions.
cv::Mat1b ImageFrom(const std::optional<ByteArray>& array, const std::string& name);

/// The same as a mask of its own: 255 wherever the array is not zero.
cv::Mat1b MaskFrom(const std::optional<ByteArray>& array, const std::string& name);

}  // namespace aisle::python
