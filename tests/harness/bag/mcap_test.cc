#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <sqlite3.h>

#include <fstream>

#include "harness/bag/bag.h"
#include "harness/bag/compression.h"
#include "harness/bag/mcap_records.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/ros/geometry.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::int64_t kStart = 1'600'000'000'000'000'000;

ros::PoseStamped PoseAt(int k) {
  ros::PoseStamped pose;
  pose.header.stamp = ros::TimeOf(kStart + k);
  pose.header.frame_id = "map";
  pose.pose.position.x = k;
  return pose;
}

class McapTest : public testing::Test {
 protected:
  McapTest() : folder_(fs::temp_directory_path() / fmt::format("aisle_mcap_{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~McapTest() override { fs::remove_all(folder_); }

  /// 200 poses on /a and 100 texts on /b.
  fs::path Write(const McapOptions& options) const {
    const fs::path file = folder_ / "x.mcap";
    McapWriter writer(file, options);
    const auto a = writer.AddChannel<ros::PoseStamped>("/a");
    const auto b = writer.AddChannel<ros::String>("/b", TopicKind::kLatched);
    for (int k = 0; k < 200; ++k) {
      writer.Write(a, kStart + k, PoseAt(k));
      ros::String text;
      text.data = fmt::format("text {}", k);
      if (k % 2 == 0) writer.Write(b, kStart + k, text);
    }
    writer.AddMetadata("scores", {{"ate_rmse_m", "0.01"}});
    writer.Attach("scene.yaml", "application/yaml", kStart, "frames: 3\n");
    writer.Finish();
    EXPECT_EQ(writer.messages(), 300u);
    return file;
  }

  fs::path Put(const std::string& bytes) const {
    const fs::path file = folder_ / "changed.mcap";
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  static std::string WhyNot(const fs::path& file) {
    try {
      const auto bag = OpenBag(file);
      for (const BagEntry& entry : bag->entries()) bag->Read(entry);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_;
};

void ExpectWhole(const Bag& bag, std::size_t poses = 200) {
  ASSERT_EQ(bag.channels().size(), 2u);
  EXPECT_EQ(bag.channels()[0].topic, "/a");
  EXPECT_EQ(bag.channels()[0].type, "geometry_msgs/msg/PoseStamped");
  EXPECT_EQ(bag.channels()[0].messages, poses);
  int k = 0;
  for (const BagEntry& entry : bag.entries()) {
    if (entry.channel != 0) continue;
    EXPECT_EQ(entry.log_ns, kStart + k);
    EXPECT_EQ(entry.header_ns, kStart + k);
    EXPECT_EQ(ros::Deserialize<ros::PoseStamped>(bag.Read(entry)).pose.position.x, k);
    ++k;
  }
}

TEST_F(McapTest, WhatIsWrittenIsRead) {
  for (const McapOptions& options : {McapOptions{}, McapOptions{.chunk_bytes = 1, .zstd_level = 0},
                                     McapOptions{.chunk_bytes = 1000, .zstd_level = 3}}) {
    const auto bag = OpenBag(Write(options));
    ExpectWhole(*bag);
    EXPECT_EQ(bag->entries().size(), 300u);
    EXPECT_EQ(bag->metadata().at("scores").at("ate_rmse_m"), "0.01");
    EXPECT_TRUE(bag->notes().empty());
    EXPECT_THAT(bag->channels()[1].qos, HasSubstr("durability: 1"));
    EXPECT_THAT(bag->channels()[0].definition, HasSubstr("MSG: geometry_msgs/Pose\n"));
  }
}

TEST_F(McapTest, SameMessagesSameBytes) {
  const std::string once = ReadFile(Write({}));
  EXPECT_EQ(ReadFile(Write({})), once);
}

TEST_F(McapTest, ACutFileGivesWhatCameBefore) {
  const std::string bytes = ReadFile(Write({.chunk_bytes = 1000, .zstd_level = 0}));
  const auto bag = OpenBag(Put(bytes.substr(0, bytes.size() / 2)));
  EXPECT_GT(bag->entries().size(), 50u);
  EXPECT_LT(bag->entries().size(), 250u);
  ASSERT_EQ(bag->notes().size(), 1u);
  EXPECT_THAT(bag->notes()[0], HasSubstr("ends in the middle"));
}

TEST_F(McapTest, DamageIsSeen) {
  std::string bytes = ReadFile(Write({.chunk_bytes = 1 << 20, .zstd_level = 0}));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  EXPECT_THAT(WhyNot(Put(bytes)), HasSubstr("checksum"));
  EXPECT_THAT(WhyNot(Put("no bag")), HasSubstr("not an MCAP file"));
  EXPECT_THAT(WhyNot(folder_ / "none.mcap"), HasSubstr("no such file"));
}

/// A chunk as another recorder may write it: without a checksum.
std::string ChunkRecord(std::uint64_t raw_size, const std::string& method,
                        const std::string& records) {
  std::string body;
  mcap::Put(std::uint64_t{0}, &body);
  mcap::Put(std::uint64_t{0}, &body);
  mcap::Put(raw_size, &body);
  mcap::Put(std::uint32_t{0}, &body);
  mcap::PutText(method, &body);
  mcap::Put(static_cast<std::uint64_t>(records.size()), &body);
  std::string record;
  mcap::PutRecord(mcap::Op::kChunk, body + records, &record);
  return record;
}

std::string OpeningWithChannelOne() {
  std::string bytes(mcap::kMagic), channel;
  mcap::Put(std::uint16_t{1}, &channel);
  mcap::Put(std::uint16_t{0}, &channel);
  mcap::PutText("/a", &channel);
  mcap::PutText("cdr", &channel);
  mcap::PutMap({}, &channel);
  mcap::PutRecord(mcap::Op::kChannel, channel, &bytes);
  return bytes;
}

TEST_F(McapTest, AChunkThatClaimsMuchMemoryIsNamed) {
  const auto claiming = [&](std::uint64_t size) {
    return WhyNot(
        Put(std::string(mcap::kMagic) + ChunkRecord(size, "zstd", std::string(1 << 16, 'x'))));
  };
  const std::uint64_t most = std::uint64_t{256} << 20;
  EXPECT_THAT(claiming(2 * most), testing::AllOf(HasSubstr("chunk 0 is 512 MiB long"),
                                                 HasSubstr("at most 256"), HasSubstr("mcap")));
  EXPECT_THAT(claiming(~std::uint64_t{0}), HasSubstr("at most 256"));
  EXPECT_THAT(claiming(most), HasSubstr("damaged")) << "allowed, but these are no records";
}

/// Chunks of which the reader may keep one alone, read to and fro.
TEST_F(McapTest, LargeChunksAreReadAgainWhenTheyAreAskedForAgain) {
  const std::size_t size = std::size_t{130} << 20;
  std::string bytes = OpeningWithChannelOne();
  for (const char letter : {'a', 'b'}) {
    std::string message, records;
    mcap::Put(std::uint16_t{1}, &message);
    message.append(4 + 8 + 8, '\0');  // sequence, two stamps
    message.append(100, letter);
    mcap::PutRecord(mcap::Op::kMessage, message, &records);
    const std::size_t rest = size - records.size() - mcap::kHeadBytes;
    mcap::PutRecord(mcap::Op::kMessageIndex, std::string(rest, '\0'), &records);
    bytes += ChunkRecord(records.size(), "zstd", CompressZstd(records, 1));
  }
  mcap::PutRecord(mcap::Op::kDataEnd, std::string(4, '\0'), &bytes);
  const auto bag = OpenBag(Put(bytes));
  ASSERT_EQ(bag->entries().size(), 2u);
  for (const std::size_t i : {0u, 1u, 0u, 1u}) {
    EXPECT_EQ(bag->Read(bag->entries()[i]), std::string(100, i == 0 ? 'a' : 'b'));
  }
}

/// Messages without a byte of content, each a step later than the one before.
std::string EmptyMessages(std::uint64_t count, std::uint64_t step_ns) {
  std::string message, records;
  for (std::uint64_t k = 0; k < count; ++k) {
    message.clear();
    mcap::Put(std::uint16_t{1}, &message);
    mcap::Put(std::uint32_t{0}, &message);  // sequence
    for (int stamp = 0; stamp < 2; ++stamp) mcap::Put(kStart + k * step_ns, &message);
    mcap::PutRecord(mcap::Op::kMessage, message, &records);
  }
  return records;
}

TEST_F(McapTest, AFileOfFewBytesHasNoMillionsOfMessages) {
  constexpr std::uint64_t kMany = (std::uint64_t{1} << 20) + 1;
  const auto file_of = [&](std::uint64_t count, std::uint64_t step_ns) {
    const std::string records = EmptyMessages(count, step_ns);
    std::string bytes =
        OpeningWithChannelOne() + ChunkRecord(records.size(), "zstd", CompressZstd(records, 3));
    mcap::PutRecord(mcap::Op::kDataEnd, std::string(4, '\0'), &bytes);
    return Put(bytes);
  };
  EXPECT_THAT(WhyNot(file_of(kMany, 0)), HasSubstr("has more than 1048576 messages in "));
  EXPECT_EQ(OpenBag(file_of(kMany - 1, 0))->entries().size(), kMany - 1);
  EXPECT_EQ(OpenBag(file_of(kMany, 1'000'000))->entries().size(), kMany) << "a recording";
}

TEST_F(McapTest, Lz4FramesAreRead) {
  const std::string text(1000, 'a');
  std::string packed(LZ4F_compressFrameBound(text.size(), nullptr), '\0');
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), text.data(), text.size(), nullptr));
  EXPECT_EQ(Decompress(packed, "lz4", text.size()), text);
  EXPECT_THROW(Decompress(packed, "lz4", text.size() + 1), CompressionError);
  EXPECT_THROW(Decompress(packed, "lz4", text.size() - 1), CompressionError);
  EXPECT_THROW(Decompress(packed.substr(0, 9), "lz4", text.size()), CompressionError);
  EXPECT_THROW(Decompress("x", "lzma", 1), CompressionError);
}

/// Writes poses as rosbag2 does into SQLite.
class SqliteRecorder {
 public:
  SqliteRecorder(const fs::path& file, const std::string& pragmas) {
    EXPECT_EQ(sqlite3_open(file.c_str(), &database_), SQLITE_OK);
    Run(pragmas);
    Run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, "
        "serialization_format TEXT, offered_qos_profiles TEXT);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
        "data BLOB);"
        "INSERT INTO topics VALUES(7, '/a', 'geometry_msgs/msg/PoseStamped', 'cdr', '');"
        "INSERT INTO topics VALUES(8, '/b', 'std_msgs/msg/String', 'cdr', '')");
  }
  ~SqliteRecorder() { sqlite3_close(database_); }
  SqliteRecorder(const SqliteRecorder&) = delete;
  SqliteRecorder& operator=(const SqliteRecorder&) = delete;

  void Run(const std::string& text) {
    sqlite3_exec(database_, text.c_str(), nullptr, nullptr, nullptr);
  }
  void Add(int k, const std::string& bytes) {
    sqlite3_stmt* insert = nullptr;
    sqlite3_prepare_v2(database_, "INSERT INTO messages(topic_id, timestamp, data) VALUES(7, ?, ?)",
                       -1, &insert, nullptr);
    sqlite3_bind_int64(insert, 1, kStart + k);
    sqlite3_bind_blob(insert, 2, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
    EXPECT_EQ(sqlite3_step(insert), SQLITE_DONE);
    sqlite3_finalize(insert);
  }
  void AddPoses(int from, int to) {
    for (int k = from; k < to; ++k) Add(k, ros::Serialize(PoseAt(k)));
  }

 private:
  sqlite3* database_ = nullptr;
};

/// Every file of a folder, with its bytes.
std::map<fs::path, std::string> FilesIn(const fs::path& folder) {
  std::map<fs::path, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) files[entry] = ReadFile(entry.path());
  return files;
}

/// The files of a bag as they stand, in a folder of their own: what a killed recorder leaves.
fs::path Left(const fs::path& file, const fs::path& folder,
              const std::vector<std::string>& endings) {
  fs::create_directories(folder);
  for (const std::string& ending : endings) {
    fs::copy_file(file.string() + ending, folder / (file.filename().string() + ending));
  }
  return folder / file.filename();
}

TEST_F(McapTest, ASqliteBagIsRead) {
  const fs::path file = folder_ / "old bag?.db3";
  {
    SqliteRecorder recorder(file, "");
    for (int k = 9; k >= 0; --k) {  // not in the order of time
      const std::string bytes = ros::Serialize(PoseAt(k));
      // As compression mode `message` does.
      recorder.Add(k, k % 2 == 0 ? CompressZstd(bytes, 1) : bytes);
    }
  }
  const auto before = FilesIn(folder_);
  const auto bag = OpenBag(file);
  ExpectWhole(*bag, 10);
  EXPECT_TRUE(bag->notes().empty());
  EXPECT_EQ(FilesIn(folder_), before);
  std::ofstream(folder_ / "no.db3") << "no bag";
  EXPECT_THAT(WhyNot(folder_ / "no.db3"), HasSubstr("not a ROS 2 bag"));
}

/// rosbag2 writes through a log where it shall be robust: what is in the log alone is in the bag.
TEST_F(McapTest, TheLogOfAKilledRecorderIsRead) {
  for (const char* checkpoint : {"0", "10"}) {  // all in the log, and some
    const fs::path file = folder_ / fmt::format("every {}.db3", checkpoint);
    SqliteRecorder recorder(file, fmt::format("PRAGMA journal_mode = WAL; PRAGMA synchronous = "
                                              "NORMAL; PRAGMA wal_autocheckpoint = {}",
                                              checkpoint));
    recorder.AddPoses(0, 200);
    for (const bool with_index : {true, false}) {
      const fs::path folder = folder_ / fmt::format("killed {} {}", checkpoint, with_index);
      const fs::path left = Left(file, folder,
                                 with_index ? std::vector<std::string>{"", "-wal", "-shm"}
                                            : std::vector<std::string>{"", "-wal"});
      const auto before = FilesIn(folder);
      fs::permissions(folder, fs::perms::owner_write, fs::perm_options::remove);
      {
        const auto bag = OpenBag(left), again = OpenBag(left);
        ExpectWhole(*bag);
        ExpectWhole(*again);
        ASSERT_EQ(bag->notes().size(), 1u);
        EXPECT_THAT(bag->notes()[0], HasSubstr("-wal"));
      }
      fs::permissions(folder, fs::perms::owner_write, fs::perm_options::add);
      EXPECT_EQ(FilesIn(folder), before) << "nothing is written, nothing taken away";
    }
  }
}

TEST_F(McapTest, ABagThatIsStillRecordedIsReadAsItWas) {
  const fs::path file = folder_ / "live.db3";
  SqliteRecorder recorder(file, "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 10");
  recorder.AddPoses(0, 200);
  const auto bag = OpenBag(file);
  recorder.Run("DELETE FROM messages");
  recorder.AddPoses(200, 400);
  ExpectWhole(*bag);
}

TEST_F(McapTest, AChangeThatWasCutOffIsNamedWithItsCure) {
  const fs::path file = folder_ / "changed.db3";
  SqliteRecorder recorder(file, "PRAGMA cache_size = 1");
  recorder.AddPoses(0, 200);
  recorder.Run("BEGIN; UPDATE messages SET data = zeroblob(3000)");
  const fs::path left = Left(file, folder_ / "cut", {"", "-journal"});
  const auto before = FilesIn(left.parent_path());
  EXPECT_THAT(WhyNot(left), HasSubstr("PRAGMA quick_check"));
  EXPECT_EQ(FilesIn(left.parent_path()), before);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(left.c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "PRAGMA quick_check", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  ExpectWhole(*OpenBag(left));
}

}  // namespace
}  // namespace aisle
