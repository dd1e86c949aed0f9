// Datasets of guests: each has its own, and what was spoilt since it was exported is made anew.
#include "harness/campaign/guest_dataset.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/io/file.h"
#include "harness/io/hash.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Three frames of a rig that drives ahead; counts how often it was asked for one.
class SmallSequence : public Sequence {
 public:
  std::string name() const override { return "small"; }
  StereoCalibration calibration() const override {
    return {.width = 32, .height = 24, .fx = 30, .fy = 30, .cx = 16, .cy = 12, .baseline_m = 0.1};
  }
  double rate_hz() const override { return 20; }
  std::vector<FrameRequest> Schedule() const override {
    std::vector<FrameRequest> frames;
    for (int i = 0; i < 3; ++i) frames.push_back({i, i * 50'000'000LL, PoseAt(i * 50'000'000LL)});
    return frames;
  }
  SequenceFrame At(const FrameRequest& request) const override {
    ++asked;
    SequenceFrame frame;
    frame.images.id = request.id;
    frame.images.stamp_ns = request.stamp_ns;
    frame.images.left = frame.images.right = cv::Mat1b(24, 32, static_cast<unsigned char>(50));
    frame.truth.emplace();
    frame.truth->T_world_rig = request.T_world_rig;
    return frame;
  }
  static Eigen::Isometry3d PoseAt(std::int64_t stamp_ns) {
    return Eigen::Isometry3d(Eigen::Translation3d(static_cast<double>(stamp_ns) * 1e-9, 0, 0));
  }

  mutable int asked = 0;
};

class GuestDatasetTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_guest_{}", ::getpid());
  }
  void TearDown() override { RemoveFolder(folder_); }

  /// Lays the dataset out for a guest; the checksum of what it gets.
  std::uint64_t LayOut(DatasetFormat format = DatasetFormat::kEuroc) const {
    LayOutDataset(sequence_,
                  {.kept = folder_ / "kept",
                   .options = {.format = format, .true_trajectory = false},
                   .open_path = [] { return PathOfRig(SmallSequence::PoseAt); }},
                  folder_ / "guest");
    return HashFolder(folder_ / "guest");
  }

  const SmallSequence sequence_;
  fs::path folder_;
};

TEST_F(GuestDatasetTest, IsExportedOnceAndCopiedForEach) {
  const std::uint64_t first = LayOut();
  EXPECT_EQ(LayOut(), first);
  EXPECT_EQ(sequence_.asked, 3);
  WriteFileAtomically(folder_ / "guest/mav0/cam0/data.csv", "spoilt by the guest");
  EXPECT_EQ(LayOut(), first);
  EXPECT_EQ(sequence_.asked, 3);
}

TEST_F(GuestDatasetTest, IsMadeAnewWhereSomebodyChangedIt) {
  const std::uint64_t whole = LayOut();
  const fs::path kept = folder_ / "kept";
  int exports = 1;
  const auto expect_anew = [&](const char* what) {
    EXPECT_EQ(LayOut(), whole) << what;
    EXPECT_EQ(sequence_.asked, 3 * ++exports) << what;
  };
  WriteFileAtomically(kept / "mav0/cam0/data.csv", "spoilt");
  expect_anew("another text");
  fs::remove(kept / "mav0/imu0/data.csv");
  expect_anew("a file less");
  WriteFileAtomically(kept / "mav0/more", "more");
  expect_anew("a file more");
  fs::remove(kept / "complete");
  expect_anew("never finished");
  ASSERT_EQ(::mkfifo((kept / "mav0/pipe").c_str(), 0600), 0);
  expect_anew("a pipe");
  fs::rename(kept / "rgb.csv", folder_ / "rgb.csv");
  fs::create_symlink(folder_ / "rgb.csv", kept / "rgb.csv");
  expect_anew("a link");
}

TEST_F(GuestDatasetTest, HoldsNoTruth) {
  for (const DatasetFormat format : {DatasetFormat::kEuroc, DatasetFormat::kKitti}) {
    RemoveFolder(folder_);
    LayOut(format);
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "guest")) {
      const std::string path = entry.path().string();
      EXPECT_EQ(path.find("groundtruth"), std::string::npos) << path;
      EXPECT_EQ(path.find("poses"), std::string::npos) << path;
    }
  }
}

}  // namespace
}  // namespace aisle
