#include "harness/ros/cdr.h"

#include <gtest/gtest.h>

#include "harness/ros/definition.h"
#include "harness/ros/drawing.h"
#include "harness/ros/geometry.h"

#ifdef AISLE_FASTCDR
#include <fastcdr/Cdr.h>
#endif

namespace aisle::ros {
namespace {

PoseStamped OfTheNote() {
  PoseStamped message;
  message.header.stamp = TimeOf(1'500'000'000);
  message.header.frame_id = "odom";
  message.pose.position = {.x = 1, .y = 2, .z = 3};
  return message;
}

std::string Hex(const std::string& bytes) {
  std::string hex;
  for (const char c : bytes) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return hex;
}

TEST(Cdr, APoseIsTheBytesThatOthersWrite) {
  // Known from bags of rosbag2: stamp 1.5 s, frame "odom", position 1 2 3, no turn.
  const std::string expected =
      "00010000010000000065cd1d050000006f646f6d0000000000000000"
      "000000000000f03f00000000000000400000000000000840"
      "000000000000000000000000000000000000000000000000000000000000f03f";
  EXPECT_EQ(Hex(Serialize(OfTheNote())), expected);
}

TEST(Cdr, ACameraInfoHasTheLengthThatOthersWrite) {
  CameraInfo info;
  info.header.frame_id = "camera_left_optical_frame";
  info.distortion_model = "plumb_bob";
  info.d.resize(5);
  EXPECT_EQ(Serialize(info).size(), 381u);
}

TEST(Cdr, EverythingReadsBackAsItWas) {
  Marker marker;
  marker.header.frame_id = "map";
  marker.ns = "x";
  marker.points = {{.x = 1, .y = 2, .z = 3}, {.x = 4, .y = 5, .z = 6}};
  marker.colors = {{.r = 0.5f, .g = 0.25f, .b = 1, .a = 0}};
  marker.frame_locked = true;
  marker.text = "person";
  marker.mesh_file.data = {1, 2, 3};
  marker.uv_coordinates = {{.u = 0.5f, .v = 0.75f}};
  MarkerArray array;
  array.markers = {marker, Marker{}};
  const std::string bytes = Serialize(array);
  EXPECT_EQ(Serialize(Deserialize<MarkerArray>(bytes)), bytes);
  EXPECT_TRUE(Deserialize<MarkerArray>(bytes).markers[0].frame_locked);
}

TEST(Cdr, BigEndianIsReadToo) {
  const std::string bytes("\0\0\0\0\0\0\0\x05\x0b\xeb\xc2\0", 12);
  const Time time = Deserialize<Time>(bytes);
  EXPECT_EQ(time.sec, 5);
  EXPECT_EQ(time.nanosec, 200'000'000u);
}

TEST(Cdr, WhatIsNoMessageIsRefused) {
  const std::string good = Serialize(OfTheNote());
  EXPECT_THROW(Deserialize<PoseStamped>(good.substr(0, good.size() - 1)), CdrError);
  EXPECT_THROW(Deserialize<PoseStamped>(good + "1234"), CdrError);
  EXPECT_NO_THROW(Deserialize<PoseStamped>(good + std::string(3, '\0')));
  std::string parameter_list = good;
  parameter_list[1] = 3;
  EXPECT_THROW(Deserialize<PoseStamped>(parameter_list), CdrError);
  std::string endless = good;  // a frame name as long as memory
  std::memset(endless.data() + 12, 0xff, 4);
  EXPECT_THROW(Deserialize<PoseStamped>(endless), CdrError);
}

TEST(Cdr, StampsSurviveTheirSplit) {
  for (const std::int64_t stamp_ns : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1},
                                      std::int64_t{1'600'000'000'050'000'001}}) {
    EXPECT_EQ(NanosecondsOf(TimeOf(stamp_ns)), stamp_ns);
  }
}

TEST(Definition, NamesEachTypeItUsesOnce) {
  const std::string separator(80, '=');
  EXPECT_EQ(
      DefinitionOf<PoseStamped>(),
      "std_msgs/Header header\ngeometry_msgs/Pose pose\n" + separator +
          "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + separator +
          "\nMSG: geometry_msgs/Pose\ngeometry_msgs/Point position\n"
          "geometry_msgs/Quaternion orientation\n" +
          separator + "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + separator +
          "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" + separator +
          "\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n");
  EXPECT_EQ(FullTypeName("sensor_msgs/Image"), "sensor_msgs/msg/Image");
  EXPECT_NE(DefinitionOf<CameraInfo>().find("float64[12] p\n"), std::string::npos);
  EXPECT_NE(DefinitionOf<Image>().find("uint8[] data\n"), std::string::npos);
}

#ifdef AISLE_FASTCDR
/// eProsima's decoder: what rmw_fastrtps reads messages with.
TEST(Cdr, FastCdrReadsWhatIsWritten) {
  CameraInfo info;
  info.header.stamp = TimeOf(1'600'000'000'050'000'000);
  info.header.frame_id = "camera_left_optical_frame";
  info.height = 480;
  info.width = 752;
  info.distortion_model = "plumb_bob";
  info.d = {0.1, 0.2, 0.3, 0.4, 0.5};
  for (std::size_t i = 0; i < info.k.size(); ++i) info.k[i] = static_cast<double>(i);
  for (std::size_t i = 0; i < info.p.size(); ++i) info.p[i] = 100 + static_cast<double>(i);
  info.binning_x = 7;
  info.roi.do_rectify = true;
  std::string bytes = Serialize(info);
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                             eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.read_encapsulation();
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0, height = 0, width = 0, binning_x = 0, binning_y = 0;
  std::string frame, model;
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::array<std::uint32_t, 4> roi{};
  bool do_rectify = false;
  cdr >> sec >> nanosec >> frame >> height >> width >> model >> d >> k >> r >> p >> binning_x >>
      binning_y >> roi[0] >> roi[1] >> roi[2] >> roi[3] >> do_rectify;
  EXPECT_EQ(sec, 1'600'000'000);
  EXPECT_EQ(nanosec, 50'000'000u);
  EXPECT_EQ(frame, info.header.frame_id);
  EXPECT_EQ(height, 480u);
  EXPECT_EQ(width, 752u);
  EXPECT_EQ(model, "plumb_bob");
  EXPECT_EQ(d, info.d);
  EXPECT_EQ(k, info.k);
  EXPECT_EQ(p, info.p);
  EXPECT_EQ(binning_x, 7u);
  EXPECT_TRUE(do_rectify);
  EXPECT_EQ(cdr.getSerializedDataLength(), bytes.size());
}
#else
TEST(Cdr, FastCdrReadsWhatIsWritten) { GTEST_SKIP() << "libfastcdr-dev is not installed"; }
#endif

}  // namespace
}  // namespace aisle::ros
