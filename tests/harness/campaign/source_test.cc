#include "harness/campaign/source.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class SourceTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_source_{}", ::getpid());
    RemoveFolder(folder_);
  }
  void TearDown() override { RemoveFolder(folder_); }

  /// Whether any change of any of these files is another recording to a suite that names `below`.
  void ExpectEachCounts(const std::string& below, const std::vector<std::string>& files) const {
    for (const std::string& file : files) WriteFileAtomically(folder_ / file, "a");
    WriteFileAtomically(folder_ / "drive.yaml", "recording: " + below + "\n");
    const std::string suite_names = (folder_ / "drive.yaml").string();
    std::uint64_t before = HashSource(suite_names, "live", 1);
    EXPECT_EQ(HashSource(suite_names, "live", 1), before);
    for (const std::string& file : files) {
      WriteFileAtomically(folder_ / file, "longer");
      const std::uint64_t longer = HashSource(suite_names, "live", 1);
      EXPECT_NE(longer, before) << file;
      fs::last_write_time(folder_ / file, fs::file_time_type() + std::chrono::hours(1));
      const std::uint64_t touched = HashSource(suite_names, "live", 1);
      EXPECT_NE(touched, longer) << file;
      fs::remove(folder_ / file);
      before = HashSource(suite_names, "live", 1);
      EXPECT_NE(before, touched) << file;
    }
  }

  fs::path folder_;
};

TEST_F(SourceTest, EveryFileOfAFolderDecidesWhatItHolds) {
  ExpectEachCounts("euroc", {"euroc/mav0/cam0/data.csv", "euroc/mav0/cam1/data.csv",
                             "euroc/mav0/cam1/data/1403636579763555584.png",
                             "euroc/mav0/state_groundtruth_estimate0/data.csv"});
  ExpectEachCounts("kitti", {"kitti/sequences/00/calib.txt", "kitti/sequences/00/times.txt",
                             "kitti/sequences/00/image_1/000000.png", "kitti/poses/00.txt"});
  ExpectEachCounts("bag", {"bag/metadata.yaml", "bag/bag_0.db3"});
}

TEST_F(SourceTest, TheTruthBesideASequenceOfKittiCounts) {
  for (const char* name : {"kitti/sequences/07", "kitti/sequences/07/"}) {
    ExpectEachCounts(name, {"kitti/sequences/07/calib.txt", "kitti/poses/07.txt"});
  }
}

TEST_F(SourceTest, FoldersBehindLinksCountAndCirclesEnd) {
  fs::create_directories(folder_ / "euroc");
  fs::create_directories(folder_ / "images");
  fs::create_directory_symlink(folder_ / "images", folder_ / "euroc/data");
  fs::create_directory_symlink(folder_ / "euroc", folder_ / "euroc/again");
  ExpectEachCounts("euroc", {"euroc/a.csv", "images/0.png"});
}

}  // namespace
}  // namespace aisle
