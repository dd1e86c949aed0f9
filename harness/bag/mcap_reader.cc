#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <list>
#include <mutex>

#include "harness/bag/bag.h"
#include "harness/bag/compression.h"
#include "harness/bag/mcap_records.h"
#include "harness/io/crc32.h"
#include "harness/io/descriptor.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

using mcap::Fields;
using mcap::Op;

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;
/// Unpacked; recorders make chunks of some megabytes, and a few bytes can claim any length.
constexpr std::uint64_t kMostChunk = 256 * kMiB;
constexpr std::uint64_t kMostKept = 256 * kMiB;  ///< of unpacked chunks, for the next reading
constexpr std::size_t kMostKeptChunks = 4;       ///< topics that are read side by side
/// Beyond these, 48 MiB of entries, a file has at most a message for each of its bytes: of what is
/// packed, a few bytes could claim to be any number. Stamps that differ take more than that.
constexpr std::uint64_t kFewMessages = std::uint64_t{1} << 20;
constexpr std::size_t kMessageHead = 22;  ///< channel, sequence, two stamps
constexpr std::size_t kStampBytes = 12;   ///< encapsulation, seconds, nanoseconds
/// Place of entries that stand in no chunk, or in one that is not compressed: their offset is the
/// file's. Else the place is the chunk's number.
constexpr std::uint64_t kInFile = ~std::uint64_t{0};

struct Head {
  Op op{};
  std::uint64_t size = 0;
};

Head HeadOf(std::string_view bytes) {
  Fields fields(bytes);
  const Op op = fields.Get<Op>();
  return {op, fields.Get<std::uint64_t>()};
}

/// A file by places, from any thread.
class RandomAccessFile {
 public:
  explicit RandomAccessFile(const std::filesystem::path& path) : path_(path) {
    file_ = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (::fstat(file_.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
      throw InputError(path.string(), 0, "not readable: no such file");
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
  }

  std::uint64_t size() const { return size_; }

  /// All of them, or InputError.
  std::string Read(std::uint64_t offset, std::uint64_t count) const {
    std::string bytes(offset <= size_ ? std::min(count, size_ - offset) : 0, '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t got = ::pread(file_.get(), bytes.data() + done, bytes.size() - done,
                                  static_cast<off_t>(offset + done));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      done += static_cast<std::size_t>(got);
    }
    if (done != count) throw InputError(path_.string(), 0, "not readable to its end");
    return bytes;
  }

 private:
  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
};

class McapFile : public Bag {
 public:
  explicit McapFile(const std::filesystem::path& path) : path_(path.string()), file_(path) {
    if (file_.size() < mcap::kMagic.size() || file_.Read(0, mcap::kMagic.size()) != mcap::kMagic) {
      throw InputError(path_, 0, "not an MCAP file");
    }
    try {
      Scan();
    } catch (const std::out_of_range&) {
      throw InputError(path_, 0, "damaged: a record is shorter than its own lengths state");
    }
    Name();
  }

  std::string Read(const BagEntry& entry) const override {
    if (entry.place == kInFile) return file_.Read(entry.offset, entry.size);
    return Chunk(entry.place)->substr(entry.offset, entry.size);
  }

 private:
  struct Packed {
    std::uint64_t offset, size, raw_size;  ///< of the packed records, in the file
    std::uint32_t crc;
    std::string method;
  };
  struct Channel {
    std::uint16_t schema = 0;
    BagChannel channel;
    std::size_t place = 0;
  };

  /// The records of the file one after the other: no index is needed, and none is believed.
  void Scan() {
    std::uint64_t at = mcap::kMagic.size();
    bool ended = false;
    while (!ended && at + mcap::kHeadBytes <= file_.size()) {
      const Head head = HeadOf(file_.Read(at, mcap::kHeadBytes));
      const std::uint64_t body = at + mcap::kHeadBytes;
      if (head.size > file_.size() - body) break;
      ended = head.op == Op::kDataEnd || head.op == Op::kFooter;
      ScanRecord(head, body);
      at = body + head.size;
    }
    if (!ended) {
      notes_.emplace_back(
          "it ends in the middle of a record, as if the recorder was killed: everything before "
          "that is read");
    }
  }

  void ScanRecord(const Head& head, std::uint64_t body) {
    if (head.op == Op::kChunk) return ScanChunk(body, head.size);
    if (head.op == Op::kMessage) {
      const std::uint64_t peek = std::min<std::uint64_t>(head.size, kMessageHead + kStampBytes);
      return AddMessage(file_.Read(body, peek), head.size, kInFile, body);
    }
    if (head.op == Op::kSchema || head.op == Op::kChannel || head.op == Op::kMetadata ||
        head.op == Op::kHeader) {
      if (head.size > kMostChunk) throw std::out_of_range("record");
      TakeRecord(head.op, file_.Read(body, head.size));
    }
  }

  void TakeRecord(Op op, std::string_view body) {
    Fields fields(body);
    if (op == Op::kHeader) {
      const std::string profile(fields.Text());
      if (profile != "ros2" && !profile.empty()) {
        throw InputError(
            path_, 0, fmt::format("unsupported profile '{}'; expected ros2", Printable(profile)));
      }
    } else if (op == Op::kSchema) {
      const auto id = fields.Get<std::uint16_t>();
      auto& [type, definition] = schemas_[id];
      type = fields.Text();
      fields.Text();  // encoding
      definition = fields.Text();
    } else if (op == Op::kChannel) {
      TakeChannel(&fields);
    } else if (op == Op::kMetadata) {
      const std::string name(fields.Text());
      metadata_[name] = fields.Map();
    }
  }

  void TakeChannel(Fields* fields) {
    const auto id = fields->Get<std::uint16_t>();
    if (by_id_.contains(id)) return;  // said again in each chunk
    Channel channel;
    channel.schema = fields->Get<std::uint16_t>();
    channel.channel.topic = fields->Text();
    const std::string encoding(fields->Text());
    if (encoding != "cdr") return;  // not ROS 2: its messages are skipped
    const auto values = fields->Map();
    const auto qos = values.find("offered_qos_profiles");
    if (qos != values.end()) channel.channel.qos = qos->second;
    channel.place = by_id_.size();
    by_id_.emplace(id, channel);
  }

  /// `bytes`: the message's body, or its beginning; `offset`: where the body stands in its place.
  void AddMessage(std::string_view bytes, std::uint64_t size, std::uint64_t place,
                  std::uint64_t offset) {
    Fields fields(bytes);
    const auto id = fields.Get<std::uint16_t>();
    fields.Get<std::uint32_t>();  // sequence
    const auto log_ns = fields.Get<std::uint64_t>();
    fields.Get<std::uint64_t>();  // published
    const auto channel = by_id_.find(id);
    if (channel == by_id_.end()) return;
    if (entries_.size() >= std::max(kFewMessages, file_.size())) {
      throw InputError(path_, 0,
                       fmt::format("has more than {} messages in {} bytes, which no recording with "
                                   "increasing stamps has; record it again",
                                   entries_.size(), file_.size()));
    }
    ++channel->second.channel.messages;
    entries_.push_back({.channel = channel->second.place,
                        .log_ns = static_cast<std::int64_t>(log_ns),
                        .header_ns = LeadingStampNs(fields.rest()),
                        .place = place,
                        .offset = offset + kMessageHead,
                        .size = size - kMessageHead});
  }

  void ScanChunk(std::uint64_t body, std::uint64_t size) {
    constexpr std::uint64_t kMostHead = 1024;
    Fields fields("");
    const std::string bytes = file_.Read(body, std::min(size, kMostHead));
    fields = Fields(bytes);
    fields.Get<std::uint64_t>();
    fields.Get<std::uint64_t>();
    Packed chunk{};
    chunk.raw_size = fields.Get<std::uint64_t>();
    chunk.crc = fields.Get<std::uint32_t>();
    chunk.method = fields.Text();
    chunk.size = fields.Get<std::uint64_t>();
    chunk.offset = body + (bytes.size() - fields.rest().size());
    if (chunk.size > size - (bytes.size() - fields.rest().size())) throw std::out_of_range("chunk");
    chunks_.push_back(chunk);
    // One without compression and checksum, as rosbag2 writes them, is read where it stands.
    if (chunk.method.empty() && chunk.crc == 0) return ScanInFile(chunk);
    if (chunk.raw_size > kMostChunk) {
      throw InputError(path_, 0,
                       fmt::format("chunk {} is {} MiB long when unpacked, at most {} are read; "
                                   "write it again with smaller chunks, as `mcap compress` does",
                                   chunks_.size() - 1, chunk.raw_size / kMiB, kMostChunk / kMiB));
    }
    const std::uint64_t number = chunks_.size() - 1;
    const auto records = Chunk(number);
    std::uint64_t at = 0;
    while (at + mcap::kHeadBytes <= records->size()) {
      const Head head = HeadOf(std::string_view(*records).substr(at));
      at += mcap::kHeadBytes;
      if (head.size > records->size() - at) throw std::out_of_range("record");
      const std::string_view record = std::string_view(*records).substr(at, head.size);
      if (head.op == Op::kMessage) {
        AddMessage(record, head.size, number, at);
      } else {
        TakeRecord(head.op, record);
      }
      at += head.size;
    }
  }

  void ScanInFile(const Packed& chunk) {
    std::uint64_t at = chunk.offset;
    const std::uint64_t end = chunk.offset + chunk.size;
    while (at + mcap::kHeadBytes <= end) {
      const Head head = HeadOf(file_.Read(at, mcap::kHeadBytes));
      at += mcap::kHeadBytes;
      if (head.size > end - at) throw std::out_of_range("record");
      if (head.op != Op::kChunk) ScanRecord(head, at);
      at += head.size;
    }
  }

  /// Forgets the chunks that were read longest ago, until one of this length has its place.
  void MakeRoom(std::uint64_t size) const {
    const auto is_full = [&] {
      std::uint64_t kept = size;
      for (const Kept& one : kept_) kept += one.records->size();
      return kept > kMostKept || kept_.size() >= kMostKeptChunks;
    };
    while (!kept_.empty() && is_full()) kept_.pop_back();
  }

  /// The records of a chunk, unpacked and checked; the latest few are kept.
  std::shared_ptr<const std::string> Chunk(std::uint64_t number) const {
    const std::lock_guard lock(mutex_);
    const auto kept = std::ranges::find(kept_, number, &Kept::number);
    if (kept != kept_.end()) {
      kept_.splice(kept_.begin(), kept_, kept);
      return kept_.front().records;
    }
    const Packed& chunk = chunks_.at(number);
    MakeRoom(chunk.raw_size);  // before it is there, not after
    std::shared_ptr<const std::string> records;
    try {
      records = std::make_shared<const std::string>(
          Decompress(file_.Read(chunk.offset, chunk.size), chunk.method, chunk.raw_size));
    } catch (const CompressionError& error) {
      throw InputError(path_, 0, fmt::format("damaged: chunk {} {}", number, error.what()));
    }
    if (chunk.crc != 0 && Crc32(*records) != chunk.crc) {
      throw InputError(path_, 0,
                       fmt::format("damaged: the checksum of chunk {} does not match; copy the "
                                   "file again, or `mcap recover` it",
                                   number));
    }
    kept_.push_front({number, records});
    return records;
  }

  void Name() {
    channels_.resize(by_id_.size());
    for (auto& [id, channel] : by_id_) {
      const auto schema = schemas_.find(channel.schema);
      if (schema != schemas_.end()) {
        channel.channel.type = schema->second.first;
        channel.channel.definition = schema->second.second;
      }
      channels_[channel.place] = channel.channel;
    }
  }

  struct Kept {
    std::uint64_t number;
    std::shared_ptr<const std::string> records;
  };

  const std::string path_;
  const RandomAccessFile file_;
  std::map<std::uint16_t, std::pair<std::string, std::string>> schemas_;
  std::map<std::uint16_t, Channel> by_id_;
  std::vector<Packed> chunks_;
  mutable std::mutex mutex_;      ///< guards kept_
  mutable std::list<Kept> kept_;  ///< latest first
};

}  // namespace

std::unique_ptr<Bag> OpenMcap(const std::filesystem::path& file) {
  return std::make_unique<McapFile>(file);
}

std::int64_t LeadingStampNs(std::string_view message) {
  if (message.size() < kStampBytes) return 0;
  std::uint32_t seconds = 0, nanoseconds = 0;
  std::memcpy(&seconds, message.data() + 4, 4);
  std::memcpy(&nanoseconds, message.data() + 8, 4);
  if (message[1] == 0) {  // big endian
    seconds = __builtin_bswap32(seconds);
    nanoseconds = __builtin_bswap32(nanoseconds);
  }
  constexpr std::int64_t kSecond = 1'000'000'000;
  return static_cast<std::int32_t>(seconds) * kSecond + nanoseconds;
}

}  // namespace aisle
