// Files that others left: whatever stands there, reading it ends, and ends small.
#include "harness/io/file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <functional>

#include "harness/io/file_lock.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "tests/support/few_descriptors.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_file_{}", ::getpid());
    fs::create_directories(folder_ / "left");
  }
  void TearDown() override { RemoveFolder(folder_); }

  std::string Left(const std::string& name) const {
    try {
      return ReadLeftFile(folder_ / "left", name, 1000);
    } catch (const InputError& error) {
      return error.what();
    }
  }

  fs::path folder_;
};

TEST_F(FileTest, ALeftFileIsReadWhereItIsOne) {
  WriteFileAtomically(folder_ / "left/good", "text");
  fs::create_symlink("good", folder_ / "left/link");
  EXPECT_EQ(Left("good"), "text");
  EXPECT_EQ(Left("link"), "text");  // within its folder
}

TEST_F(FileTest, ALeftFileThatIsNoneIsRefusedAtOnce) {
  WriteFileAtomically(folder_ / "outside", "truth");
  ASSERT_EQ(::mkfifo((folder_ / "left/pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "left/device");
  fs::create_symlink("../outside", folder_ / "left/out");
  fs::create_symlink(folder_ / "outside", folder_ / "left/far");
  fs::create_symlink("circle", folder_ / "left/circle");
  fs::create_directory(folder_ / "left/folder");
  WriteFileAtomically(folder_ / "left/sparse", "");
  ASSERT_EQ(::truncate((folder_ / "left/sparse").c_str(), off_t{60} << 30), 0);
  EXPECT_THAT(Left("pipe"), HasSubstr("not a regular file"));
  EXPECT_THAT(Left("folder"), HasSubstr("not a regular file"));
  EXPECT_THAT(Left("device"), HasSubstr("is a link out of its folder"));
  EXPECT_THAT(Left("out"), HasSubstr("is a link out of its folder"));
  EXPECT_THAT(Left("far"), HasSubstr("is a link out of its folder"));
  EXPECT_THAT(Left("circle"), HasSubstr("is a link out of its folder"));
  EXPECT_THAT(Left("sparse"), HasSubstr("larger than the allowed 1000 bytes"));
  EXPECT_THAT(Left("none"), HasSubstr("no such file"));
}

TEST_F(FileTest, WhatIsNoFileIsWrittenToAsItStands) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  WriteFileAtomically(pipe, "text");
  std::string read(100, ' ');
  read.resize(static_cast<std::size_t>(std::max<ssize_t>(::read(reader, read.data(), 100), 0)));
  ::close(reader);
  EXPECT_EQ(read, "text");
  EXPECT_TRUE(fs::is_fifo(pipe));
  // A link, so that the device of the machine that tests this stays what it is.
  fs::create_symlink("/dev/null", folder_ / "null");
  WriteFileAtomically(folder_ / "null", "text");
  EXPECT_TRUE(fs::is_symlink(folder_ / "null"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileTest, ALinkLeadsToTheFileThatIsWritten) {
  fs::create_symlink("left/real", folder_ / "near");
  fs::create_symlink(folder_ / "near", folder_ / "far");
  for (const char* text : {"not there yet", "there"}) {
    WriteFileAtomically(folder_ / "far", text);
    EXPECT_EQ(ReadFile(folder_ / "left/real"), text);
    EXPECT_TRUE(fs::is_symlink(folder_ / "near") && fs::is_symlink(folder_ / "far"));
  }
  { FileAside dropped(folder_ / "far"); }
  EXPECT_EQ(ReadFile(folder_ / "left/real"), "there");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "left"), {}), 1) << "nothing aside";
}

TEST_F(FileTest, WhatHasNoEndIsReadToTheLimitAlone) {
  EXPECT_THROW(ReadFile("/dev/zero", 100'000), InputError);
}

TEST_F(FileTest, AFolderThatForbidsItIsRemovedAllTheSame) {
  WriteFileAtomically(folder_ / "left/a/b/c", "text");
  fs::permissions(folder_ / "left/a/b", fs::perms::none);
  EXPECT_TRUE(TryToRemoveFolder(folder_ / "left"));
  EXPECT_FALSE(fs::exists(folder_ / "left"));
}

/// Makes folders in each other, named alike, and a file in the innermost.
void MakeDeep(const fs::path& top, int levels) {
  fs::create_directory(top);
  int folder = ::open(top.c_str(), O_RDONLY | O_DIRECTORY);
  for (int level = 0; level < levels; ++level) {
    ::mkdirat(folder, "d", 0700);
    const int next = ::openat(folder, "d", O_RDONLY | O_DIRECTORY);
    ::close(std::exchange(folder, next));
  }
  ::close(::openat(folder, "file", O_WRONLY | O_CREAT, 0600));
  ::close(folder);
}

TEST_F(FileTest, AFolderIsRemovedHoweverDeepItIs) {
  const fs::path left = folder_ / "left";
  MakeDeep(left / "deep", 2000);
  MakeDeep(left / "other", 300);
  fs::create_directories(left / ".moved-up-0/.moved-up-1");  // names that we would give
  WriteFileAtomically(left / ".moved-up-3", "");
  WriteFileAtomically(folder_ / "outside/file", "kept");
  fs::create_directory_symlink(folder_ / "outside", left / "other/link");
  const FewDescriptors few(256);
  EXPECT_TRUE(TryToRemoveFolder(left));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(TryToRemoveFolder(left)) << "it is gone";
  EXPECT_EQ(ReadFile(folder_ / "outside/file"), "kept") << "a link goes alone";
}

TEST_F(FileTest, WhatStaysOfAFolderIsNotPassedOver) {
  WriteFileAtomically(folder_ / "left/file", "yesterday's");
  bool removed = true;
  std::exception_ptr thrown;  // judged when there are descriptors again, as below
  try {
    const FewDescriptors none(0);
    removed = TryToRemoveFolder(folder_ / "left");
    RemoveFolder(folder_ / "left");
  } catch (...) {
    thrown = std::current_exception();
  }
  EXPECT_FALSE(removed);
  ASSERT_TRUE(thrown);
  EXPECT_THROW(std::rethrow_exception(thrown), MachineError);
}

/// Whether a thing said by an ordinary user, who is kept out of folders, is an InputError.
bool IsInputErrorToAUser(const std::function<void()>& say) {
  const pid_t user = ::fork();
  if (user == 0) {
    constexpr unsigned kNobody = 65534;
    if (::geteuid() == 0 && (::setgid(kNobody) != 0 || ::setuid(kNobody) != 0)) ::_exit(2);
    try {
      say();
    } catch (const InputError&) {
      ::_exit(0);
    } catch (...) {
    }
    ::_exit(1);
  }
  int status = 0;
  ::waitpid(user, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(FileTest, AFolderThatWasClosedIsTheFaultOfWhomItWasLeftTo) {
  WriteFileAtomically(folder_ / "left/file", "text");
  fs::permissions(folder_ / "left", fs::perms::none);
  EXPECT_TRUE(IsInputErrorToAUser([&] { ReadLeftFile(folder_ / "left", "file", 1000); }));
  fs::permissions(folder_ / "left", fs::perms::owner_all);
  EXPECT_THROW(ReadLeftFile(folder_ / "none", "file", 1000), InputError);
  EXPECT_THROW(ReadLeftFile(folder_ / "left/file", "file", 1000), InputError);
}

TEST_F(FileTest, AFileInTheWayOfAFolderIsTheUsersMistake) {
  WriteFileAtomically(folder_ / "file", "text");
  EXPECT_THROW(WriteFileAtomically(folder_ / "file/x", ""), InputError);
  EXPECT_THROW(WriteFileAtomically(folder_ / std::string(5000, 'n') / "x", ""), InputError);
  EXPECT_THROW(ReadFile(std::string(5000, 'n')), InputError);
}

TEST_F(FileTest, TooManyOpenFilesAreTheMachinesTrouble) {
  WriteFileAtomically(folder_ / "file", "text");
  const std::function<void()> reads[] = {[&] { ReadFile(folder_ / "file"); },
                                         [&] { ReadLeftFile(folder_, "file", 1000); }};
  for (const auto& read : reads) {
    // Judged when there are descriptors again: UBSan needs a pipe to tell what an object is.
    std::exception_ptr thrown;
    try {
      const FewDescriptors none(0);
      read();
    } catch (...) {
      thrown = std::current_exception();
    }
    ASSERT_TRUE(thrown);
    EXPECT_THROW(std::rethrow_exception(thrown), MachineError);
    EXPECT_NO_THROW(read());
  }
}

TEST_F(FileTest, AFilesHashIsThatOfItsBytesHoweverManyTheyAre) {
  std::string bytes;
  for (int i = 0; i < 300'000; ++i) bytes += fmt::format("{} ", i * i % 9973);
  WriteFileAtomically(folder_ / "file", bytes);
  EXPECT_EQ(HashFile(folder_ / "file", 7), Hash(bytes, 7));
  WriteFileAtomically(folder_ / "empty", "");
  EXPECT_EQ(HashFile(folder_ / "empty", 7), Hash("", 7));
  WriteFileAtomically(folder_ / "weights", "");
  fs::resize_file(folder_ / "weights", (std::uintmax_t{1} << 30) + 1);  // more than is read at once
  EXPECT_NO_THROW(HashFile(folder_ / "weights"));
  EXPECT_THROW(HashFile(folder_ / "none"), InputError);
}

TEST_F(FileTest, AFoldersHashCountsWhatItsLinksLeadToAndCirclesEnd) {
  const fs::path left = folder_ / "left";
  WriteFileAtomically(left / "a/file", "1");
  WriteFileAtomically(folder_ / "weights/net.pt", "1");
  fs::create_directory_symlink(folder_ / "weights", left / "weights");
  fs::create_directory_symlink(left, left / "a/again");
  fs::create_directory_symlink(left, left / "b");
  fs::create_symlink("nowhere", left / "c");
  EXPECT_THAT(FilesBelow(left),
              testing::ElementsAre(left / "a/file", left / "c", left / "weights/net.pt"));
  const std::uint64_t before = HashFolder(left);
  EXPECT_EQ(HashFolder(left), before);
  WriteFileAtomically(folder_ / "weights/net.pt", "2");
  EXPECT_NE(HashFolder(left), before);
  EXPECT_EQ(HashFolder(folder_ / "none", 7), 7u);
}

TEST_F(FileTest, ALockIsHeldByOneAtATime) {
  std::optional<FileLock> first = FileLock::Try(folder_ / "lock");
  ASSERT_TRUE(first);
  EXPECT_FALSE(FileLock::Try(folder_ / "lock"));
  EXPECT_FALSE(FileLock::TryToRead(folder_ / "lock"));
  first.reset();
  EXPECT_TRUE(FileLock::Try(folder_ / "lock"));
}

TEST_F(FileTest, ManyReadTogetherAndKeepOutWhoWouldHoldItAlone) {
  EXPECT_TRUE(FileLock::TryToRead(folder_ / "none"));
  EXPECT_FALSE(fs::exists(folder_ / "none"));
  FileLock::Try(folder_ / "lock").reset();
  const std::optional<FileLock> one = FileLock::TryToRead(folder_ / "lock");
  EXPECT_TRUE(one);
  EXPECT_TRUE(FileLock::TryToRead(folder_ / "lock"));
  EXPECT_FALSE(FileLock::Try(folder_ / "lock"));
}

}  // namespace
}  // namespace aisle
