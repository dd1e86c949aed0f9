#pragma once

#include "harness/ros/sensor.h"

namespace aisle::ros {

// What viewers draw, and what they list. As in geometry.h: one list of fields per message.

struct UVCoordinate {
  static constexpr const char* kType = "visualization_msgs/UVCoordinate";
  float u = 0;
  float v = 0;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("u", self.u);
    archive("v", self.v);
  }
};

struct MeshFile {
  static constexpr const char* kType = "visualization_msgs/MeshFile";
  std::string filename = {};
  std::vector<std::uint8_t> data = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("filename", self.filename);
    archive("data", self.data);
  }
};

struct Marker {
  static constexpr const char* kType = "visualization_msgs/Marker";
  Header header = {};
  std::string ns = {};
  std::int32_t id = 0;
  std::int32_t type = 0;
  std::int32_t action = 0;
  Pose pose = {};
  Vector3 scale = {};
  ColorRGBA color = {};
  Duration lifetime = {};
  bool frame_locked = false;
  std::vector<Point> points = {};
  std::vector<ColorRGBA> colors = {};
  std::string texture_resource = {};
  CompressedImage texture = {};
  std::vector<UVCoordinate> uv_coordinates = {};
  std::string text = {};
  std::string mesh_resource = {};
  MeshFile mesh_file = {};
  bool mesh_use_embedded_materials = false;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("ns", self.ns);
    archive("id", self.id);
    archive("type", self.type);
    archive("action", self.action);
    archive("pose", self.pose);
    archive("scale", self.scale);
    archive("color", self.color);
    archive("lifetime", self.lifetime);
    archive("frame_locked", self.frame_locked);
    archive("points", self.points);
    archive("colors", self.colors);
    archive("texture_resource", self.texture_resource);
    archive("texture", self.texture);
    archive("uv_coordinates", self.uv_coordinates);
    archive("text", self.text);
    archive("mesh_resource", self.mesh_resource);
    archive("mesh_file", self.mesh_file);
    archive("mesh_use_embedded_materials", self.mesh_use_embedded_materials);
  }
};

struct MarkerArray {
  static constexpr const char* kType = "visualization_msgs/MarkerArray";
  std::vector<Marker> markers = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("markers", self.markers);
  }
};

struct ImageMarker {
  static constexpr const char* kType = "visualization_msgs/ImageMarker";
  Header header = {};
  std::string ns = {};
  std::int32_t id = 0;
  std::int32_t type = 0;
  std::int32_t action = 0;
  Point position = {};
  float scale = 0;  ///< pixels
  ColorRGBA outline_color = {};
  std::uint8_t filled = 0;
  ColorRGBA fill_color = {};
  Duration lifetime = {};
  std::vector<Point> points = {};
  std::vector<ColorRGBA> outline_colors = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("ns", self.ns);
    archive("id", self.id);
    archive("type", self.type);
    archive("action", self.action);
    archive("position", self.position);
    archive("scale", self.scale);
    archive("outline_color", self.outline_color);
    archive("filled", self.filled);
    archive("fill_color", self.fill_color);
    archive("lifetime", self.lifetime);
    archive("points", self.points);
    archive("outline_colors", self.outline_colors);
  }
};

struct Log {
  static constexpr const char* kType = "rcl_interfaces/Log";
  Time stamp = {};
  std::uint8_t level = 0;
  std::string name = {};
  std::string msg = {};
  std::string file = {};
  std::string function = {};
  std::uint32_t line = 0;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("stamp", self.stamp);
    archive("level", self.level);
    archive("name", self.name);
    archive("msg", self.msg);
    archive("file", self.file);
    archive("function", self.function);
    archive("line", self.line);
  }
};

// Constants of the above.
inline constexpr std::int32_t kCube = 1, kText = 9;                    ///< Marker.type
inline constexpr std::int32_t kAdd = 0, kDeleteAll = 3;                ///< Marker.action
inline constexpr std::int32_t kLineList = 2;                           ///< ImageMarker.type
inline constexpr std::uint8_t kInfo = 20, kWarning = 30, kError = 40;  ///< Log.level

}  // namespace aisle::ros
