#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/bag/bag_recording.h"
#include "harness/bag/bag_trajectory.h"
#include "harness/bag/drive_bag.h"
#include "harness/bag/frame_messages.h"
#include "harness/bag/grey_image.h"
#include "harness/bag/picture_size.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::int64_t kStart = 1'600'000'000'000'000'000, kFrameNs = 50'000'000;
const StereoCalibration kRig{.width = 32,
                             .height = 24,
                             .fx = 435.2,
                             .fy = 435.2,
                             .cx = 15.5,
                             .cy = 11.5,
                             .baseline_m = 0.12};

cv::Mat1b Picture(int seed) {
  cv::Mat1b image(kRig.height, kRig.width);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

/// A bag as a robot's recorder makes it, each part of it open to mistakes.
struct RobotBag {
  std::string left = "/front/left/image_rect", right = "/front/right/image_rect";
  ros::CameraInfo left_info = CameraInfoMessage({}, kRig, 0),
                  right_info = CameraInfoMessage({}, kRig, 1);
  bool infos = true;
  std::int64_t right_late_ns = 0;
  int frames = 6;
  int right_frames = 6;  ///< the right camera's end here

  void Write(const fs::path& file) const {
    McapWriter writer(file);
    const auto pictures = [&](const std::string& topic) {
      return writer.AddChannel<ros::Image>(topic);
    };
    const auto l = pictures(left), r = pictures(right);
    for (int k = 0; k < frames; ++k) {
      const std::int64_t stamp_ns = kStart + k * kFrameNs;
      ros::Header header;
      header.frame_id = "left_optical";
      header.stamp = ros::TimeOf(stamp_ns);
      // Recorded the other way round and late: neither may matter.
      ros::Header late = header;
      late.frame_id = "right_optical";
      late.stamp = ros::TimeOf(stamp_ns + right_late_ns);
      if (k < right_frames) {
        writer.Write(r, stamp_ns + 7'000'000, ImageMessage(late, Picture(2 * k + 1)));
      }
      writer.Write(l, stamp_ns + 9'000'000, ImageMessage(header, Picture(2 * k)));
      if (!infos) continue;
      const auto info = [&](const std::string& image, ros::CameraInfo message,
                            const std::string& frame) {
        message.header.frame_id = frame;
        writer.Write(writer.AddChannel<ros::CameraInfo>(CameraInfoOf(image)), stamp_ns, message);
      };
      info(left, left_info, "left_optical");
      info(right, right_info, "right_optical");
    }
    ros::TFMessage rig;
    rig.transforms.resize(2);
    rig.transforms[0].header.frame_id = rig.transforms[1].header.frame_id = "base_link";
    rig.transforms[0].child_frame_id = "left_optical";
    rig.transforms[1].child_frame_id = "right_optical";
    rig.transforms[1].transform.translation.x = 0.25;
    writer.Write(writer.AddChannel<ros::TFMessage>("/tf_static"), kStart, rig);
    writer.Finish();
  }
  static std::string CameraInfoOf(const std::string& image) {
    return image.substr(0, image.rfind('/')) + "/camera_info";
  }
};

class RecordingTest : public testing::Test {
 protected:
  RecordingTest() : folder_(fs::temp_directory_path() / fmt::format("aisle_bag_{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~RecordingTest() override { fs::remove_all(folder_); }

  StereoRecording Read(const RobotBag& bag, const BagRecordingOptions& options = {}) const {
    bag.Write(folder_ / "drive.mcap");
    return ReadBagRecording(folder_ / "drive.mcap", options);
  }
  std::string WhyNot(const RobotBag& bag, const BagRecordingOptions& options = {}) const {
    try {
      Read(bag, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_;
};

TEST_F(RecordingTest, PairsComeByHeaderStampWithTheirPixels) {
  const StereoRecording recording = Read({});
  ASSERT_EQ(recording.pairs.size(), 6u);
  for (int k = 0; k < 6; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_EQ(recording.pairs[i].stamp_ns, kStart + k * kFrameNs);
    EXPECT_EQ(cv::norm(recording.read_image(i, 0), Picture(2 * k), cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(recording.read_image(i, 1), Picture(2 * k + 1), cv::NORM_INF), 0);
  }
  EXPECT_EQ(recording.cameras.left.fx, kRig.fx);
  EXPECT_EQ(recording.cameras.right.T_body_camera.translation().x(), kRig.baseline_m)
      << "to the bit";
  EXPECT_FALSE(recording.cameras.stated);
}

TEST_F(RecordingTest, OnRectifiedTopicsTheProjectionAloneCounts) {
  RobotBag bag;
  bag.left_info.k = bag.right_info.k = {500, 0, 1, 0, 500, 2, 0, 0, 1};
  bag.left_info.d = bag.right_info.d = {-0.3, 0.1, 0, 0, 0};
  const StereoRecording recording = Read(bag);
  EXPECT_EQ(recording.cameras.left.fx, kRig.fx);
  EXPECT_TRUE(recording.cameras.left.distortion.empty());
}

TEST_F(RecordingTest, RawTopicsAreRectifiedAsTheyState) {
  RobotBag bag;
  bag.left = "/front/left/image_raw";
  bag.right = "/front/right/image_raw";
  bag.left_info.d = bag.right_info.d = {-0.3, 0.1, 0, 0, 0};
  const StereoRecording recording = Read(bag);
  ASSERT_TRUE(recording.cameras.stated);
  EXPECT_EQ(recording.cameras.left.distortion.size(), 5u);
  EXPECT_EQ((*recording.cameras.stated)[0].projection(0, 0), kRig.fx);
}

TEST_F(RecordingTest, LettersOfAnotherWordDoNotSayRectified) {
  for (const std::string eyes : {"/direct/", "/unrectified/", "/correct/"}) {
    RobotBag bag;
    bag.left = eyes + "left/image";
    bag.right = eyes + "right/image";
    bag.left_info.d = bag.right_info.d = {-0.3, 0.1, 0, 0, 0};
    EXPECT_TRUE(Read(bag).cameras.stated) << eyes;
  }
  for (const std::string name : {"image_rect", "image_rect_color", "image_rectified"}) {
    RobotBag bag;
    bag.left = "/left/" + name;
    bag.right = "/right/" + name;
    bag.left_info.d = bag.right_info.d = {-0.3, 0.1, 0, 0, 0};
    EXPECT_FALSE(Read(bag).cameras.stated) << name;
  }
}

TEST_F(RecordingTest, WhatARecorderCouldNotFinishIsNoted) {
  EXPECT_TRUE(Read({}).notes.empty());
  RobotBag().Write(folder_ / "whole.mcap");
  const std::string whole = ReadFile(folder_ / "whole.mcap");
  StereoRecording cut;
  for (std::size_t size = whole.size(); size > 0 && cut.notes.empty(); size -= 16) {
    WriteFileAtomically(folder_ / "cut.mcap", whole.substr(0, size));
    cut = ReadBagRecording(folder_ / "cut.mcap", {});
  }
  ASSERT_EQ(cut.notes.size(), 1u);
  EXPECT_THAT(cut.notes.front(), HasSubstr("ends in the middle of a record"));
}

TEST_F(RecordingTest, AMissingBaselineIsNamedWithItsCure) {
  RobotBag bag;
  bag.right_info.p[3] = 0;
  EXPECT_THAT(WhyNot(bag), testing::AllOf(HasSubstr("states no baseline"), HasSubstr("0.25 m"),
                                          HasSubstr("--baseline")));
  const StereoRecording cured = Read(bag, {.baseline_m = 0.25});
  EXPECT_EQ(cured.cameras.right.T_body_camera.translation().x(), 0.25);
}

TEST_F(RecordingTest, AWrongSignAndSwappedEyesAreNamed) {
  RobotBag bag;
  bag.right_info.p[3] = -bag.right_info.p[3];
  EXPECT_THAT(WhyNot(bag), HasSubstr("a baseline of -0.12 m"));
  RobotBag swapped;
  std::swap(swapped.left_info, swapped.right_info);
  EXPECT_THAT(WhyNot(swapped), HasSubstr("--topic /front/right/image_rect --topic /front/left"));
}

TEST_F(RecordingTest, LeftImagesWithoutARightOneAreTold) {
  EXPECT_THAT(Read({}).notes, testing::IsEmpty());
  RobotBag bag;
  bag.right_frames = 4;
  const StereoRecording recording = Read(bag);
  EXPECT_EQ(recording.pairs.size(), 4u);
  EXPECT_THAT(recording.notes, testing::ElementsAre(HasSubstr("skipped 2 of 6 left images")));
  bag.right_frames = 2;
  EXPECT_THAT(WhyNot(bag), HasSubstr("only 2 of 6 left images have a right one"));
}

TEST_F(RecordingTest, WhatElseIsMissingIsNamed) {
  RobotBag blind;
  blind.infos = false;
  EXPECT_THAT(WhyNot(blind), HasSubstr("no /front/left/camera_info"));
  RobotBag late;
  late.right_late_ns = 5'000'000;
  EXPECT_THAT(WhyNot(late), HasSubstr("median distance 5.000 ms"));
  RobotBag nearly;
  nearly.right_late_ns = 900'000;
  EXPECT_EQ(Read(nearly).pairs.size(), 6u);
  RobotBag odd;
  odd.left = "/a/image_rect";
  EXPECT_THAT(WhyNot(odd), HasSubstr("--topic LEFT"));
  EXPECT_EQ(Read(odd, {.topics = {odd.left, odd.right}}).pairs.size(), 6u);
  EXPECT_THAT(WhyNot({}, {.topics = {"/front/left/image_rec"}}), HasSubstr("image_rect"));
  RobotBag uncalibrated;
  uncalibrated.left_info.p = {};
  EXPECT_THAT(WhyNot(uncalibrated), HasSubstr("not calibrated"));
}

TEST_F(RecordingTest, NumbersThatNoRectifiedCameraHasAreNamed) {
  for (const double wrong : {std::nan(""), HUGE_VAL, 1e300}) {
    for (const std::size_t place : {0, 2, 5, 6}) {  // fx, cx, fy, cy
      RobotBag bag;
      bag.right_info.p[place] = wrong;
      EXPECT_THAT(WhyNot(bag),
                  testing::AllOf(HasSubstr("/front/right/camera_info states"),
                                 HasSubstr(fmt::format("{:g}", wrong)), HasSubstr("--calibration")))
          << place;
    }
  }
  RobotBag bag;
  bag.right_info.p[3] = std::nan("");
  EXPECT_THAT(WhyNot(bag), HasSubstr("p[3] as nan"));
}

TEST_F(RecordingTest, NumbersThatNoRawCameraHasAreNamed) {
  RobotBag good;
  good.left = "/front/left/image_raw";
  good.right = "/front/right/image_raw";
  good.left_info.d = good.right_info.d = {-0.3, 0.1, 0, 0, 0};
  EXPECT_EQ(WhyNot(good), "");
  const auto why_not = [&](const auto& spoil) {
    RobotBag bag = good;
    spoil(&bag.left_info);
    return WhyNot(bag);
  };
  for (const double wrong : {std::nan(""), HUGE_VAL, 1e300}) {
    const auto named = [&](const std::string& field) {
      return testing::AllOf(HasSubstr("/front/left/camera_info states"), HasSubstr(field),
                            HasSubstr("--calibration"));
    };
    EXPECT_THAT(why_not([&](auto* info) { info->d[1] = wrong; }), named("d[1]"));
    EXPECT_THAT(why_not([&](auto* info) { info->k[0] = wrong; }), named("k[0]"));
    EXPECT_THAT(why_not([&](auto* info) { info->k[2] = wrong; }), named("k[2]"));
    EXPECT_THAT(why_not([&](auto* info) { info->r[4] = wrong; }), named("not a rotation"));
    EXPECT_THAT(why_not([&](auto* info) { info->p[6] = wrong; }), named("p[6]"));
  }
  const auto is_no_rotation = HasSubstr("r that is not a rotation");
  EXPECT_THAT(why_not([](auto* info) { info->r = {}; }), is_no_rotation);
  EXPECT_THAT(why_not([](auto* info) { info->r[8] = -1; }), is_no_rotation) << "a reflection";
  EXPECT_THAT(why_not([](auto* info) { info->r[1] = 0.01; }), is_no_rotation);
  EXPECT_EQ(why_not([](auto* info) { info->r[1] = 1e-4; }), "") << "rounded when written";
  EXPECT_THAT(why_not([](auto* info) { info->k[4] = 0; }), HasSubstr("focal lengths"));
  EXPECT_THAT(why_not([](auto* info) { info->p[10] = 0; }), HasSubstr("0 0 1"));
}

/// RegionOfInterest.msg: the whole picture is said by zeros, or by its own size.
TEST_F(RecordingTest, OnlyAPartOfThePictureIsCutOut) {
  const auto with = [](const ros::RegionOfInterest& roi) {
    RobotBag bag;
    bag.left_info.roi = bag.right_info.roi = roi;
    return bag;
  };
  const auto width = static_cast<std::uint32_t>(kRig.width),
             height = static_cast<std::uint32_t>(kRig.height);
  EXPECT_EQ(Read(with({.height = height, .width = width})).pairs.size(), 6u);
  EXPECT_EQ(Read(with({.height = height, .width = width})).cameras.left.cx, kRig.cx);
  for (const ros::RegionOfInterest& part :
       {ros::RegionOfInterest{.height = height, .width = width - 1},
        ros::RegionOfInterest{.height = height - 1, .width = width},
        ros::RegionOfInterest{.x_offset = 1, .height = height, .width = width},
        ros::RegionOfInterest{.y_offset = 1, .height = height, .width = width}}) {
    EXPECT_THAT(WhyNot(with(part)), HasSubstr("cropped"));
  }
}

TEST(GreyImage, EncodingsMeanWhatRosSays) {
  // One colour everywhere: every mosaic of it must come out as that colour's grey.
  const cv::Vec3b bgr(40, 90, 200);
  cv::Mat3b colour(16, 16, bgr);
  cv::Mat1b expected(1, 1);
  cv::cvtColor(cv::Mat3b(1, 1, bgr), expected, cv::COLOR_BGR2GRAY);
  const int grey = expected(0, 0);
  const auto middle = [](const cv::Mat1b& image) { return static_cast<int>(image(8, 8)); };
  ros::Image message = ImageMessage({}, colour);
  EXPECT_EQ(middle(GreyImage(message)), grey);
  message.encoding = "rgb8";
  EXPECT_NE(middle(GreyImage(message)), grey);
  for (const std::string pattern : {"rggb", "bggr", "gbrg", "grbg"}) {
    cv::Mat1b mosaic(16, 16);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const char c = pattern[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
        mosaic(y, x) = bgr[c == 'b' ? 0 : c == 'g' ? 1 : 2];
      }
    }
    ros::Image bayer = ImageMessage({}, mosaic);
    bayer.encoding = "bayer_" + pattern + "8";
    EXPECT_NEAR(middle(GreyImage(bayer)), grey, 1) << pattern;
  }
  cv::Mat1w deep(4, 4, std::uint16_t{0x1234});
  ros::Image wide = ImageMessage({}, deep);
  EXPECT_EQ(GreyImage(wide)(2, 2), 0x12);
  wide.is_bigendian = 1;
  EXPECT_EQ(GreyImage(wide)(2, 2), 0x34);
  wide.encoding = "polarized8";
  EXPECT_THROW(GreyImage(wide), ros::CdrError);
}

TEST(GreyImage, RowsMayHaveGapsAndMustBeThere) {
  const cv::Mat1b image = Picture(3);
  ros::Image message = ImageMessage({}, image);
  message.step += 5;
  std::vector<std::uint8_t> spaced;
  for (int y = 0; y < image.rows; ++y) {
    spaced.insert(spaced.end(), image.ptr(y), image.ptr(y) + image.cols);
    spaced.insert(spaced.end(), 5, 77);
  }
  message.data = spaced;
  EXPECT_EQ(cv::norm(GreyImage(message), image, cv::NORM_INF), 0);
  message.data.resize(spaced.size() - 6);
  EXPECT_THROW(GreyImage(message), ros::CdrError);
}

TEST(GreyImage, RowsBeginWithAWholeValue) {
  ros::Image wide = ImageMessage({}, cv::Mat1w(4, 4, std::uint16_t{0x1234}));
  wide.data.resize(200);
  for (const std::uint8_t is_bigendian : {std::uint8_t{0}, std::uint8_t{1}}) {
    wide.is_bigendian = is_bigendian;
    wide.step = 10;
    EXPECT_NO_THROW(GreyImage(wide));
    wide.step = 9;
    EXPECT_THROW(GreyImage(wide), ros::CdrError) << "within a value";
    wide.step = 7;
    EXPECT_THROW(GreyImage(wide), ros::CdrError) << "shorter than a row";
  }
  ros::Image colour = ImageMessage({}, cv::Mat3b(4, 4, cv::Vec3b(1, 2, 3)));
  colour.step += 1;
  colour.data.resize(200);
  EXPECT_NO_THROW(GreyImage(colour)) << "a value is a byte here";
}

/// Pixels that share their colour in pairs, in rows of an odd length; a mosaic of one pixel.
TEST(GreyImage, WhatOpenCvRefusesIsTheMessagesFault) {
  for (const char* encoding : {"yuv422", "yuyv", "bayer_rggb8"}) {
    for (const std::uint32_t side : {1u, 3u}) {
      ros::Image message;
      message.encoding = encoding;
      message.width = message.height = side;
      message.step = 2 * side;
      message.data.resize(std::size_t{2} * side * side);
      try {
        GreyImage(message);
      } catch (const ros::CdrError&) {
      } catch (const std::exception& error) {
        ADD_FAILURE() << encoding << ": " << error.what();
      }
    }
  }
}

TEST(GreyImage, CompressedImagesAreRead) {
  const cv::Mat1b image = Picture(4);
  ros::CompressedImage message;
  message.format = "mono8; png compressed ";
  cv::imencode(".png", image, message.data);
  EXPECT_EQ(cv::norm(GreyImage(message), image, cv::NORM_INF), 0);
  message.data.resize(20);
  EXPECT_THROW(GreyImage(message), ros::CdrError);
}

std::string WhyNotGrey(const std::vector<std::uint8_t>& bytes) {
  ros::CompressedImage message;
  message.format = "png";
  message.data = bytes;
  try {
    GreyImage(message);
  } catch (const ros::CdrError& error) {
    return error.what();
  }
  return "";
}

TEST(GreyImage, CompressedImagesOfOtherKindsAreRefused) {
  const auto why_not = [](const char* ending) {
    std::vector<std::uint8_t> bytes;
    EXPECT_TRUE(cv::imencode(ending, Picture(4), bytes)) << ending;
    return WhyNotGrey(bytes);
  };
  for (const char* read : {".png", ".jpg"}) EXPECT_EQ(why_not(read), "") << read;
  for (const char* other : {".pgm", ".bmp"}) {
    EXPECT_THAT(why_not(other), HasSubstr("PNG and JPEG are supported")) << other;
  }
}

TEST(GreyImage, ACompressedImageIsNotDecodedBeforeItsSizeIsKnown) {
  std::vector<std::uint8_t> png, jpeg;
  cv::imencode(".png", Picture(4), png);
  cv::imencode(".jpg", Picture(4), jpeg);
  png[18] = png[22] = 64;  // 16416 x 16408, of IHDR
  EXPECT_THAT(WhyNotGrey(png), HasSubstr("states 16416x16408 pixels"));
  png[18] = png[22] = 36;  // each side would do
  EXPECT_THAT(WhyNotGrey(png), HasSubstr("states 9248x9240 pixels"));
  const std::array<std::uint8_t, 2> frame = {0xFF, 0xC0};
  const auto found = std::ranges::search(jpeg, frame).begin();
  ASSERT_NE(found, jpeg.end());
  found[5] = found[7] = 64;
  EXPECT_THAT(WhyNotGrey(jpeg), HasSubstr("states 16416x16408 pixels"));
}

TEST(SizeOfPictureTest, IsTheDecodersAtEveryCut) {
  for (const char* ending : {".png", ".jpg"}) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(ending, Picture(4), bytes);
    if (bytes[0] == 0xFF) bytes.insert(bytes.begin() + 2, {0xFF, 0xFF, 0x01, 0xFF});  // B.1.1.2
    for (std::size_t length = 0; length <= bytes.size(); ++length) {
      const PictureSize size = SizeOfPicture(std::span(bytes).first(length));
      if (size.width == 0 && length < bytes.size()) continue;
      EXPECT_EQ(size.width, 32u) << ending << length;
      EXPECT_EQ(size.height, 24u) << ending << length;
    }
    EXPECT_EQ(WhyNotGrey(bytes), "") << ending;
  }
}

TEST_F(RecordingTest, TrajectoriesOfEveryTypeComeOut) {
  const fs::path file = folder_ / "poses.mcap";
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 1, 2, 3;
  pose.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  {
    McapWriter writer(file);
    ros::Header header;
    header.stamp = ros::TimeOf(kStart);
    ros::Odometry odometry;
    odometry.header = header;
    odometry.pose.pose = ros::PoseOf(pose);
    writer.Write(writer.AddChannel<ros::Odometry>("/odom"), kStart, odometry);
    ros::PoseStamped stamped;
    stamped.header = header;
    stamped.pose = ros::PoseOf(pose);
    writer.Write(writer.AddChannel<ros::PoseStamped>("/pose"), kStart, stamped);
    ros::Path path;
    path.poses = {stamped};
    writer.Write(writer.AddChannel<ros::Path>("/path"), kStart, path);
    ros::TFMessage tf;
    tf.transforms.resize(2);
    tf.transforms[0].header = header;
    tf.transforms[0].child_frame_id = "base_link";
    tf.transforms[0].transform = ros::TransformOf(pose);
    writer.Write(writer.AddChannel<ros::TFMessage>("/tf"), kStart, tf);
    writer.Finish();
  }
  for (const char* topic : {"/odom", "/pose", "/path", "/tf#base_link"}) {
    const auto asked = BagTopicFromText(file.string() + ":" + topic);
    ASSERT_TRUE(asked) << topic;
    const Trajectory trajectory = ReadBagTrajectory(*asked);
    ASSERT_EQ(trajectory.size(), 1u) << topic;
    EXPECT_EQ(trajectory[0].stamp_ns, kStart);
    EXPECT_TRUE(trajectory[0].T_world_rig.isApprox(pose, 1e-12)) << topic;
  }
  EXPECT_FALSE(BagTopicFromText("truth.txt"));
  EXPECT_THROW(ReadBagTrajectory(*BagTopicFromText(file.string())), InputError) << "several";
  EXPECT_THROW(ReadBagTrajectory(*BagTopicFromText(file.string() + ":/tf")), InputError);
  EXPECT_THROW(ReadBagTrajectory(*BagTopicFromText(file.string() + ":/tf#rig")), InputError);
  EXPECT_THROW(ReadBagTrajectory(*BagTopicFromText(file.string() + ":/odo")), InputError);
}

/// Five poses, as every type that holds some has them.
void WritePoses(const fs::path& file, std::int64_t first_ns, std::int64_t step_ns) {
  McapWriter writer(file);
  ros::Path path;
  for (int k = 0; k < 5; ++k) {
    ros::PoseStamped pose;
    pose.header.stamp = ros::TimeOf(first_ns + k * step_ns);
    writer.Write(writer.AddChannel<ros::PoseStamped>("/pose"), kStart + k, pose);
    path.poses.push_back(pose);
    ros::TFMessage tf;
    tf.transforms.resize(1);
    tf.transforms[0].header = pose.header;
    tf.transforms[0].child_frame_id = "base_link";
    writer.Write(writer.AddChannel<ros::TFMessage>("/tf"), kStart + k, tf);
  }
  writer.Write(writer.AddChannel<ros::Path>("/path"), kStart, path);
  writer.Write(writer.AddChannel<ros::Path>("/path"), kStart + 1, path);  // the last one counts
  writer.Finish();
}

TEST_F(RecordingTest, PosesWithoutStampsAreNoTrajectory) {
  const fs::path file = folder_ / "poses.mcap";
  for (const char* topic : {"/pose", "/path", "/tf#base_link"}) {
    const auto asked = BagTopicFromText(file.string() + ":" + topic);
    WritePoses(file, 0, 0);
    try {
      ReadBagTrajectory(*asked);
      ADD_FAILURE() << topic;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("the 5 poses of"));
      EXPECT_THAT(error.what(), HasSubstr("no timestamps"));
    }
    WritePoses(file, 0, 1);
    EXPECT_EQ(ReadBagTrajectory(*asked).size(), 5u) << topic << ": who begins at 0 has stamps";
    WritePoses(file, kStart, 0);
    EXPECT_EQ(ReadBagTrajectory(*asked).size(), 1u) << topic << ": the later recorded stays";
  }
}

TEST(RequireOwnTopicsTest, SystemsShareNoTopicsWithEachOtherNorWithTruth) {
  const auto why_not = [](const std::vector<std::string>& systems) -> std::string {
    try {
      RequireOwnTopics(systems);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why_not({"plain", "robust", "plain", "my-slam", "my-slam-2"}), "") << "seeds repeat";
  EXPECT_THAT(why_not({"a-b", "robust", "a_b"}),
              testing::AllOf(HasSubstr("'a-b'"), HasSubstr("'a_b'"), HasSubstr("/a_b/")));
  EXPECT_THAT(why_not({"2.0", "s_2-0"}), HasSubstr("share"));
  for (const char* ours : {"truth", "left", "right"}) {
    EXPECT_THAT(why_not({"plain", ours}), HasSubstr(fmt::format("'{}'", ours)));
  }
}

TEST_F(RecordingTest, ADriveBagIsARecording) {
  const fs::path file = folder_ / "own.mcap";
  {
    DriveBag bag(file, kRig, {});
    for (int k = 0; k < 3; ++k) {
      SequenceFrame frame;
      frame.images = {k, k * kFrameNs, Picture(2 * k), Picture(2 * k + 1)};
      frame.truth.emplace();
      frame.truth->T_world_rig.translation().x() = k;
      bag.AddFrame(frame);
    }
    bag.Finish();
  }
  const StereoRecording recording = ReadBagRecording(file, {});
  ASSERT_EQ(recording.pairs.size(), 3u);
  ASSERT_EQ(recording.truth.size(), 3u);
  EXPECT_EQ(recording.truth[2].T_world_rig.translation().x(), 2);
  EXPECT_EQ(recording.truth[2].stamp_ns, recording.pairs[2].stamp_ns);
  EXPECT_EQ(cv::norm(recording.read_image(2, 1), Picture(5), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace aisle
