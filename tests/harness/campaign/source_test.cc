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

/// What a system could read unless it is hidden from it.
TEST_F(SourceTest, TruthIsAmongTheFilesWhereverItLies) {
  const auto real_files = [&](const std::string& below) {
    WriteFileAtomically(folder_ / "drive.yaml", "recording: " + below + "\n");
    std::set<fs::path> real;
    for (const std::string& file : FilesOfSource((folder_ / "drive.yaml").string())) {
      real.insert(fs::weakly_canonical(file));
    }
    return real;
  };
  const fs::path disk = fs::weakly_canonical(folder_) / "disk";
  for (const char* file : {"kitti/sequences/07/calib.txt", "kitti/poses/07.txt", "poses/07.txt",
                           "mav0/vicon0/data.csv", "truth/data.csv", "euroc/cam0/data.csv"}) {
    WriteFileAtomically(disk / file, "a");
  }
  EXPECT_TRUE(real_files("disk/kitti/sequences/07").contains(disk / "kitti/poses/07.txt"));
  // A sequence that is linked has poses where it leads, a root that is one where they are linked.
  fs::create_directories(folder_ / "mine/sequences");
  fs::create_directory_symlink(disk / "kitti/sequences/07", folder_ / "mine/sequences/00");
  EXPECT_TRUE(real_files("mine/sequences/00").contains(disk / "kitti/poses/07.txt"));
  fs::create_directory_symlink(disk / "poses", folder_ / "mine/poses");
  fs::rename(folder_ / "mine/sequences/00", folder_ / "mine/sequences/07");
  for (const char* below : {"mine", "mine/sequences/07"}) {
    EXPECT_TRUE(real_files(below).contains(disk / "poses/07.txt")) << below;
    EXPECT_TRUE(real_files(below).contains(disk / "kitti/poses/07.txt")) << below;
  }
  // Of EuRoC any part may be a link.
  fs::create_directories(folder_ / "whole");
  fs::create_directory_symlink(disk / "mav0", folder_ / "whole/mav0");
  EXPECT_TRUE(real_files("whole").contains(disk / "mav0"));
  fs::create_directory_symlink(disk / "truth", disk / "euroc/state_groundtruth_estimate0");
  EXPECT_TRUE(real_files("disk/euroc").contains(disk / "truth"));
  fs::create_directories(folder_ / "file/mav0/state_groundtruth_estimate0");
  fs::create_symlink(disk / "truth/data.csv",
                     folder_ / "file/mav0/state_groundtruth_estimate0/data.csv");
  EXPECT_TRUE(real_files("file").contains(disk / "truth/data.csv"));
  EXPECT_EQ(real_files("file").size(), 3u) << "what lies below is not named again";
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
