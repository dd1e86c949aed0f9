#include <sqlite3.h>

#include <mutex>

#include "harness/bag/bag.h"
#include "harness/bag/compression.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr std::size_t kMostMessage = std::size_t{1} << 30;

/// What its recorder left beside a bag, of these bytes; 0 where there is nothing.
std::uintmax_t BytesBeside(const std::filesystem::path& file, const char* ending) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file.string() + ending, error);
  return error ? 0 : bytes;
}

/// How a bag is opened so that all that was recorded is there and nothing is written beside it.
struct Opening {
  const char* parameters;  ///< of SQLite's URI
  const char* first = "";  ///< said before anything is read
  bool has_log = false;    ///< the newest messages are in FILE-wal
};

Opening OpeningOf(const std::filesystem::path& file) {
  if (BytesBeside(file, "-wal") > 0) {
    // FILE-shm is the log's index and its locks: where there is one, a recorder may be at work, and
    // is heeded. Where there is none SQLite would make one; without locks it has it in memory.
    if (BytesBeside(file, "-shm") > 0) return {"mode=ro&readonly_shm=1", "", true};
    return {"mode=ro&vfs=unix-none", "PRAGMA locking_mode = EXCLUSIVE", true};
  }
  if (BytesBeside(file, "-journal") > 0) return {"mode=ro"};
  return {"immutable=1"};  // no log, no lock
}

/// The path as SQLite's URIs want it.
std::string UriOf(const std::filesystem::path& file, const char* parameters) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) || c == '/' || c == '.' || c == '-' || c == '_';
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return fmt::format("{}?{}", uri, parameters);
}

/// SQLite's sentence; where it takes a change back that was cut off, the cure.
std::string WhyUnreadable(sqlite3* database, const std::string& sentence, const std::string& file) {
  if (sqlite3_extended_errcode(database) != SQLITE_READONLY_ROLLBACK) {
    return fmt::format("not a ROS 2 bag, or a damaged one: {}", sentence);
  }
  return fmt::format(
      "was cut off in the middle of a change that {}-journal reverts: run `sqlite3 '{}' 'PRAGMA "
      "quick_check'` first",
      std::filesystem::path(file).filename().string(), file);
}

class Statement {
 public:
  Statement(sqlite3* database, const char* text) {
    if (sqlite3_prepare_v2(database, text, -1, &statement_, nullptr) != SQLITE_OK) {
      throw CompressionError(sqlite3_errmsg(database));
    }
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// False at the end.
  bool Step() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) {
      throw CompressionError(sqlite3_errmsg(sqlite3_db_handle(statement_)));
    }
    return code == SQLITE_ROW;
  }
  std::int64_t Integer(int column) const { return sqlite3_column_int64(statement_, column); }
  std::string Bytes(int column) const {
    const void* bytes = sqlite3_column_blob(statement_, column);
    const int size = sqlite3_column_bytes(statement_, column);
    return size > 0 ? std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size))
                    : std::string();
  }
  void Bind(std::int64_t value) {
    sqlite3_reset(statement_);
    sqlite3_bind_int64(statement_, 1, value);
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
};

class Db3File : public Bag {
 public:
  explicit Db3File(const std::filesystem::path& path) : path_(path.string()) {
    const Opening opening = OpeningOf(path);
    sqlite3* database = nullptr;
    const int code = sqlite3_open_v2(UriOf(path, opening.parameters).c_str(), &database,
                                     SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(database);
    if (code != SQLITE_OK) throw InputError(path_, 0, "not readable as an SQLite file");
    // Else the last one to close would write the log into the file, and take it away.
    sqlite3_db_config(database, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    try {
      Run(opening.first);
      Run("BEGIN");  // what is read is one state of the file, to the end
      ReadTopics();
      ReadEntries();
    } catch (const CompressionError& error) {
      throw InputError(path_, 0, WhyUnreadable(database, error.what(), path_));
    }
    if (opening.has_log) {
      notes_.push_back(fmt::format(
          "was not closed by its recorder: its last messages are read from {}-wal beside it",
          path.filename().string()));
    }
  }

  std::string Read(const BagEntry& entry) const override {
    const std::lock_guard lock(mutex_);
    try {
      Statement get(database_.get(), "SELECT data FROM messages WHERE id = ?");
      get.Bind(static_cast<std::int64_t>(entry.place));
      if (!get.Step()) throw InputError(path_, 0, "lost a message while it was read");
      return Unpacked(get.Bytes(0));
    } catch (const CompressionError& error) {
      throw InputError(path_, 0, fmt::format("has a damaged message: {}", error.what()));
    }
  }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };

  /// Bags of compression mode `message` hold a zstd frame each; CDR never opens like one.
  static std::string Unpacked(std::string bytes) {
    return IsZstd(bytes) ? DecompressZstdFrame(bytes, kMostMessage) : bytes;
  }

  void Run(const char* text) {
    if (sqlite3_exec(database_.get(), text, nullptr, nullptr, nullptr) != SQLITE_OK) {
      throw CompressionError(sqlite3_errmsg(database_.get()));
    }
  }

  void ReadTopics() {
    Statement topics(database_.get(),
                     "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
    while (topics.Step()) {
      if (topics.Bytes(3) != "cdr") continue;
      place_of_[topics.Integer(0)] = channels_.size();
      channels_.push_back({.topic = topics.Bytes(1), .type = topics.Bytes(2), .definition = {}});
    }
  }

  void ReadEntries() {
    // A message's beginning alone says its stamp, unless it is compressed.
    Statement all(database_.get(),
                  "SELECT id, topic_id, timestamp, length(data), substr(data, 1, 12) "
                  "FROM messages ORDER BY timestamp, id");
    Statement whole(database_.get(), "SELECT data FROM messages WHERE id = ?");
    while (all.Step()) {
      const auto place = place_of_.find(all.Integer(1));
      if (place == place_of_.end()) continue;
      std::string head = all.Bytes(4);
      if (IsZstd(head)) {
        whole.Bind(all.Integer(0));
        if (whole.Step()) head = Unpacked(whole.Bytes(0));
      }
      ++channels_[place->second].messages;
      entries_.push_back({.channel = place->second,
                          .log_ns = all.Integer(2),
                          .header_ns = LeadingStampNs(head),
                          .place = static_cast<std::uint64_t>(all.Integer(0)),
                          .offset = 0,
                          .size = static_cast<std::uint64_t>(all.Integer(3))});
    }
  }

  const std::string path_;
  std::unique_ptr<sqlite3, Close> database_;
  std::map<std::int64_t, std::size_t> place_of_;
  mutable std::mutex mutex_;  ///< guards the connection
};

}  // namespace

std::unique_ptr<Bag> OpenDb3(const std::filesystem::path& file) {
  return std::make_unique<Db3File>(file);
}

}  // namespace aisle
