#include "harness/campaign/stream_system.h"

#include <gtest/gtest.h>

#include "harness/contract/system_fault.h"
#include "harness/io/file.h"
#include "harness/io/shell_word.h"
#include "harness/io/stream_protocol.h"
#include "harness/run/showing.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

const StereoCalibration kRig{
    .width = 320, .height = 200, .fx = 180, .fy = 180, .cx = 160, .cy = 100, .baseline_m = 0.1};

class StreamSystemTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_stream_{}", ::getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { RemoveFolder(folder_); }

  static ExternalSystem Client(const std::string& words) {
    ExternalSystem system;
    system.dataset = system.trajectory = "stream";
    system.command =
        fmt::format("exec python3 {}/tests/support/stream/{}", AISLE_SOURCE_DIR, words);
    return system;
  }

  /// What wheels say from frame to frame: an arc.
  static MotionMeasurement Motion() {
    MotionMeasurement motion;
    motion.T_now_before.linear() =
        Eigen::AngleAxisd(0.04, Eigen::Vector3d::UnitY()).toRotationMatrix();
    motion.T_now_before.translation() << 0.01, 0, -0.07;
    motion.covariance *= 1e-4;
    return motion;
  }

  /// Shows ten frames to a system, as a drive does.
  RunResult Show(const ExternalSystem& system, double answer_s = 20, bool with_wheels = false) {
    try {
      StreamEstimator estimator(system, kRig,
                                {.folder = folder_, .hidden = {}, .answer_s = answer_s});
      version_ = estimator.version();
      const MaskMaker masks = MasksFromTruth(MaskSource::kNone);
      const FrameObserver observer;
      Showing showing(kRig, 20, estimator, masks, observer);
      for (std::int64_t id = 0; id < 10 && !showing.offended(); ++id) {
        SequenceFrame frame;
        frame.images = {id, id * 50'000'000, cv::Mat1b(200, 320, std::uint8_t{7}),
                        cv::Mat1b(200, 320, std::uint8_t{9})};
        if (with_wheels && id > 0) frame.images.motion = Motion();
        showing.Show({id, frame.images.stamp_ns}, frame, 0, static_cast<std::size_t>(id), 10);
      }
      return showing.Finish(10, 0.5);
    } catch (const SystemFault& fault) {
      RunResult result;
      result.status = fault.status;
      result.status_why = fault.what();
      return result;
    }
  }

  fs::path folder_;
  std::string version_;
};

TEST_F(StreamSystemTest, AGoodClientAnswersEveryFrame) {
  const RunResult run = Show(Client("client.py"));
  EXPECT_EQ(run.status, RunStatus::kOk) << run.status_why;
  EXPECT_EQ(run.trajectory.live.size(), 10u);
  EXPECT_EQ(run.trajectory.final.size(), 10u);
  EXPECT_EQ(run.trajectory.final[3].stamp_ns, 150'000'000);
  EXPECT_EQ(version_, "stands still");
}

/// The client in C++ where `prints` stands where somebody's SLAM goes.
ExternalSystem BuiltClient(const fs::path& folder, const std::string& prints) {
  std::string source = ReadFile(fs::path(AISLE_SOURCE_DIR) / "tests/support/stream/client.cpp");
  const std::size_t slam = source.find("    const double pose");
  source.insert(slam, prints + "\n");
  WriteFileAtomically(folder / "client.cpp", source);
  const std::string program = (folder / "client").string();
  const std::string build = fmt::format("g++ -std=c++17 -O1 {0}.cpp -o {0}", ShellWord(program));
  EXPECT_EQ(std::system(build.c_str()), 0);
  ExternalSystem system;
  system.dataset = system.trajectory = "stream";
  system.command = "exec " + program;
  return system;
}

TEST_F(StreamSystemTest, TheClientInCppDoesTooThoughItsSlamPrints) {
  const RunResult run = Show(BuiltClient(folder_, "std::printf(\"tracked\\n\");"));
  EXPECT_EQ(run.status, RunStatus::kOk) << run.status_why;
  EXPECT_EQ(run.trajectory.final.size(), 10u);
  EXPECT_NE(ReadFile(folder_ / "system.log").find("tracked"), std::string::npos);
}

/// A motion is not answered, and who begins with one of the clients may ask for it.
TEST_F(StreamSystemTest, ClientsThatDoNotKnowWheelsPassThemOver) {
  for (const ExternalSystem& client : {Client("client.py"), BuiltClient(folder_, "")}) {
    const RunResult run = Show(client, 20, true);
    EXPECT_EQ(run.status, RunStatus::kOk) << client.command << ": " << run.status_why;
    EXPECT_EQ(run.trajectory.final.size(), 10u);
  }
}

TEST_F(StreamSystemTest, WhoAsksForWheelsIsToldTheirMotionBeforeEachFrame) {
  const RunResult run = Show(Client("wheels.py"), 20, true);
  EXPECT_EQ(run.status, RunStatus::kOk) << run.status_why;
  ASSERT_EQ(run.trajectory.final.size(), 10u);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (const StampedPose& answered : run.trajectory.final) {
    EXPECT_TRUE(answered.T_world_rig.isApprox(pose, 1e-9)) << answered.stamp_ns;
    pose = pose * Motion().T_now_before.inverse();
  }
}

struct Way {
  const char* name;
  RunStatus status;
  const char* says;
};
class HostileStreamTest : public StreamSystemTest, public testing::WithParamInterface<Way> {};
INSTANTIATE_TEST_SUITE_P(
    Ways, HostileStreamTest,
    testing::Values(Way{"die", RunStatus::kCrashed, "SIGSEGV"},
                    Way{"exit", RunStatus::kCrashed, "no more memory for dreams"},
                    Way{"leave", RunStatus::kCrashed, "ended before it answered: exit code 0"},
                    Way{"word", RunStatus::kInvalid,
                        "it ended after the text 'hi\\x0a': stdout belongs"},
                    Way{"stall", RunStatus::kTimeout, "no answer within"},
                    Way{"mute", RunStatus::kTimeout, "no answer within"},
                    Way{"dribble", RunStatus::kTimeout, "no answer within"},
                    Way{"twice", RunStatus::kInvalid, ""},
                    Way{"ahead", RunStatus::kInvalid, "before the first frame"},
                    Way{"text", RunStatus::kInvalid, "print to stderr"},
                    Way{"nan", RunStatus::kInvalid, "not finite"},
                    Way{"far", RunStatus::kInvalid, "at most 1e+08"},
                    Way{"shear", RunStatus::kInvalid, "quaternion"},
                    Way{"huge", RunStatus::kInvalid, "bytes; at most"},
                    Way{"gigabytes", RunStatus::kInvalid, "a message of type"},
                    Way{"wrong", RunStatus::kInvalid, "got that to frame 10"},
                    Way{"type", RunStatus::kInvalid, "type 77"},
                    Way{"short", RunStatus::kInvalid, "ends too early"},
                    Way{"abort", RunStatus::kCrashed, "at the end: signal 6, SIGABRT"},
                    Way{"code", RunStatus::kCrashed, "exit code 1; last words: ERROR: LeakSan"},
                    Way{"linger", RunStatus::kTimeout, "did not exit within 2 s"},
                    Way{"wait", RunStatus::kOk, ""},
                    Way{"version", RunStatus::kInvalid, "version 9"},
                    Way{"flood", RunStatus::kOk, ""}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_F(StreamSystemTest, WhatASystemPrintedBeforeItsGreetingFailedIsKept) {
  ExternalSystem system = Client("");
  system.command = "echo no such camera >&2; exit 3";
  EXPECT_EQ(Show(system).status, RunStatus::kCrashed);
  EXPECT_NE(ReadFile(folder_ / "system.log").find("no such camera"), std::string::npos);
}

TEST_P(HostileStreamTest, EndsInAVerdictOfItsOwn) {
  const Way& way = GetParam();
  const bool hangs = way.status == RunStatus::kTimeout;
  const RunResult run = Show(Client(fmt::format("hostile.py {}", way.name)), hangs ? 2 : 60);
  EXPECT_EQ(run.status, way.status) << run.status_why;
  EXPECT_NE(run.status_why.find(way.says), std::string::npos) << run.status_why;
}

TEST(StreamProtocolTest, WhatIsWrittenIsReadBack) {
  const StreamHello hello = ReadHello(FormatHello({.calibration = kRig, .rate_hz = 20}));
  EXPECT_EQ(hello.calibration.width, kRig.width);
  EXPECT_EQ(hello.calibration.baseline_m, kRig.baseline_m);
  StereoFrame frame{5, 250, cv::Mat1b(200, 320), cv::Mat1b(200, 320)};
  cv::randu(frame.left, 0, 255);
  cv::randu(frame.right, 0, 255);
  const StereoFrame read = ReadFrame(FormatFrame(frame), kRig);
  EXPECT_EQ(read.id, 5);
  EXPECT_EQ(cv::norm(read.left, frame.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(read.right, frame.right, cv::NORM_INF), 0);
  MotionMeasurement motion;
  motion.T_now_before.translation() << 0.1, 0.2, 0.3;
  motion.covariance(1, 2) = motion.covariance(2, 1) = 0.25;
  std::int64_t moved_to = 0;
  const MotionMeasurement told = ReadMotion(FormatMotion(7, motion), &moved_to);
  EXPECT_EQ(moved_to, 7);
  EXPECT_TRUE(told.T_now_before.isApprox(motion.T_now_before, 1e-12));
  EXPECT_EQ(told.covariance, motion.covariance);
  motion.covariance(0, 0) = -1;
  EXPECT_THROW(ReadMotion(FormatMotion(7, motion), &moved_to), StreamError);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.translation() << 1, -2, 3;
  const auto answered = ReadAnswer({StreamType::kPose, FormatAnswer(5, pose)}, 5);
  ASSERT_TRUE(answered.pose);
  EXPECT_TRUE(answered.pose->isApprox(pose, 1e-12));
  EXPECT_EQ(answered.map_id, 0);
  EXPECT_FALSE(ReadAnswer({StreamType::kLost, FormatAnswer(5, {})}, 5).pose);
  const auto moved = ReadAnswer({StreamType::kPose, FormatAnswer(5, pose, 2)}, 5);
  EXPECT_TRUE(moved.pose->isApprox(pose, 1e-12));
  EXPECT_EQ(moved.map_id, 2);
  const auto lost = ReadAnswer({StreamType::kLost, FormatAnswer(5, {}, 2)}, 5);
  EXPECT_FALSE(lost.pose);
  EXPECT_EQ(lost.map_id, 2);
  EXPECT_THROW(ReadAnswer({StreamType::kPose, FormatAnswer(5, pose, 2) + "x"}, 5), StreamError);
  const Trajectory track = ReadTrack(FormatTrack({{50, pose}, {100, pose}}));
  ASSERT_EQ(track.size(), 2u);
  EXPECT_TRUE(track[1].T_world_rig.isApprox(pose, 1e-12));
}

}  // namespace
}  // namespace aisle
