#include "slam/common/write_aside.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>

namespace aisle::slam {
namespace {

namespace fs = std::filesystem;

std::string BytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The disk as good as full: no file of this process may become larger than that.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    handler_ = ::signal(SIGXFSZ, SIG_IGN);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

class WriteAsideTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  std::string ErrorOf(std::initializer_list<std::string_view> parts) const {
    try {
      WriteAside(file, parts);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder = fs::path(testing::TempDir()) / "write_aside_test";
  const fs::path file = folder / "a.map";
};

TEST_F(WriteAsideTest, PartsComeOneAfterTheOther) {
  WriteAside(file, {"head", "", std::string_view("\0body", 5)});
  EXPECT_EQ(BytesOf(file), std::string("head\0body", 9));
  WriteAside(file, {"anew"});
  EXPECT_EQ(BytesOf(file), "anew");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(WriteAsideTest, AFullDiskLeavesTheOldFileAndNothingElse) {
  WriteAside(file, {"old"});
  const std::string large(100'000, 'x');
  std::string error;
  {
    const FullDisk disk(20'000);
    error = ErrorOf({"head", large});
  }
  EXPECT_THAT(error, testing::StartsWith(file.string() + ": cannot be written: "));
  EXPECT_EQ(BytesOf(file), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "something lies beside it";
}

TEST_F(WriteAsideTest, WhereAFolderStandsNothingIsLeftBeside) {
  fs::create_directories(file / "in_the_way");
  EXPECT_THAT(ErrorOf({"new"}), testing::HasSubstr("cannot be written"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(WriteAsideTest, AMissingFolderIsTold) {
  fs::remove_all(folder);
  EXPECT_THAT(ErrorOf({"new"}), testing::HasSubstr("No such file or directory"));
}

}  // namespace
}  // namespace aisle::slam
