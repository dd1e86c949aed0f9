// Whatever is written is read back as it was: properties, tried on values of every kind.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "harness/io/dataset.h"
#include "harness/io/features_csv.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/mask_folder.h"
#include "harness/io/stream_protocol.h"
#include "harness/io/system_spec_json.h"
#include "harness/io/trajectory.h"
#include "harness/io/vslam_lab.h"
#include "tests/support/arbitrary.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class RoundTripTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }
  fs::path Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text, Durability::kSurvivesProcessLoss);
    return folder_ / name;
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_round_{}", ::getpid());
};

Trajectory AnyTrajectory() {
  Trajectory trajectory;
  std::int64_t stamp_ns = *rc::gen::inRange<std::int64_t>(0, 2'000'000'000'000'000'000);
  for (int left = AnyOf(1, 20); left > 0; --left) {
    trajectory.push_back({stamp_ns, AnyPose()});
    stamp_ns += *rc::gen::inRange<std::int64_t>(1, 10'000'000'000);
  }
  return trajectory;
}

TEST_F(RoundTripTest, TrajectoriesOfEveryFormat) {
  EXPECT_TRUE(rc::check([this] {
    const Trajectory written = AnyTrajectory();
    for (const auto format :
         {TrajectoryFormat::kTum, TrajectoryFormat::kKitti, TrajectoryFormat::kEuroc}) {
      const fs::path path = Write("t.txt", FormatTrajectory(written, format));
      RC_ASSERT(GuessTrajectoryFormat(path) == format);
      const Trajectory read = ReadTrajectory(path, format);
      RC_ASSERT(read.size() == written.size());
      for (std::size_t i = 0; i < read.size(); ++i) {
        const Eigen::Isometry3d &a = written[i].T_world_rig, &b = read[i].T_world_rig;
        RC_ASSERT(a.translation() == b.translation());
        if (format == TrajectoryFormat::kKitti) {
          RC_ASSERT(a.linear() == b.linear());
        } else {
          RC_ASSERT(read[i].stamp_ns == written[i].stamp_ns);
          RC_ASSERT(a.linear().isApprox(b.linear(), 1e-14));
        }
      }
    }
  }));
}

TEST_F(RoundTripTest, StampsInSeconds) {
  EXPECT_TRUE(rc::check([] {
    const auto stamp_ns = AnyWhole<std::int64_t>() % 9'000'000'000'000'000'000;  // what is read
    std::int64_t read = 0;
    RC_ASSERT(ParseSecondsToNs(FormatSeconds(stamp_ns), &read));
    RC_ASSERT(read == stamp_ns);
  }));
}

/// Nanoseconds since 1970 as somebody's program may write them, every digit of them: 0 whole, 1
/// with a point, 2 as NumPy does when it is not told how.
std::string StampText(std::int64_t stamp_ns, int way) {
  std::string text = std::to_string(stamp_ns);
  if (way == 1) text += ".000000";
  if (way == 2) text = fmt::format("{}.{}e+18", text.substr(0, 1), text.substr(1));
  return text;
}

TEST_F(RoundTripTest, TheRowsOfAVslamLabSystemInAnyOrder) {
  EXPECT_TRUE(rc::check([this] {
    Trajectory written = AnyTrajectory();
    for (StampedPose& pose : written) pose.stamp_ns += 1'000'000'000'000'000'000;
    const int way = AnyOf(0, 3);
    std::vector<std::string> rows;
    for (const StampedPose& pose : written) {
      const Eigen::Vector3d p = pose.T_world_rig.translation();
      const Eigen::Quaterniond q(pose.T_world_rig.linear());
      rows.push_back(fmt::format("{},{},{},{},{},{},{},{}\n", StampText(pose.stamp_ns, way), p.x(),
                                 p.y(), p.z(), q.x(), q.y(), q.z(), q.w()));
    }
    for (std::size_t i = rows.size() - 1; i > 0; --i) {
      std::swap(rows[i], rows[static_cast<std::size_t>(AnyOf(0, static_cast<int>(i) + 1))]);
    }
    const Trajectory read = ReadVslamLabTrajectory(Write(
        kVslamLabTrajectory, "ts,tx,ty,tz,qx,qy,qz,qw\n" + fmt::format("{}", fmt::join(rows, ""))));
    RC_ASSERT(read.size() == written.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      RC_ASSERT(read[i].stamp_ns == written[i].stamp_ns);
      RC_ASSERT(read[i].T_world_rig.translation() == written[i].T_world_rig.translation());
    }
  }));
}

StereoCalibration AnyCalibration() {
  return {.width = AnyOf(64, 4097),
          .height = AnyOf(64, 4097),
          .fx = AnyNumberIn(20, 10000),
          .fy = AnyNumberIn(20, 10000),
          .cx = AnyNumberIn(1, 4096),
          .cy = AnyNumberIn(1, 4096),
          .baseline_m = AnyNumberIn(0.005, 5)};
}

TEST_F(RoundTripTest, TheCalibrationOfADataset) {
  EXPECT_TRUE(rc::check([this] {
    StereoCalibration rig = AnyCalibration();
    rig.width = rig.height = 64;  // of the images that go along
    SequenceFrame frame;
    frame.truth.emplace();
    frame.images.left = frame.images.right = cv::Mat1b(64, 64, static_cast<unsigned char>(7));
    for (const auto format : {DatasetFormat::kEuroc, DatasetFormat::kKitti}) {
      fs::remove_all(folder_);
      const DatasetWriter made(folder_, rig, 20, {{0, 0, Eigen::Isometry3d::Identity()}},
                               {.format = format, .true_trajectory = false});
      DatasetWriter writer = made;
      writer.Begin();
      writer.Add(frame);
      writer.Finish([](std::int64_t) { return Eigen::Isometry3d::Identity(); });
      const auto [left, right, stated] = ReadRecording(folder_, format).cameras;
      for (const CameraCalibration& camera : {left, right}) {
        RC_ASSERT(camera.fx == rig.fx && camera.fy == rig.fy);
        RC_ASSERT(camera.cx == rig.cx && camera.cy == rig.cy);
        RC_ASSERT(camera.distortion.empty() || camera.distortion == std::vector<double>(4, 0));
      }
      const Eigen::Vector3d right_in_left =
          (left.T_body_camera.inverse() * right.T_body_camera).translation();
      RC_ASSERT(std::abs(right_in_left.x() - rig.baseline_m) <= 1e-12 * rig.baseline_m);
    }
  }));
}

cv::Mat1b AnyMask(int width, int height) {
  cv::Mat1b mask(height, width);
  cv::RNG random(AnyWhole<std::uint64_t>());
  random.fill(mask, cv::RNG::UNIFORM, 0, 2);
  mask *= 255;
  return mask;
}

bool Equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && (a.empty() || cv::norm(a, b) == 0);
}

TEST_F(RoundTripTest, MasksOfEverySize) {
  EXPECT_TRUE(rc::check([this] {
    const int width = AnyOf(1, 70), height = AnyOf(1, 70);
    StereoFrame frame;
    frame.id = AnyOf(0, 1'000'000);
    frame.left = frame.right = cv::Mat1b(height, width, static_cast<unsigned char>(0));
    const cv::Mat1b left = AnyMask(width, height), right = AnyMask(width, height);
    fs::remove_all(folder_);
    const std::string name = fmt::format("{:06}.png", frame.id);
    WriteImage(folder_ / "left" / name, left);
    WriteImage(folder_ / "right" / name, right);
    RC_ASSERT(Equal(ReadGreyPng(folder_ / "left" / name), left));
    RC_ASSERT(Equal(ReadMaskPng(folder_ / "left" / name), left));
    const ExternalMask found = MaskFolder(folder_).Find(frame);
    RC_ASSERT(Equal(found.left, left) && Equal(found.right, right));
  }));
}

TEST_F(RoundTripTest, WhatAForeignSystemTellsOfItsFeatures) {
  EXPECT_TRUE(rc::check([this] {
    std::map<std::int64_t, FrameFeatures> written;
    std::string text = "frame,u,v,used\n";
    for (int left = AnyOf(0, 20); left > 0; --left) {
      const int frame = AnyOf(0, 5);
      const cv::Point2f at(static_cast<float>(AnyNumberIn(0, 752)),
                           static_cast<float>(AnyNumberIn(0, 480)));
      const bool used = AnyFlag();
      written[frame].points.push_back(at);
      written[frame].used.push_back(used);
      text += fmt::format("{},{},{},{}\n", frame, at.x, at.y, used ? 1 : 0);
    }
    const auto read = ReadFeatures(Write("features.csv", text));
    RC_ASSERT(read.size() == written.size());
    for (const auto& [frame, features] : written) {
      RC_ASSERT(read.at(frame).points == features.points);
      RC_ASSERT(read.at(frame).used == features.used);
    }
  }));
}

TEST_F(RoundTripTest, WhatGoesOverTheStream) {
  EXPECT_TRUE(rc::check([] {
    const StreamHello hello{.calibration = AnyCalibration(), .rate_hz = AnyNumberIn(0.1, 1000)};
    const StreamHello heard = ReadHello(FormatHello(hello));
    RC_ASSERT(heard.calibration.width == hello.calibration.width);
    RC_ASSERT(heard.calibration.fy == hello.calibration.fy);
    RC_ASSERT(heard.calibration.baseline_m == hello.calibration.baseline_m);
    RC_ASSERT(heard.rate_hz == hello.rate_hz);

    StereoCalibration small = hello.calibration;
    small.width = AnyOf(1, 50);
    small.height = AnyOf(1, 50);
    const StereoFrame frame{.id = AnyWhole<std::int64_t>(),
                            .stamp_ns = AnyWhole<std::int64_t>(),
                            .left = AnyMask(small.width, small.height),
                            .right = AnyMask(small.width, small.height)};
    const StereoFrame seen = ReadFrame(FormatFrame(frame), small);
    RC_ASSERT(seen.id == frame.id && seen.stamp_ns == frame.stamp_ns);
    RC_ASSERT(Equal(seen.left, frame.left) && Equal(seen.right, frame.right));

    const Trajectory track = AnyTrajectory();
    const Trajectory told = ReadTrack(FormatTrack(track));
    RC_ASSERT(told.size() == track.size());
    for (std::size_t i = 0; i < track.size(); ++i) {
      RC_ASSERT(told[i].stamp_ns == track[i].stamp_ns);
      RC_ASSERT(told[i].T_world_rig.isApprox(track[i].T_world_rig, 1e-14));
    }
  }));
}

ExternalSystem AnyExternal() {
  return {.command = AnyText(),
          .dataset = AnyText(),
          .trajectory = AnyText(),
          .vslam_lab = static_cast<VslamLabStyle>(AnyOf(0, 3)),
          .timeout_s = AnyNumber(),
          .version = AnyText(),
          .repository = AnyText(),
          .build = AnyText(),
          .repeats = AnyOf(1, 100),
          .may_write = AnyList(3, AnyText),
          .environment = AnyList(3, AnyText),
          .depends_on = AnyList(3, AnyText)};
}

TEST_F(RoundTripTest, EverySystemASuiteCanName) {
  EXPECT_TRUE(rc::check([] {
    const SystemSpec spec{.name = AnyText(),
                          .like = AnyText(),
                          .options = AnyMap(3, AnyText),
                          .mask_errors = {.boundary_px = AnyNumber(),
                                          .miss_below_px = AnyWhole<int>(),
                                          .miss_share = AnyNumber(),
                                          .latency_frames = AnyWhole<int>()},
                          .external = Perhaps(AnyExternal)};
    RC_ASSERT(SystemSpecFromJson(nlohmann::ordered_json::parse(ToJson(spec).dump())) == spec);
  }));
}

}  // namespace
}  // namespace aisle
