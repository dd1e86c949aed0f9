#include "harness/io/trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/file.h"
#include "harness/io/frame_store.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class IoTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_io_{}", ::getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
    return folder_ / name;
  }
  std::string Complaint(const std::string& text, TrajectoryFormat format) const {
    try {
      ReadTrajectory(Write("t.txt", text), format);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }

  fs::path folder_;
};

Trajectory Example() {
  Trajectory trajectory;
  for (int i = 0; i < 5; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 0.1 * i, -1.0 / 3, 1e-7 * i;
    pose.linear() =
        Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    trajectory.push_back({1403715529112143517 + i * 50'000'000LL, pose});
  }
  return trajectory;
}

TEST_F(IoTest, EveryFormatReadsBackWhatWasWritten) {
  const Trajectory written = Example();
  for (const auto format :
       {TrajectoryFormat::kTum, TrajectoryFormat::kKitti, TrajectoryFormat::kEuroc}) {
    const fs::path path = Write("t.txt", FormatTrajectory(written, format));
    EXPECT_EQ(GuessTrajectoryFormat(path), format);
    const Trajectory read = ReadTrajectory(path, format);
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_TRUE(read[i].T_world_rig.isApprox(written[i].T_world_rig, 1e-14));
      if (format != TrajectoryFormat::kKitti) {
        EXPECT_EQ(read[i].stamp_ns, written[i].stamp_ns);
      }
    }
  }
}

TEST_F(IoTest, LinesAreExactlyAsOtherReadersWantThem) {
  const Trajectory one = {Example().front()};
  EXPECT_EQ(FormatTrajectory(one, TrajectoryFormat::kTum),
            "# timestamp tx ty tz qx qy qz qw\n"
            "1403715529.112143517 0 -0.3333333333333333 0 0 0 0 1\n");
  EXPECT_EQ(FormatTrajectory(one, TrajectoryFormat::kKitti),
            "1 0 0 0 0 1 0 -0.3333333333333333 0 0 1 0\n");
  EXPECT_THAT(
      FormatTrajectory(one, TrajectoryFormat::kEuroc),
      HasSubstr("\n1403715529112143517,0,-0.3333333333333333,0,1,0,0,0,0,0,0,0,0,0,0,0,0\n"));
}

TEST(DecimalTest, StampsKeepTheirNanoseconds) {
  const std::pair<const char*, std::int64_t> good[] = {
      {"1403715529.112143517", 1403715529112143517},
      {"1.403715529112143517e+09", 1403715529112143517},
      {"0", 0},
      {"5e-10", 1},
      {"4.9e-10", 0},
      {"-1.5", -1'500'000'000},
      {"0.0000000001", 0},
      {".5", 500'000'000},
      {"+2.", 2'000'000'000}};
  for (const auto& [text, expected] : good) {
    std::int64_t stamp = -1;
    EXPECT_TRUE(ParseSecondsToNs(text, &stamp)) << text;
    EXPECT_EQ(stamp, expected) << text;
  }
  for (const char* bad : {"", "nan", "1e999", "1.2.3", "0x10", "1e", "99999999999999999999", "-"}) {
    std::int64_t stamp = 0;
    EXPECT_FALSE(ParseSecondsToNs(bad, &stamp)) << bad;
  }
  EXPECT_EQ(FormatSeconds(-1'500'000'000), "-1.500000000");
  EXPECT_EQ(FormatSeconds(1403715529112143517), "1403715529.112143517");
}

TEST_F(IoTest, BadLinesAreNamedWithTheirPlace) {
  const auto tum = TrajectoryFormat::kTum;
  EXPECT_THAT(Complaint("# x\n1 0 0 0 0 0 0\n", tum),
              HasSubstr("t.txt:2: 7 fields; a TUM line has 8"));
  EXPECT_THAT(Complaint("1 0 0 nan 0 0 0 1\n", tum), HasSubstr("t.txt:1: field 4 is nan"));
  EXPECT_THAT(Complaint("1 0 0 x 0 0 0 1\n", tum), HasSubstr("field 4 is 'x', not a number"));
  EXPECT_THAT(Complaint("1 0 0 0 0 0 0 0\n", tum), HasSubstr("quaternion has norm 0"));
  EXPECT_THAT(Complaint("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", tum),
              HasSubstr("t.txt:2: stamp 1 is earlier than on the previous line (2)"));
  EXPECT_THAT(Complaint("soon 0 0 0 0 0 0 1\n", tum), HasSubstr("'soon' is not a time"));
  EXPECT_THAT(Complaint("# only comments\n", tum), HasSubstr("no poses in this file"));
  EXPECT_THAT(Complaint("1.5,0,0,0,1,0,0,0\n", TrajectoryFormat::kEuroc),
              HasSubstr("expected a timestamp in integer nanoseconds"));
  EXPECT_THAT(Complaint("2 0 0 0 0 2 0 0 0 0 2 0\n", TrajectoryFormat::kKitti),
              HasSubstr("is not a rotation"));
  EXPECT_THROW(ReadTrajectory(folder_ / "absent.txt", tum), InputError);
  EXPECT_THROW(ReadTrajectory(folder_, tum), InputError);
}

TEST_F(IoTest, KittiRowsMayBeginWithTheNumberOfTheirFrame) {
  const std::string rows = "0 1 0 0 1 0 1 0 0 0 0 1 0\n7 1 0 0 2 0 1 0 0 0 0 1 0\n";
  const fs::path file = Write("k.txt", rows), times = Write("times.txt", "0\n1\n");
  ASSERT_EQ(GuessTrajectoryFormat(file), TrajectoryFormat::kKitti);
  const Trajectory read = ReadTrajectory(file, TrajectoryFormat::kKitti);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].stamp_ns, 7 * kKittiStepNs);
  EXPECT_EQ(read[1].T_world_rig.translation(), Eigen::Vector3d(2, 0, 0));
  EXPECT_THAT(Complaint("x 1 0 0 1 0 1 0 0 0 0 1 0\n", TrajectoryFormat::kKitti),
              HasSubstr("t.txt:1: 'x' before the 12 numbers of the pose is not a frame number"));
  EXPECT_THROW(ReadTrajectory(file, TrajectoryFormat::kKitti, times), InputError);
  // As many columns with a stamp before them are EuRoC's.
  EXPECT_EQ(GuessTrajectoryFormat(Write("e.txt", "1403636580838555648 0 0 0 1 0 0 0 0 0 0 0 0\n")),
            TrajectoryFormat::kEuroc);
}

TEST_F(IoTest, PositionsBeyondTheEarthAreNoMetres) {
  EXPECT_THAT(Complaint("0 0 1e300 0 0 0 0 1\n", TrajectoryFormat::kTum),
              HasSubstr("t.txt:1: field 3 is 1e300: positions must be in metres"));
  EXPECT_THAT(Complaint("1 0 0 1e9 0 1 0 0 0 0 1 0\n", TrajectoryFormat::kKitti),
              HasSubstr("t.txt:1: field 4 is 1e9: positions must be in metres"));
}

TEST_F(IoTest, ATimeThatStandsStillIsNone) {
  std::string rows;
  for (int i = 0; i < 30'000; ++i) rows += "5 0 0 0 0 0 0 1\n";
  EXPECT_THAT(Complaint(rows, TrajectoryFormat::kTum),
              HasSubstr("t.txt:1001: stamp 5 is the same as in the previous 1000 rows"));
}

TEST_F(IoTest, RowsOfAnyOrderAreSortedWhereThatIsAsked) {
  const fs::path file = Write("t.txt", "2 2 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  EXPECT_THROW(ReadTrajectory(file, TrajectoryFormat::kTum), InputError);
  const Trajectory sorted = ReadTrajectory(file, TrajectoryFormat::kTum, {}, RowOrder::kAny);
  EXPECT_EQ(sorted.front().T_world_rig.translation().x(), 1);
  EXPECT_EQ(sorted.back().stamp_ns, 2'000'000'000);
}

TEST_F(IoTest, NanosecondsAsRealNumbersAreNoSeconds) {
  const fs::path orb = Write("orb.txt", "1403636579763555584.000000 1 2 3 0 0 0 1\n");
  ASSERT_EQ(GuessTrajectoryFormat(orb), TrajectoryFormat::kTum);
  EXPECT_EQ(ReadTrajectory(orb, TrajectoryFormat::kTum).front().stamp_ns, 1403636579763555584);
  const fs::path late = Write("late.txt", "99999999999999999999.0 1 2 3 0 0 0 1\n");
  EXPECT_THROW(ReadTrajectory(late, TrajectoryFormat::kTum), InputError);
}

/// An estimate whose stamps stayed EuRoC's has its columns in TUM's order all the same.
TEST_F(IoTest, WholeNanosecondsMayStandInTumsColumns) {
  const fs::path file = Write("ns.txt", "1403636579763555584 1 2 3 0.6 0 0 0.8\n");
  const StampedPose pose = ReadTrajectory(file, TrajectoryFormat::kTum).front();
  EXPECT_EQ(pose.stamp_ns, 1403636579763555584);
  EXPECT_TRUE(Eigen::Quaterniond(pose.T_world_rig.linear())
                  .isApprox(Eigen::Quaterniond(0.8, 0.6, 0, 0), 1e-12));
  EXPECT_EQ(ReadTrajectory(file, TrajectoryFormat::kEuroc).front().stamp_ns, pose.stamp_ns);
}

TEST_F(IoTest, WhereQwStandsIsToldByTheTitlesOrNotAtAll) {
  const std::string row = "1403636579763555584 1 2 3 0.6 0 0 0.8\n";
  const auto tell = [&](const std::string& titles) {
    return TellTrajectoryFormat(Write("t.txt", titles + row));
  };
  EXPECT_EQ(tell(""), std::nullopt);
  EXPECT_EQ(tell("# what 4 runs of quick SLAM said\n"), std::nullopt);
  EXPECT_EQ(tell("# timestamp tx ty tz qx qy qz qw\n"), TrajectoryFormat::kTum);
  EXPECT_EQ(tell("#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], "
                 "q_RS_y [], q_RS_z []\n"),
            TrajectoryFormat::kEuroc);
  EXPECT_EQ(TellTrajectoryFormat(Write("s.txt", "1403636579.7 1 2 3 0.6 0 0 0.8\n")),
            TrajectoryFormat::kTum)
      << "seconds are TUM's";
  try {
    GuessTrajectoryFormat(Write("t.txt", row));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("qw may be the first number of the quaternion"));
  }
}

/// A turn of a quarter about z, once with qw first and once with qw last.
constexpr const char *kQwFirst = " 1 2 3 0.8 0 0 0.6\n", *kQwLast = " 1 2 3 0 0 0.6 0.8\n";

TEST_F(IoTest, TitlesDecideWhateverTheStampsAre) {
  const std::string first = "# timestamp tx ty tz qw qx qy qz\n";
  const std::string last = "# timestamp tx ty tz qx qy qz qw\n# of night 3, in metres\n";
  const auto rows = [](const std::string& a, const std::string& b, const char* pose) {
    return a + pose + b + pose;
  };
  const auto read = [](const fs::path& file) {
    return ReadTrajectory(file, GuessTrajectoryFormat(file));
  };
  const Eigen::Quaterniond turned(0.8, 0, 0, 0.6);
  // Each with its stamps from a clock that began at 0, and with those of a date.
  for (const auto& [a, b] :
       {std::pair("0", "50000000"), std::pair("1403636579763555584", "1403636579813555584")}) {
    for (const std::string& text : {first + rows(a, b, kQwFirst), last + rows(a, b, kQwLast)}) {
      const Trajectory poses = read(Write("t.txt", text));
      EXPECT_TRUE(Eigen::Quaterniond(poses[1].T_world_rig.linear()).isApprox(turned, 1e-12))
          << text;
      EXPECT_EQ(poses[1].stamp_ns - poses[0].stamp_ns, 50'000'000) << text;
    }
  }
  // Seconds with qw first are of no format.
  for (const auto& [a, b] : {std::pair("0.5", "0.55"), std::pair("1", "2")}) {
    try {
      GuessTrajectoryFormat(Write("t.txt", first + rows(a, b, kQwFirst)));
      ADD_FAILURE() << a;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("its titles put qw first"));
    }
  }
}

TEST_F(IoTest, WholeStepsOfElevenDaysAreNanoseconds) {
  const auto tell = [&](const std::string& a, const std::string& b) {
    return TellTrajectoryFormat(Write("t.txt", a + kQwFirst + b + kQwFirst));
  };
  EXPECT_EQ(tell("0", "50000000"), std::nullopt) << "a clock that began at 0";
  EXPECT_EQ(tell("0", "1403636579763555584"), std::nullopt);
  EXPECT_EQ(tell("1600000000", "1600000001"), TrajectoryFormat::kTum);
  EXPECT_EQ(tell("0", "0"), TrajectoryFormat::kTum);
  const fs::path orb = Write("orb.txt", "0.000000 1 2 3 0 0 0 1\n50000000.000000 1 2 3 0 0 0 1\n");
  EXPECT_EQ(ReadTrajectory(orb, TrajectoryFormat::kTum)[1].stamp_ns, 50'000'000);
  const Trajectory long_apart = {{0, Eigen::Isometry3d::Identity()},
                                 {2'000'000'000'000'000, Eigen::Isometry3d::Identity()}};
  const fs::path ours = Write("t.txt", FormatTrajectory(long_apart, TrajectoryFormat::kTum));
  EXPECT_EQ(ReadTrajectory(ours, TrajectoryFormat::kTum)[1].stamp_ns, long_apart[1].stamp_ns);
}

TEST_F(IoTest, TitlesOfColumnsAreToldFromPoses) {
  EXPECT_THAT(Complaint("t,x,y,z,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n", TrajectoryFormat::kTum),
              HasSubstr("column titles must begin with '#'"));
}

TEST_F(IoTest, TheBenchmarksLayoutHasTimesOfItsPoses) {
  const fs::path times = Write("data/sequences/07/times.txt", "0\n");
  EXPECT_EQ(KittiTimesBeside(folder_ / "data/poses/07.txt"), times);
  EXPECT_EQ(KittiTimesBeside(folder_ / "data/poses/08.txt"), fs::path());
}

TEST_F(IoTest, CarriageReturnsAndByteOrderMarksDoNoHarm) {
  const fs::path path = Write("t.txt", "\xEF\xBB\xBF# a\r\n1 0 0 0 0 0 0 1\r\n");
  EXPECT_EQ(ReadTrajectory(path, TrajectoryFormat::kTum).size(), 1u);
}

TEST_F(IoTest, WritingLeavesNothingAside) {
  Write("deep/er/file.txt", "old");
  Write("deep/er/file.txt", "new");
  EXPECT_EQ(ReadFile(folder_ / "deep/er/file.txt"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "deep/er"), {}), 1);
}

TEST_F(IoTest, APictureThatIsNoneIsRefused) {
  EXPECT_THROW(ReadGreyPng(Write("a.png", "hello")), InputError);
  std::string huge("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\1\0\0\0\1\0\0", 24);
  huge.resize(40);
  try {
    ReadGreyPng(Write("b.png", huge));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("65536x65536 pixels; at most 16384"));
  }
  cv::Mat1b image(4, 6, static_cast<unsigned char>(7));
  WriteImage(folder_ / "c.png", image);
  EXPECT_EQ(cv::norm(ReadGreyPng(folder_ / "c.png"), image), 0);
}

TEST_F(IoTest, PicturesInColourAndOfSixteenBitsAreReadAsGrey) {
  const cv::Mat3b red(4, 6, cv::Vec3b(0, 0, 200));
  WriteImage(folder_ / "red.png", red);
  EXPECT_EQ(cv::norm(ReadGreyPng(folder_ / "red.png"), cv::Mat1b(4, 6, 60), cv::NORM_INF), 0)
      << "0.299 of it";
  const cv::Mat1w deep(4, 6, static_cast<unsigned short>(0x12ff));
  WriteImage(folder_ / "deep.png", deep);
  EXPECT_EQ(cv::norm(ReadGreyPng(folder_ / "deep.png"), cv::Mat1b(4, 6, 0x12), cv::NORM_INF), 0);
}

TEST_F(IoTest, NamesThatNoPictureIsWrittenToAreKnownBefore) {
  EXPECT_NO_THROW(CheckImageName("a.png"));
  EXPECT_NO_THROW(CheckImageName("a.jpg"));
  for (const char* name : {"a.gif", "a.svg", "a"}) {
    EXPECT_THROW(CheckImageName(name), InputError) << name;
    EXPECT_THROW(WriteImage(folder_ / name, cv::Mat1b(4, 6, 60)), MachineError) << name;
  }
}

SequenceFrame StoredExample() {
  SequenceFrame frame;
  frame.images = {3, 150'000'000, cv::Mat1b(5, 7), cv::Mat1b(5, 7)};
  cv::randu(frame.images.left, 0, 256);
  cv::randu(frame.images.right, 0, 256);
  frame.truth.emplace();
  frame.truth->T_world_rig.translation() << 1, 2, 3;
  frame.truth->instance = cv::Mat1w(5, 7, static_cast<unsigned short>(9));
  frame.truth->dynamic = cv::Mat1b(5, 7, static_cast<unsigned char>(0));
  frame.truth->dynamic(cv::Rect(2, 1, 3, 2)) = 255;
  frame.truth->objects.resize(1);
  frame.truth->objects[0].object_class = "person";
  frame.truth->objects[0].velocity_mps << 0.5, 0, 0;
  return frame;
}

/// A PNG of 4x3 pixels with a palette of black, dark red and dark green, as DAVIS stores masks:
/// rows 0 0 1 0, 0 2 2 0, 0 0 0 0.
constexpr std::string_view kPaletteMask =
    "89504e470d0a1a0a0000000d4948445200000004000000030803000000832a5ef400000009504c54"
    "45000000800000008000a6506553000000134944415478da63606060646060606262000300003900"
    "06c7e8bbae0000000049454e44ae426082";

TEST_F(IoTest, MasksMayHaveAPaletteColoursOrSixteenBits) {
  std::string bytes;
  for (std::size_t i = 0; i < kPaletteMask.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(kPaletteMask.substr(i, 2)), nullptr, 16));
  }
  const cv::Mat1b mask = ReadMaskPng(Write("palette.png", bytes));
  ASSERT_EQ(mask.size(), cv::Size(4, 3));
  EXPECT_EQ(cv::countNonZero(mask), 3);
  EXPECT_EQ(mask(0, 2), 255);
  EXPECT_EQ(mask(1, 1), 255);
  cv::Mat1w labels(3, 4, static_cast<unsigned short>(0));
  labels(2, 3) = 256;  // whose lower byte is 0
  WriteImage(folder_ / "labels.png", labels);
  EXPECT_EQ(ReadMaskPng(folder_ / "labels.png")(2, 3), 255);
  WriteImage(folder_ / "clear.png", cv::Mat4b(3, 4, cv::Vec4b(0, 0, 0, 255)));
  EXPECT_EQ(cv::countNonZero(ReadMaskPng(folder_ / "clear.png")), 0);
}

TEST_F(IoTest, AStoredFrameComesBackToTheBit) {
  const FrameStore store(folder_ / "s");
  EXPECT_FALSE(store.Read(3));
  const SequenceFrame written = StoredExample();
  store.Write(written);
  const auto read = store.Read(3);
  ASSERT_TRUE(read);
  EXPECT_EQ(cv::norm(read->images.left, written.images.left), 0);
  EXPECT_EQ(cv::norm(read->images.right, written.images.right), 0);
  EXPECT_EQ(cv::norm(read->truth->instance, written.truth->instance), 0);
  EXPECT_EQ(cv::norm(read->truth->dynamic, written.truth->dynamic), 0);
  EXPECT_TRUE(read->truth->actor.empty());
  EXPECT_EQ(read->truth->objects.at(0).object_class, "person");
  EXPECT_EQ(read->truth->objects.at(0).velocity_mps, Eigen::Vector3d(0.5, 0, 0));
}

TEST_F(IoTest, ADamagedStoredFrameIsAbsent) {
  const FrameStore store(folder_ / "s");
  store.Write(StoredExample());
  const fs::path file = folder_ / "s" / "000003.frame";
  std::string bytes = ReadFile(file);
  bytes[60] = static_cast<char>(bytes[60] ^ 1);
  WriteFileAtomically(file, bytes);
  EXPECT_FALSE(store.Read(3));
  WriteFileAtomically(file, bytes.substr(0, 10));
  EXPECT_FALSE(store.Read(3));
}

TEST_F(IoTest, TheStoreShrinksByTheLeastRecentlyUsed) {
  for (const char* name : {"old", "new"}) {
    FrameStore(folder_ / "root" / name).Write(StoredExample());
  }
  fs::last_write_time(folder_ / "root/old",
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  const auto size = fs::file_size(folder_ / "root/new/000003.frame");
  ShrinkStore(folder_ / "root", size + 1);
  EXPECT_FALSE(fs::exists(folder_ / "root/old"));
  EXPECT_TRUE(fs::exists(folder_ / "root/new"));
}

}  // namespace
}  // namespace aisle
