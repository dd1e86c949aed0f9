// What is exported is read back by our reader and by OpenCV; real recordings are read where
// present.
#include "harness/io/dataset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/video/tracking.hpp>

#include "harness/io/file.h"
#include "harness/io/imu.h"
#include "harness/io/input_error.h"
#include "tests/support/test_data.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const StereoCalibration kRig{.width = 32,
                             .height = 24,
                             .fx = 30.5,
                             .fy = 30.5,
                             .cx = 15.25,
                             .cy = 11.75,
                             .baseline_m = 0.125};

Eigen::Isometry3d Path(std::int64_t stamp_ns) {
  const double t = static_cast<double>(stamp_ns) * 1e-9;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 0.5 * t * t, 0.3 * t, 1.0;
  pose.linear() = Eigen::AngleAxisd(0.2 * t, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

SequenceFrame Frame(int k) {
  SequenceFrame frame;
  frame.images.id = k;
  frame.images.stamp_ns = k * 50'000'000LL;
  frame.images.left = cv::Mat1b(24, 32);
  frame.images.right = cv::Mat1b(24, 32);
  cv::randu(frame.images.left, 0, 256);
  cv::randu(frame.images.right, 0, 256);
  frame.truth.emplace();
  frame.truth->T_world_rig = Path(frame.images.stamp_ns);
  frame.truth->depth = cv::Mat1f(24, 32, 2.5f + 0.001f * static_cast<float>(k));
  frame.truth->depth(0, 0) = std::numeric_limits<float>::infinity();
  frame.truth->instance = cv::Mat1w(24, 32, static_cast<unsigned short>(300));
  frame.truth->depth_right = cv::Mat1f(24, 32, 2.75f);
  frame.truth->instance_right = cv::Mat1w(24, 32, static_cast<unsigned short>(1));
  frame.truth->dynamic = cv::Mat1b(24, 32, static_cast<unsigned char>(255));
  frame.truth->dynamic_right = cv::Mat1b(24, 32, static_cast<unsigned char>(0));
  frame.truth->actor = frame.truth->dynamic;
  frame.truth->objects.resize(1);
  frame.truth->objects[0].object_class = "person";
  return frame;
}

FrameMotion Motion(int k) {
  FrameMotion motion;
  motion.disparity = cv::Mat1f(24, 32, 1.5f + 0.25f * static_cast<float>(k));
  motion.occluded = cv::Mat1b(24, 32, static_cast<unsigned char>(0));
  motion.flow = cv::Mat2f(24, 32, cv::Vec2f(0.125f, -3.3f));
  motion.flow(0, 1) = cv::Vec2f(std::numeric_limits<float>::quiet_NaN(), 0);
  motion.scene_flow = cv::Mat3f(24, 32, cv::Vec3f(0.1f, 0.2f, 0.3f));
  motion.moving_shadow = cv::Mat1b(24, 32, static_cast<unsigned char>(255));
  return motion;
}

class DatasetTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_dataset_{}", ::getpid());
    fs::remove_all(folder_);
    for (int k = 0; k < 5; ++k) {
      frames_.push_back(Frame(k));
      requests_.push_back({k, k * 50'000'000LL, Path(k * 50'000'000LL)});
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  void Export(DatasetFormat format, const std::vector<std::string>& truth = {}) {
    fs::remove_all(folder_);  // a folder is not continued in another format
    ExportOptions options;
    options.format = format;
    options.truth = TruthSelectionFromNames(truth);
    options.labels = std::vector<LabelInfo>(400, {"pallet", "goods", 5, false});
    options.labels[300] = {"walker", "person", 8, true};
    options.lens = lens_;
    epoch_ns_ = options.epoch_ns;
    DatasetWriter writer(folder_, kRig, 20, requests_, options);
    writer.Begin();
    for (const SequenceFrame& frame : frames_) {
      const FrameMotion motion = Motion(static_cast<int>(frame.images.id));
      writer.Add(frame, &motion);
    }
    for (const FrameRequest& request : requests_) EXPECT_TRUE(writer.Has(request));
    writer.Finish(Path);
  }
  void ExpectCameras(const StereoRecording& recording) const {
    EXPECT_EQ(recording.cameras.left.fx, kRig.fx);
    EXPECT_EQ(recording.cameras.left.cy, kRig.cy);
    const Eigen::Isometry3d T =
        recording.cameras.left.T_body_camera.inverse() * recording.cameras.right.T_body_camera;
    EXPECT_NEAR(T.translation().x(), kRig.baseline_m, 1e-9);
    ASSERT_EQ(recording.pairs.size(), frames_.size());
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const cv::Mat left = cv::imread(recording.pairs[i].left.string(), cv::IMREAD_UNCHANGED);
      const cv::Mat right = cv::imread(recording.pairs[i].right.string(), cv::IMREAD_UNCHANGED);
      EXPECT_EQ(cv::norm(left, frames_[i].images.left), 0);
      EXPECT_EQ(cv::norm(right, frames_[i].images.right), 0);
    }
  }
  std::string Read(const std::string& name) const { return ReadFile(folder_ / name); }
  static std::string Complaint(const fs::path& folder, DatasetFormat format) {
    try {
      ReadRecording(folder, format);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
  std::int64_t epoch_ns_ = 0;
  LensCalibration lens_;
  std::vector<SequenceFrame> frames_;
  std::vector<FrameRequest> requests_;
};

TEST_F(DatasetTest, EurocReadsBack) {
  Export(DatasetFormat::kEuroc);
  const StereoRecording recording = ReadRecording(folder_, DatasetFormat::kEuroc);
  ExpectCameras(recording);
  ASSERT_EQ(recording.truth.size(), frames_.size());
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    EXPECT_EQ(recording.truth[i].stamp_ns, requests_[i].stamp_ns + epoch_ns_);
    EXPECT_EQ(recording.pairs[i].stamp_ns, recording.truth[i].stamp_ns);
    EXPECT_TRUE(recording.truth[i].T_world_rig.isApprox(requests_[i].T_world_rig, 1e-12));
  }
}

TEST_F(DatasetTest, EurocHasWhatOtherReadersInsistOn) {
  Export(DatasetFormat::kEuroc);
  for (const char* name :
       {"mav0/cam0/sensor.yaml", "mav0/cam1/sensor.yaml", "mav0/imu0/sensor.yaml",
        "mav0/state_groundtruth_estimate0/sensor.yaml", "mav0/body.yaml"}) {
    EXPECT_TRUE(Read(name).starts_with("%YAML 1.0\n---\n")) << name;
    cv::FileStorage storage((folder_ / name).string(), cv::FileStorage::READ);
    EXPECT_TRUE(storage.isOpened()) << name;
  }
  cv::FileStorage sensor((folder_ / "mav0/cam0/sensor.yaml").string(), cv::FileStorage::READ);
  EXPECT_EQ(static_cast<double>(sensor["intrinsics"][0]), kRig.fx);
  const std::string truth = Read("mav0/state_groundtruth_estimate0/data.csv");
  const std::string first = truth.substr(truth.find('\n') + 1, truth.find('\n', 300));
  EXPECT_EQ(std::count(truth.begin(), truth.begin() + static_cast<long>(truth.find('\n')), ','),
            16);
  EXPECT_THAT(Read("mav0/times.txt"), testing::StartsWith("1600000000000000000\n"));
  EXPECT_THAT(Read("mav0/imu0/data.csv"),
              HasSubstr("1600000000005000000,"));  // 200 Hz: 5 ms after the first
}

TEST_F(DatasetTest, KittiReadsBack) {
  Export(DatasetFormat::kKitti);
  const StereoRecording recording = ReadRecording(folder_, DatasetFormat::kKitti);
  ExpectCameras(recording);
  ASSERT_EQ(recording.truth.size(), frames_.size());
  EXPECT_TRUE(recording.truth[0].T_world_rig.isApprox(CameraAhead(), 1e-12)) << "z up";
  EXPECT_EQ(recording.truth[2].stamp_ns, 100'000'000);
  EXPECT_THAT(Read("sequences/00/calib.txt"),
              HasSubstr("P1: 30.5 0 15.25 -3.8125 0 30.5 11.75 0 0 0 1 0\n"));
  EXPECT_THAT(Read("sequences/00/times.txt"), testing::StartsWith("0.000000000\n0.050000000\n"));
}

TEST_F(DatasetTest, APartIsADatasetOfItsOwnInEveryFormat) {
  const std::vector<SequenceFrame> all = frames_;
  const std::vector<FrameRequest> all_requests = requests_;
  for (const auto& [first, last] : {std::pair(2, 5), std::pair(4, 5), std::pair(0, 1)}) {
    frames_.assign(all.begin() + first, all.begin() + last);
    requests_.assign(all_requests.begin() + first, all_requests.begin() + last);
    for (const DatasetFormat format : {DatasetFormat::kEuroc, DatasetFormat::kKitti}) {
      Export(format, {"depth", "boxes"});
      const StereoRecording recording = ReadRecording(folder_, format);
      ExpectCameras(recording);
      ASSERT_EQ(recording.pairs.size(), frames_.size());
      ASSERT_EQ(recording.truth.size(), frames_.size());
      const nlohmann::json about = nlohmann::json::parse(Read("aisle.json"));
      EXPECT_EQ(about.at("first_frame"), first);
      EXPECT_EQ(about.at("frames"), last - first);
      Eigen::Isometry3d T_world_poses;
      for (int k = 0; k < 16; ++k) {
        T_world_poses.matrix()(k / 4, k % 4) = about.at("T_world_poses").at(k).get<double>();
      }
      if (format == DatasetFormat::kKitti) T_world_poses = T_world_poses * CameraAhead().inverse();
      for (std::size_t i = 0; i < frames_.size(); ++i) {
        const std::int64_t stamp_ns = recording.pairs[i].stamp_ns;
        EXPECT_EQ(stamp_ns, recording.truth[i].stamp_ns);
        EXPECT_EQ(stamp_ns - about.at("stamp_offset_ns").get<std::int64_t>(),
                  requests_[i].stamp_ns);
        EXPECT_TRUE((T_world_poses * recording.truth[i].T_world_rig)
                        .isApprox(requests_[i].T_world_rig, 1e-9));
        const std::string name = recording.pairs[i].left.stem().string();
        const cv::Mat depth =
            cv::imread((folder_ / "truth/depth" / (name + ".pfm")).string(), cv::IMREAD_UNCHANGED);
        ASSERT_FALSE(depth.empty()) << name;
        EXPECT_EQ(depth.at<float>(5, 5), frames_[i].truth->depth(5, 5));
        const auto boxes = nlohmann::json::parse(Read("truth/boxes/" + name + ".json"));
        EXPECT_EQ(boxes.at("frame"), i);
        EXPECT_EQ(boxes.at("stamp_ns"), stamp_ns);
        EXPECT_EQ(boxes.at("scene_frame"), requests_[i].id);
      }
    }
  }
}

TEST_F(DatasetTest, AFolderMayGrowAtItsEndAndNowhereElse) {
  for (const DatasetFormat format :
       {DatasetFormat::kEuroc, DatasetFormat::kKitti, DatasetFormat::kTum}) {
    fs::remove_all(folder_);
    const auto begin = [&](int first, int last) {
      const std::vector<FrameRequest> part(requests_.begin() + first, requests_.begin() + last);
      DatasetWriter(folder_, kRig, 20, part, {.format = format}).Begin();
    };
    begin(1, 3);
    begin(1, 3);
    begin(1, 4);
    for (const auto& [first, last] : {std::pair(1, 3), std::pair(0, 4), std::pair(2, 5)}) {
      try {
        begin(first, last);
        FAIL() << first << ":" << last;
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("aisle.json: the folder was started with frames 1:4"));
      }
    }
    begin(1, 5);
  }
}

TEST_F(DatasetTest, TumDepthIsMetresTimes5000) {
  Export(DatasetFormat::kTum);
  const std::string first = "depth/1600000000.000000000.png";
  const cv::Mat depth = cv::imread((folder_ / first).string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(depth.type(), CV_16U);
  EXPECT_EQ(depth.at<unsigned short>(5, 5), 12500);
  EXPECT_EQ(depth.at<unsigned short>(0, 0), 0);
  EXPECT_THAT(Read("rgb.txt"), HasSubstr("1600000000.050000000 rgb/1600000000.050000000.png\n"));
}

TEST_F(DatasetTest, TruthBesideReadsBack) {
  Export(DatasetFormat::kKitti, {"all"});
  const cv::Mat depth =
      cv::imread((folder_ / "truth/depth/000003.pfm").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(depth.rowRange(1, 24), frames_[3].truth->depth.rowRange(1, 24)), 0);
  EXPECT_TRUE(std::isinf(depth.at<float>(0, 0)));
  const cv::Mat labels =
      cv::imread((folder_ / "truth/instance/000003.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(labels.at<unsigned short>(4, 4), 300);
  EXPECT_THAT(Read("truth/boxes/000003.json"), HasSubstr("\"class\": \"person\""));
}

TEST_F(DatasetTest, EveryKindOfTruthReadsBackInOpenCv) {
  Export(DatasetFormat::kEuroc, {"all"});
  const std::string kStamp2 = "1600000000100000000";  // as the image is called
  const auto image = [&](const std::string& kind, const std::string& ending) {
    return cv::imread((folder_ / "truth" / kind / (kStamp2 + ending)).string(),
                      cv::IMREAD_UNCHANGED);
  };
  const FrameTruth& truth = *frames_[2].truth;
  const FrameMotion motion = Motion(2);
  const auto same = [](const cv::Mat& a, const cv::Mat& b) {
    return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
  };
  EXPECT_TRUE(same(image("depth_right", ".pfm"), truth.depth_right));
  EXPECT_TRUE(same(image("instance_right", ".png"), truth.instance_right));
  EXPECT_TRUE(same(image("dynamic_right", ".png"), truth.dynamic_right));
  EXPECT_TRUE(same(image("disparity", ".pfm"), motion.disparity));
  EXPECT_TRUE(same(image("occluded", ".png"), motion.occluded));
  EXPECT_TRUE(same(image("moving_shadow", ".png"), motion.moving_shadow));
  // OpenCV takes the file's channels for red, green, blue and hands them over blue first.
  const cv::Vec3f way = image("scene_flow", ".pfm").at<cv::Vec3f>(7, 9);
  EXPECT_EQ(cv::Vec3f(way[2], way[1], way[0]), motion.scene_flow(7, 9));
  const cv::Mat steps = image("depth_mm", ".png");
  ASSERT_EQ(steps.type(), CV_16U);
  EXPECT_NEAR(steps.at<unsigned short>(5, 5) * 1e-3, truth.depth(5, 5), 0.5e-3);
  EXPECT_EQ(steps.at<unsigned short>(0, 0), 0);
  const cv::Mat classes = image("class", ".png");
  ASSERT_EQ(classes.type(), CV_8U);
  EXPECT_EQ(classes.at<unsigned char>(3, 3), 8);
  EXPECT_EQ(image("class_right", ".png").at<unsigned char>(3, 3), 5);
  const cv::Mat2f flow =
      cv::readOpticalFlow((folder_ / "truth/flow" / (kStamp2 + ".flo")).string());
  EXPECT_EQ(flow(7, 9), motion.flow(7, 9));
  EXPECT_GT(flow(0, 1)[0], 1e9f) << "unknown, as Middlebury says it";
  EXPECT_THAT(Read("truth/labels.json"), HasSubstr("\"walker\""));
  EXPECT_THAT(Read("truth/boxes/" + kStamp2 + ".json"), HasSubstr("T_world_object"));
}

TEST_F(DatasetTest, ADistortedLensIsStatedInEurocAndRefusedElsewhere) {
  lens_ = {"radial-tangential", {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}};
  Export(DatasetFormat::kEuroc);
  const StereoRecording recording = ReadRecording(folder_, DatasetFormat::kEuroc);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(recording.cameras.left.distortion.at(k), lens_.coefficients[k]);
    EXPECT_EQ(recording.cameras.right.distortion.at(k), lens_.coefficients[k]);
  }
  EXPECT_FALSE(recording.cameras.left.equidistant);
  EXPECT_THROW(Export(DatasetFormat::kKitti), InputError);
  EXPECT_THROW(Export(DatasetFormat::kTum), InputError);
  lens_.model = "equidistant";
  Export(DatasetFormat::kEuroc);
  EXPECT_TRUE(ReadRecording(folder_, DatasetFormat::kEuroc).cameras.left.equidistant);
}

TEST_F(DatasetTest, PosesReadBackToANanometre) {
  for (const DatasetFormat format : {DatasetFormat::kEuroc, DatasetFormat::kKitti}) {
    Export(format);
    const StereoRecording recording = ReadRecording(folder_, format);
    // KITTI's poses are of the first camera, and are read into a world whose z is up.
    const Eigen::Isometry3d origin = format == DatasetFormat::kKitti
                                         ? requests_[0].T_world_rig * CameraAhead().inverse()
                                         : Eigen::Isometry3d::Identity();
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      const Eigen::Isometry3d off =
          (origin * recording.truth[i].T_world_rig).inverse() * requests_[i].T_world_rig;
      EXPECT_LT((off.matrix() - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

TEST_F(DatasetTest, LinesAreAsStrictReadersWantThem) {
  // evo refuses trailing spaces; Kimera takes names for stamps and 17 columns for granted.
  Export(DatasetFormat::kKitti);
  for (const char* file : {"poses/00.txt", "sequences/00/times.txt", "sequences/00/calib.txt"}) {
    const std::string text = Read(file);
    EXPECT_EQ(text.find(" \n"), std::string::npos) << file;
    EXPECT_EQ(text.find("  "), std::string::npos) << file;
    EXPECT_EQ(text.back(), '\n') << file;
  }
  Export(DatasetFormat::kEuroc);
  EXPECT_THAT(Read("mav0/cam1/data.csv"),
              HasSubstr("\n1600000000050000000,1600000000050000000.png\n"));
  std::istringstream truth(Read("mav0/state_groundtruth_estimate0/data.csv"));
  for (std::string line; std::getline(truth, line);) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 16) << line;
  }
  std::istringstream imu(Read("mav0/imu0/data.csv"));
  std::string line;
  std::getline(imu, line);
  std::int64_t before = 0;
  while (std::getline(imu, line)) {
    const std::int64_t stamp = std::stoll(line);
    EXPECT_GT(stamp, before);
    before = stamp;
  }
}

TEST_F(DatasetTest, AFolderBegunWithOtherFramesIsNotContinued) {
  ExportOptions options;
  options.provenance = {{"scene", "a"}, {"seed", "1"}};
  DatasetWriter(folder_, kRig, 20, requests_, options).Begin();
  DatasetWriter(folder_, kRig, 20, requests_, options).Begin();
  options.provenance["seed"] = "2";
  try {
    DatasetWriter(folder_, kRig, 20, requests_, options).Begin();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("choose another --out"));
  }
}

/// Writes the whole dataset in a process of its own and kills it after a while; true: it finished.
bool ExportUntilKilled(const std::function<void()>& write, useconds_t after_us) {
  const pid_t child = ::fork();
  if (child == 0) {
    write();
    ::_exit(0);
  }
  ::usleep(after_us);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status);
}

TEST_F(DatasetTest, KilledAnywhereItLeavesWholeFilesAndGoesOn) {
  ExportOptions options;
  options.truth = TruthSelectionFromNames({"depth", "dynamic", "flow"});
  options.provenance = {{"scene", "a"}};
  const FrameMotion motion = Motion(0);
  const auto write = [&] {
    DatasetWriter writer(folder_, kRig, 20, requests_, options);
    writer.Begin();
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (!writer.Has(requests_[i])) writer.Add(frames_[i], &motion);
    }
    writer.Finish(Path);
  };
  int kills = 0;
  for (useconds_t after_us = 200; !ExportUntilKilled(write, after_us); after_us += 2500) {
    ++kills;
    std::error_code absent;  // killed before it made the folder
    for (const auto& entry : fs::recursive_directory_iterator(folder_, absent)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_regular_file() || name.starts_with(".")) continue;  // written aside
      if (!name.ends_with(".png") && !name.ends_with(".pfm")) continue;
      EXPECT_FALSE(cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED).empty()) << name;
    }
    ASSERT_LT(kills, 400);
  }
  EXPECT_GT(kills, 0);
  for (const FrameRequest& request : requests_) {
    EXPECT_TRUE(DatasetWriter(folder_, kRig, 20, requests_, options).Has(request));
  }
  ExpectCameras(ReadRecording(folder_, DatasetFormat::kEuroc));
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    EXPECT_FALSE(entry.path().filename().string().starts_with("."))
        << entry.path() << ": leftovers of a killed process are cleared at the end";
  }
}

TEST_F(DatasetTest, MistakesAreNamed) {
  EXPECT_THROW(TruthSelectionFromNames({"optical"}), InputError);
  EXPECT_THROW(ReadRecording(folder_ / "none", DatasetFormat::kEuroc), InputError);
  Export(DatasetFormat::kEuroc);
  WriteFileAtomically(folder_ / "mav0/cam0/data.csv", "#x\n12,../../etc/passwd\n");
  try {
    ReadRecording(folder_, DatasetFormat::kEuroc);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("data.csv:2: '../../etc/passwd' is not a plain file name"));
  }
}

TEST_F(DatasetTest, EurocsImagesOfOneInstantAreAMillisecondApartAtMost) {
  Export(DatasetFormat::kEuroc);
  const std::string index = "mav0/cam1/data.csv";
  const auto late = [&](const std::string& rest_ns) {
    std::string text = Read(index);
    for (std::size_t at = 0; (at = text.find("000000,", at)) != std::string::npos; ++at) {
      text.replace(at, 6, rest_ns);
    }
    return text;
  };
  const std::string nearly = late("999999");
  WriteFileAtomically(folder_ / index, nearly);
  ExpectCameras(ReadRecording(folder_, DatasetFormat::kEuroc));
  // A right image of another instant is no partner, and is told.
  std::string odd = nearly;
  odd.replace(odd.find("1600000000000999999,"), 20, "1600000000020000000,");
  WriteFileAtomically(folder_ / index, odd);
  const StereoRecording recording = ReadRecording(folder_, DatasetFormat::kEuroc);
  EXPECT_EQ(recording.pairs.size(), 4u);
  EXPECT_EQ(recording.pairs.front().stamp_ns, 1'600'000'000'050'000'000);
  EXPECT_THAT(recording.notes,
              testing::ElementsAre(HasSubstr("skipped 1 of 5 left images, which have no right")));
}

TEST_F(DatasetTest, AnImageThatIsListedIsThere) {
  Export(DatasetFormat::kEuroc);
  for (const char* image :
       {"mav0/cam1/data/1600000000100000000.png", "mav0/cam0/data/1600000000150000000.png"}) {
    fs::remove(folder_ / image);
    EXPECT_THAT(Complaint(folder_, DatasetFormat::kEuroc),
                HasSubstr("data.csv: 1 of the 5 images that it lists are missing from its folder"));
    Export(DatasetFormat::kEuroc);
  }
}

/// Whatever the format: a few are told, most are refused.
TEST_F(DatasetTest, ADriveWithoutHalfOfItsRightImagesIsNone) {
  Export(DatasetFormat::kKitti);
  for (const char* first : {"000001.png", "000003.png"}) {
    fs::remove(folder_ / "sequences/00/image_1" / first);
  }
  StereoRecording recording = ReadRecording(folder_, DatasetFormat::kKitti);
  EXPECT_EQ(recording.pairs.size(), 3u);
  EXPECT_EQ(recording.pairs.back().stamp_ns, 200'000'000);
  EXPECT_THAT(recording.notes,
              testing::ElementsAre(HasSubstr("skipped 2 of 5 left images, which have no right")));
  fs::remove(folder_ / "sequences/00/image_0/000001.png");
  recording = ReadRecording(folder_, DatasetFormat::kKitti);
  EXPECT_THAT(recording.notes,
              testing::ElementsAre(HasSubstr("skipped 1 of 4 left images, which have no right"),
                                   HasSubstr("1 of 5 frames have a time but no")));
  for (const char* more : {"000000.png", "000002.png"}) {
    fs::remove(folder_ / "sequences/00/image_1" / more);
  }
  EXPECT_THAT(Complaint(folder_, DatasetFormat::kKitti),
              HasSubstr("only 1 of 4 left images have a right one"));
  Export(DatasetFormat::kEuroc);
  EXPECT_THAT(ReadRecording(folder_, DatasetFormat::kEuroc).notes, testing::IsEmpty());
  WriteFileAtomically(folder_ / "mav0/cam1/data.csv",
                      "1600000000050000000,1600000000050000000.png\n");
  EXPECT_THAT(Complaint(folder_, DatasetFormat::kEuroc),
              HasSubstr("only 1 of 5 left images have a right one"));
}

TEST_F(DatasetTest, APoseOfACameraIsARigidOne) {
  const std::string good =
      "1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, "
      "0.0, 1.0";
  const std::string file = "mav0/cam0/sensor.yaml";
  Export(DatasetFormat::kEuroc);
  const std::string text = Read(file);
  const std::size_t begin = text.find('[', text.find("T_BS")), end = text.find(']', begin);
  const auto with = [&](const std::string& numbers) {
    WriteFileAtomically(folder_ / file, text.substr(0, begin) + "[" + numbers + text.substr(end));
    return Complaint(folder_, DatasetFormat::kEuroc);
  };
  EXPECT_EQ(with(good), "");
  for (const char* bad : {"0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,1",       // never filled in
                          "2,0,0,0, 0,2,0,0, 0,0,2,0, 0,0,0,1",       // scaled
                          "1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1",      // a mirror
                          "1,0,0,0, 0,1,0,0, 0,0,1,0, 0.1,0,0,1"}) {  // column by column
    EXPECT_THAT(with(bad), HasSubstr("T_BS is not a pose")) << bad;
  }
}

TEST_F(DatasetTest, RosLensesHaveAFifthCoefficient) {
  lens_ = {.model = "radial-tangential", .coefficients = {-0.3, 0.1, 0, 0}};
  Export(DatasetFormat::kEuroc);
  const auto restate = [&](const std::string& model, const std::string& coefficients) {
    for (const char* name : {"mav0/cam0/sensor.yaml", "mav0/cam1/sensor.yaml"}) {
      std::string text;
      std::istringstream lines(Read(name));
      for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("distortion_model")) line = "distortion_model: " + model;
        if (line.starts_with("distortion_coefficients")) {
          line = "distortion_coefficients: " + coefficients;
        }
        text += line + "\n";
      }
      WriteFileAtomically(folder_ / name, text);
    }
  };
  restate("plumb_bob", "[-0.3, 0.1, 0.01, 0.02, 0.03]");
  EXPECT_EQ(ReadRecording(folder_, DatasetFormat::kEuroc).cameras.right.distortion,
            (std::vector<double>{-0.3, 0.1, 0.01, 0.02, 0.03}));
  restate("equidistant", "[-0.3, 0.1, 0.01, 0.02, 0.03]");
  EXPECT_THAT(Complaint(folder_, DatasetFormat::kEuroc), HasSubstr("must have 4 numbers"));
}

TEST_F(DatasetTest, AnotherLayoutIsToldByItsFiles) {
  Export(DatasetFormat::kKitti);
  for (const fs::path& folder : {folder_, folder_ / "sequences/00"}) {
    EXPECT_THAT(Complaint(folder, DatasetFormat::kEuroc), HasSubstr("--format kitti"));
  }
  Export(DatasetFormat::kEuroc);
  for (const fs::path& folder : {folder_, folder_ / "mav0"}) {
    EXPECT_THAT(Complaint(folder, DatasetFormat::kKitti), HasSubstr("use format euroc"));
  }
}

TEST_F(DatasetTest, KittisColourPairServesWhereTheGreyOneIsNot) {
  Export(DatasetFormat::kKitti);
  const fs::path sequence = folder_ / "sequences/00";
  fs::rename(sequence / "image_0", sequence / "image_2");
  fs::rename(sequence / "image_1", sequence / "image_3");
  ExpectCameras(ReadRecording(folder_, DatasetFormat::kKitti));
}

TEST_F(DatasetTest, OtherNamesOfALensAndBlanksInAListAreRead) {
  lens_ = {.model = "radial-tangential", .coefficients = {-0.3, 0.1, 0, 0}};
  Export(DatasetFormat::kEuroc);
  for (const char* name : {"mav0/cam0/sensor.yaml", "mav0/cam1/sensor.yaml"}) {
    std::string text = Read(name);
    const std::string model = "radial-tangential";
    text.replace(text.find(model), model.size(), "radtan");
    WriteFileAtomically(folder_ / name, text);
  }
  std::string list;
  for (const char c : Read("mav0/cam0/data.csv"))
    list += c == ',' ? std::string(", ") : std::string(1, c);
  WriteFileAtomically(folder_ / "mav0/cam0/data.csv", list);
  const StereoRecording recording = ReadRecording(folder_, DatasetFormat::kEuroc);
  ExpectCameras(recording);
  EXPECT_EQ(recording.cameras.left.distortion, (std::vector<double>{-0.3, 0.1, 0, 0}));
}

TEST_F(DatasetTest, AByteOrderMarkIsNoPartOfAText) {
  const auto mark = [&](const std::string& name) {
    WriteFileAtomically(folder_ / name, "\xEF\xBB\xBF" + Read(name));
  };
  Export(DatasetFormat::kEuroc);
  for (const char* name : {"mav0/cam0/data.csv", "mav0/cam1/data.csv", "mav0/cam0/sensor.yaml"}) {
    mark(name);
  }
  ExpectCameras(ReadRecording(folder_, DatasetFormat::kEuroc));
  Export(DatasetFormat::kKitti);
  for (const char* name : {"sequences/00/calib.txt", "sequences/00/times.txt"}) mark(name);
  ExpectCameras(ReadRecording(folder_, DatasetFormat::kKitti));
}

TEST_F(DatasetTest, WhatIsThereTwiceIsRefused) {
  Export(DatasetFormat::kEuroc);
  const std::string index = Read("mav0/cam1/data.csv");
  WriteFileAtomically(folder_ / "mav0/cam1/data.csv", index + index.substr(index.find('\n') + 1));
  EXPECT_THAT(Complaint(folder_, DatasetFormat::kEuroc),
              HasSubstr("data.csv:7: a second image at"));
  Export(DatasetFormat::kKitti);
  const std::string calibration = Read("sequences/00/calib.txt");
  WriteFileAtomically(folder_ / "sequences/00/calib.txt",
                      calibration + "P1: 9 0 0 0 0 9 0 0 0 0 1 0\n");
  EXPECT_THAT(Complaint(folder_, DatasetFormat::kKitti), HasSubstr("a second line 'P1:'"));
}

TEST_F(DatasetTest, IntrinsicsThatAreNoCamerasAreRefused) {
  Export(DatasetFormat::kEuroc);
  const std::string file = "mav0/cam0/sensor.yaml", good = Read(file);
  const std::size_t begin = good.find('[', good.find("intrinsics:"));
  for (const char* bad : {"[1e308, 30, 15, 12]", "[30, 1e-300, 15, 12]", "[30, 30, 1e300, 12]",
                          "[-30, 30, 15, 12]"}) {
    std::string text = good;
    text.replace(begin, text.find(']', begin) + 1 - begin, bad);
    WriteFileAtomically(folder_ / file, text);
    EXPECT_THAT(Complaint(folder_, DatasetFormat::kEuroc), HasSubstr("are no camera's")) << bad;
  }
}

TEST(ImuTest, AtRestItFeelsGravityUpwards) {
  const auto samples =
      IdealImu([](std::int64_t) { return Eigen::Isometry3d::Identity(); }, 0, 10'000'000, 200);
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_TRUE(samples[1].specific_force.isApprox(Eigen::Vector3d(0, 0, kGravityMps2), 1e-9));
  EXPECT_EQ(samples[1].angular_velocity.norm(), 0);
}

TEST(ImuTest, AMovingRigFeelsItsOwnAcceleration) {
  const ImuSample sample = IdealImu(Path, 500'000'000, 500'000'000, 200).at(0);
  EXPECT_NEAR(sample.angular_velocity.z(), 0.2, 1e-6);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(
      sample.specific_force.isApprox(turn.transpose() * Eigen::Vector3d(1, 0, kGravityMps2), 1e-5));
}

TEST(ImuTest, WhatLiesBetweenSamplesIsNotLost) {
  // Pushed by 2 m/s^2 for 1 ms, between two samples: 2 mm/s.
  const auto pushed = [](std::int64_t stamp_ns) {
    const double t = std::max(0.0, static_cast<double>(stamp_ns - 101'200'000) * 1e-9);
    const double during = std::min(t, 1e-3), after = t - during;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().x() = during * during + 2e-3 * after;
    return pose;
  };
  double gained = 0;
  for (const ImuSample& sample : IdealImu(pushed, 0, 200'000'000, 200)) {
    gained += sample.specific_force.x() * 5e-3;
  }
  EXPECT_NEAR(gained, 2e-3, 1e-9);
  EXPECT_NEAR(VelocityAt(pushed, 200'000'000, 200).x(), 2e-3, 1e-9);
}

TEST(RealRecordingTest, EurocAndKittiAreRead) {
  const fs::path data = TestData("");
  if (!fs::exists(data / "kitti")) GTEST_SKIP() << "no recordings in " << data;
  const StereoRecording euroc = ReadRecording(data / "euroc-v101-still", DatasetFormat::kEuroc);
  EXPECT_EQ(euroc.pairs.size(), 40u);
  EXPECT_EQ(euroc.cameras.left.width, 752);
  EXPECT_EQ(euroc.cameras.left.distortion.size(), 4u);
  const StereoRecording kitti = ReadRecording(data / "kitti", DatasetFormat::kKitti);
  EXPECT_EQ(kitti.pairs.size(), 51u);
  EXPECT_EQ(kitti.truth.size(), 51u);
  EXPECT_NEAR(kitti.cameras.right.T_body_camera.translation().x(), 0.537, 0.001);
}

}  // namespace
}  // namespace aisle
