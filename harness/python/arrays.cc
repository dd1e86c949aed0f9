#include "harness/python/arrays.h"

#include "harness/contract/rigid.h"

namespace aisle::python {
namespace {

py::dtype TypeOf(const cv::Mat& image) {
  switch (image.depth()) {
    case CV_8U:
      return py::dtype::of<std::uint8_t>();
    case CV_16U:
      return py::dtype::of<std::uint16_t>();
    case CV_32F:
      return py::dtype::of<float>();
    default:
      throw std::logic_error("unsupported image type");
  }
}

}  // namespace

py::object ToArray(const cv::Mat& image) {
  if (image.empty()) return py::none();
  // The header counts among those who use the pixels.
  auto* owner = new cv::Mat(image);
  const py::capsule keeper(owner, [](void* mat) { delete static_cast<cv::Mat*>(mat); });
  const auto channel = static_cast<py::ssize_t>(image.elemSize1());
  std::vector<py::ssize_t> shape = {image.rows, image.cols};
  std::vector<py::ssize_t> strides = {static_cast<py::ssize_t>(image.step[0]),
                                      static_cast<py::ssize_t>(image.elemSize())};
  if (image.channels() > 1) {
    shape.push_back(image.channels());
    strides.push_back(channel);
  }
  return py::array(TypeOf(image), shape, strides, owner->data, keeper);
}

py::array ToArray(const Eigen::Isometry3d& pose) {
  py::array_t<double> array({4, 4});
  auto at = array.mutable_unchecked<2>();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) at(row, column) = pose.matrix()(row, column);
  }
  return array;
}

py::array ToArray(const Eigen::Vector3d& vector) { return py::array_t<double>(3, vector.data()); }

py::array ToArray(const cv::Rect2d& box) {
  const double numbers[] = {box.x, box.y, box.width, box.height};
  return py::array_t<double>(4, numbers);
}

Eigen::Isometry3d PoseFrom(const NumberArray& array, const std::string& name) {
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) {
    throw py::value_error(name + ": expected a 4 x 4 matrix");
  }
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Matrix4d matrix = Eigen::Map<const RowMajor>(array.data());
  constexpr double kTolerance = 1e-3;
  Eigen::Isometry3d pose;
  pose.matrix() = matrix;
  if (!IsRigid(pose, kTolerance) ||
      !matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kTolerance)) {
    throw py::value_error(
        fmt::format("{}: not a rigid motion (rotation, translation of at most {:g} m, last row "
                    "0 0 0 1)",
                    name, kFarthest_m));
  }
  return pose;
}

cv::Mat1b ImageFrom(const std::optional<ByteArray>& array, const std::string& name) {
  if (!array) return {};
  if (array->ndim() != 2) throw py::value_error(name + ": expected an array (height, width)");
  // OpenCV has no word for an image that is only read.
  auto* bytes = const_cast<std::uint8_t*>(array->data());
  return {static_cast<int>(array->shape(0)), static_cast<int>(array->shape(1)), bytes};
}

cv::Mat1b MaskFrom(const std::optional<ByteArray>& array, const std::string& name) {
  const cv::Mat1b image = ImageFrom(array, name);
  if (image.empty()) return {};
  return cv::Mat1b(image != 0);
}

}  // namespace aisle::python
