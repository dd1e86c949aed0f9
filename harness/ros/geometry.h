#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace aisle::ros {

// Messages of ROS 2 as Humble, Jazzy and Rolling have them. Each struct lists its fields once, in
// wire order; writer, reader and definition (cdr.h, definition.h) all go by that list.

/// Since 1970, UTC.
struct Time {
  static constexpr const char* kType = "builtin_interfaces/Time";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;  ///< in [0, 1e9)
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("sec", self.sec);
    archive("nanosec", self.nanosec);
  }
};

struct Duration {
  static constexpr const char* kType = "builtin_interfaces/Duration";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("sec", self.sec);
    archive("nanosec", self.nanosec);
  }
};

struct Header {
  static constexpr const char* kType = "std_msgs/Header";
  Time stamp = {};
  std::string frame_id = {};  ///< in which the message's coordinates are
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("stamp", self.stamp);
    archive("frame_id", self.frame_id);
  }
};

/// In [0, 1].
struct ColorRGBA {
  static constexpr const char* kType = "std_msgs/ColorRGBA";
  float r = 0;
  float g = 0;
  float b = 0;
  float a = 0;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("r", self.r);
    archive("g", self.g);
    archive("b", self.b);
    archive("a", self.a);
  }
};

struct String {
  static constexpr const char* kType = "std_msgs/String";
  std::string data = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("data", self.data);
  }
};

/// Metres.
struct Point {
  static constexpr const char* kType = "geometry_msgs/Point";
  double x = 0;
  double y = 0;
  double z = 0;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("x", self.x);
    archive("y", self.y);
    archive("z", self.z);
  }
};

struct Vector3 {
  static constexpr const char* kType = "geometry_msgs/Vector3";
  double x = 0;
  double y = 0;
  double z = 0;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("x", self.x);
    archive("y", self.y);
    archive("z", self.z);
  }
};

struct Quaternion {
  static constexpr const char* kType = "geometry_msgs/Quaternion";
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 1;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("x", self.x);
    archive("y", self.y);
    archive("z", self.z);
    archive("w", self.w);
  }
};

struct Pose {
  static constexpr const char* kType = "geometry_msgs/Pose";
  Point position = {};
  Quaternion orientation = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("position", self.position);
    archive("orientation", self.orientation);
  }
};

struct PoseStamped {
  static constexpr const char* kType = "geometry_msgs/PoseStamped";
  Header header = {};
  Pose pose = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("pose", self.pose);
  }
};

struct PoseWithCovariance {
  static constexpr const char* kType = "geometry_msgs/PoseWithCovariance";
  Pose pose = {};
  std::array<double, 36> covariance = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("pose", self.pose);
    archive("covariance", self.covariance);
  }
};

struct PoseWithCovarianceStamped {
  static constexpr const char* kType = "geometry_msgs/PoseWithCovarianceStamped";
  Header header = {};
  PoseWithCovariance pose = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("pose", self.pose);
  }
};

struct Transform {
  static constexpr const char* kType = "geometry_msgs/Transform";
  Vector3 translation = {};
  Quaternion rotation = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("translation", self.translation);
    archive("rotation", self.rotation);
  }
};

/// T_parent_child: child coordinates to those of the header's frame.
struct TransformStamped {
  static constexpr const char* kType = "geometry_msgs/TransformStamped";
  Header header = {};
  std::string child_frame_id = {};
  Transform transform = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("child_frame_id", self.child_frame_id);
    archive("transform", self.transform);
  }
};

/// m/s and rad/s.
struct Twist {
  static constexpr const char* kType = "geometry_msgs/Twist";
  Vector3 linear = {};
  Vector3 angular = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("linear", self.linear);
    archive("angular", self.angular);
  }
};

struct TwistWithCovariance {
  static constexpr const char* kType = "geometry_msgs/TwistWithCovariance";
  Twist twist = {};
  std::array<double, 36> covariance = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("twist", self.twist);
    archive("covariance", self.covariance);
  }
};

struct TFMessage {
  static constexpr const char* kType = "tf2_msgs/TFMessage";
  std::vector<TransformStamped> transforms = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("transforms", self.transforms);
  }
};

struct Odometry {
  static constexpr const char* kType = "nav_msgs/Odometry";
  Header header = {};
  std::string child_frame_id = {};
  PoseWithCovariance pose = {};
  TwistWithCovariance twist = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("child_frame_id", self.child_frame_id);
    archive("pose", self.pose);
    archive("twist", self.twist);
  }
};

struct Path {
  static constexpr const char* kType = "nav_msgs/Path";
  Header header = {};
  std::vector<PoseStamped> poses = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("poses", self.poses);
  }
};

/// No coordinate of a pose is further from the origin: as of trajectories in files
/// (contract/rigid.h, which this room does not see; bag_trajectory.cc holds the two together).
inline constexpr double kMostCoordinate_m = 1e8;

Time TimeOf(std::int64_t stamp_ns);
Duration DurationOf(std::int64_t duration_ns);
std::int64_t NanosecondsOf(const Time& time);
Pose PoseOf(const Eigen::Isometry3d& T_frame_body);
Transform TransformOf(const Eigen::Isometry3d& T_parent_child);
/// Rotation normalised. Throws CdrError where a number is not finite, a coordinate is beyond
/// kMostCoordinate_m, or the quaternion's norm is not 1 within 5 %.
Eigen::Isometry3d IsometryOf(const Pose& pose);
Eigen::Isometry3d IsometryOf(const Transform& transform);

}  // namespace aisle::ros
