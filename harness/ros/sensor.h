#pragma once

#include "harness/ros/geometry.h"

namespace aisle::ros {

// What cameras say. As in geometry.h: one list of fields per message.

struct Image {
  static constexpr const char* kType = "sensor_msgs/Image";
  Header header = {};
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string encoding = {};
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;  ///< bytes from row to row
  std::vector<std::uint8_t> data = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("height", self.height);
    archive("width", self.width);
    archive("encoding", self.encoding);
    archive("is_bigendian", self.is_bigendian);
    archive("step", self.step);
    archive("data", self.data);
  }
};

struct CompressedImage {
  static constexpr const char* kType = "sensor_msgs/CompressedImage";
  Header header = {};
  std::string format = {};
  std::vector<std::uint8_t> data = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("format", self.format);
    archive("data", self.data);
  }
};

struct RegionOfInterest {
  static constexpr const char* kType = "sensor_msgs/RegionOfInterest";
  std::uint32_t x_offset = 0;
  std::uint32_t y_offset = 0;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  bool do_rectify = false;
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("x_offset", self.x_offset);
    archive("y_offset", self.y_offset);
    archive("height", self.height);
    archive("width", self.width);
    archive("do_rectify", self.do_rectify);
  }
};

/// Of a rectified image, `p` alone speaks: its fourth column is -fx times the baseline in the right
/// one.
struct CameraInfo {
  static constexpr const char* kType = "sensor_msgs/CameraInfo";
  Header header = {};
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string distortion_model = {};
  std::vector<double> d = {};
  std::array<double, 9> k = {};   ///< row major, pixels
  std::array<double, 9> r = {};   ///< camera as built to rectified
  std::array<double, 12> p = {};  ///< row major, of the rectified camera
  std::uint32_t binning_x = 0;
  std::uint32_t binning_y = 0;
  RegionOfInterest roi = {};
  template <class Archive, class Self>
  static void Fields(Archive& archive, Self& self) {
    archive("header", self.header);
    archive("height", self.height);
    archive("width", self.width);
    archive("distortion_model", self.distortion_model);
    archive("d", self.d);
    archive("k", self.k);
    archive("r", self.r);
    archive("p", self.p);
    archive("binning_x", self.binning_x);
    archive("binning_y", self.binning_y);
    archive("roi", self.roi);
  }
};

}  // namespace aisle::ros
