#include "harness/bag/frame_messages.h"

#include <opencv2/imgproc.hpp>

#include "harness/ros/geometry.h"

namespace aisle {
namespace {

const ros::ColorRGBA kMoving{.r = 1.0f, .g = 0.27f, .b = 0.24f, .a = 0.5f};
const ros::ColorRGBA kStanding{.r = 0.31f, .g = 0.67f, .b = 1.0f, .a = 0.35f};

std::string EncodingOf(const cv::Mat& image) {
  switch (image.type()) {
    case CV_8UC1:
      return "mono8";
    case CV_16UC1:
      return "16UC1";
    case CV_32FC1:
      return "32FC1";
    case CV_8UC3:
      return "bgr8";
    default:
      throw std::invalid_argument("an image of this kind has no name in ROS");
  }
}

/// fx * baseline, rounded such that dividing by fx gives the baseline back.
double FocalTimesBaseline(double fx, double baseline_m) {
  const double product = fx * baseline_m;
  for (const double near :
       {product, std::nextafter(product, 0.0), std::nextafter(product, HUGE_VAL)}) {
    if (near / fx == baseline_m) return near;
  }
  return product;
}

const ros::ColorRGBA& ColourOf(const ObjectTruth& object) {
  return object.dynamic_pixels > 0 ? kMoving : kStanding;
}

ros::Marker MarkerOf(const ros::Header& header, const ObjectTruth& object, std::int32_t type) {
  ros::Marker marker;
  marker.header = header;
  marker.ns = type == ros::kText ? "names" : "boxes";
  marker.id = object.instance;
  marker.type = type;
  marker.action = ros::kAdd;
  Eigen::Isometry3d box = object.T_world_object;
  box.translation() = object.center_m;
  marker.pose = ros::PoseOf(box);
  marker.color = ColourOf(object);
  return marker;
}

}  // namespace

ros::Image ImageMessage(const ros::Header& header, const cv::Mat& image) {
  ros::Image message;
  message.header = header;
  message.height = static_cast<std::uint32_t>(image.rows);
  message.width = static_cast<std::uint32_t>(image.cols);
  message.encoding = EncodingOf(image);
  const std::size_t step = static_cast<std::size_t>(image.cols) * image.elemSize();
  message.step = static_cast<std::uint32_t>(step);
  message.data.resize(step * static_cast<std::size_t>(image.rows));
  for (int y = 0; y < image.rows; ++y) {
    std::memcpy(message.data.data() + step * static_cast<std::size_t>(y), image.ptr(y), step);
  }
  return message;
}

ros::Image ColourMessage(const ros::Header& header, const cv::Mat3b& picture) {
  cv::Mat rgb;
  cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
  ros::Image message = ImageMessage(header, rgb);
  message.encoding = "rgb8";
  return message;
}

ros::CameraInfo CameraInfoMessage(const ros::Header& header, const StereoCalibration& c, int side) {
  ros::CameraInfo info;
  info.header = header;
  info.height = static_cast<std::uint32_t>(c.height);
  info.width = static_cast<std::uint32_t>(c.width);
  info.distortion_model = "plumb_bob";
  info.d = {0, 0, 0, 0, 0};
  info.k = {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1};
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double shift = side == 0 ? 0 : -FocalTimesBaseline(c.fx, c.baseline_m);
  info.p = {c.fx, 0, c.cx, shift, 0, c.fy, c.cy, 0, 0, 0, 1, 0};
  return info;
}

ros::Odometry OdometryMessage(const ros::Header& header, const std::string& base,
                              const OdometryReading& reading) {
  const auto rows = [](const Eigen::Matrix<double, 6, 6>& matrix) {
    std::array<double, 36> numbers;
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(numbers.data()) = matrix;
    return numbers;
  };
  const auto vector = [&](int first) {
    return ros::Vector3{
        .x = reading.twist[first], .y = reading.twist[first + 1], .z = reading.twist[first + 2]};
  };
  ros::Odometry message;
  message.header = header;
  message.child_frame_id = base;
  message.pose = {.pose = ros::PoseOf(reading.T_odom_base), .covariance = rows(reading.covariance)};
  message.twist = {.twist = {.linear = vector(0), .angular = vector(3)},
                   .covariance = rows(reading.twist_covariance)};
  return message;
}

ros::MarkerArray BoxMarkers(const ros::Header& header, const std::vector<ObjectTruth>& objects) {
  ros::MarkerArray array;
  array.markers.emplace_back();
  array.markers.back().header = header;
  array.markers.back().action = ros::kDeleteAll;
  for (const ObjectTruth& object : objects) {
    if (object.extent_m.isZero()) continue;
    ros::Marker box = MarkerOf(header, object, ros::kCube);
    box.scale = {.x = object.extent_m.x(), .y = object.extent_m.y(), .z = object.extent_m.z()};
    array.markers.push_back(box);
    constexpr double kTextHeight = 0.3;
    ros::Marker name = MarkerOf(header, object, ros::kText);
    name.pose.position.z += 0.5 * object.extent_m.z() + kTextHeight;
    name.scale = {.x = 0, .y = 0, .z = kTextHeight};
    name.color.a = 1;
    name.text = fmt::format("{} {:.1f} m/s", object.object_class, object.velocity_mps.norm());
    array.markers.push_back(name);
  }
  return array;
}

ros::ImageMarker ImageBoxes(const ros::Header& header, const std::vector<ObjectTruth>& objects) {
  ros::ImageMarker lines;
  lines.header = header;
  lines.ns = "boxes";
  lines.type = ros::kLineList;
  lines.action = ros::kAdd;
  lines.scale = 2;
  lines.outline_color = kMoving;
  lines.outline_color.a = 1;
  for (const ObjectTruth& object : objects) {
    if (object.visible_pixels == 0) continue;
    const cv::Point2d a = object.box_visible.tl(), c = object.box_visible.br();
    const std::array<ros::Point, 4> corner = {{{.x = a.x, .y = a.y, .z = 0},
                                               {.x = c.x, .y = a.y, .z = 0},
                                               {.x = c.x, .y = c.y, .z = 0},
                                               {.x = a.x, .y = c.y, .z = 0}}};
    ros::ColorRGBA colour = ColourOf(object);
    colour.a = 1;
    for (std::size_t i = 0; i < corner.size(); ++i) {
      lines.points.push_back(corner[i]);
      lines.points.push_back(corner[(i + 1) % corner.size()]);
      lines.outline_colors.insert(lines.outline_colors.end(), 2, colour);
    }
  }
  return lines;
}

}  // namespace aisle
