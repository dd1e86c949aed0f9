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
              HasSubstr("t.txt:2: stamp 1 is earlier than the line before (2)"));
  EXPECT_THAT(Complaint("soon 0 0 0 0 0 0 1\n", tum), HasSubstr("'soon' is not a time"));
  EXPECT_THAT(Complaint("# only comments\n", tum), HasSubstr("holds no poses"));
  EXPECT_THAT(Complaint("1.5,0,0,0,1,0,0,0\n", TrajectoryFormat::kEuroc),
              HasSubstr("not a stamp in whole nanoseconds"));
  EXPECT_THAT(Complaint("2 0 0 0 0 2 0 0 0 0 2 0\n", TrajectoryFormat::kKitti),
              HasSubstr("is no rotation"));
  EXPECT_THROW(ReadTrajectory(folder_ / "absent.txt", tum), InputError);
  EXPECT_THROW(ReadTrajectory(folder_, tum), InputError);
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
