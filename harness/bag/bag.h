#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/bag/mcap_writer.h"

namespace aisle {

/// One message, without its bytes.
struct BagEntry {
  std::size_t channel = 0;  ///< place in channels()
  std::int64_t log_ns = 0;  ///< when it was recorded
  /// The stamp its bytes open with, where its type opens with a header; else meaningless. Pairs are
  /// made by this: messages of one instant are recorded at different times.
  std::int64_t header_ns = 0;
  std::uint64_t place = 0, offset = 0, size = 0;  ///< where it is, for Read
};

/// A bag that is read: MCAP, or SQLite as ROS 2 up to Humble writes it. What is in it is known at
/// once; the messages are fetched one by one.
class Bag {
 public:
  virtual ~Bag() = default;
  /// In the order of the bag; `definition` may be empty.
  const std::vector<BagChannel>& channels() const { return channels_; }
  /// In the order in which they are stored: mostly that of log_ns.
  const std::vector<BagEntry>& entries() const { return entries_; }
  /// What a reader should know: that the file ends in the middle of a record, say.
  const std::vector<std::string>& notes() const { return notes_; }
  const std::map<std::string, std::map<std::string, std::string>>& metadata() const {
    return metadata_;
  }

  /// The message's bytes; from any thread. Throws InputError.
  virtual std::string Read(const BagEntry& entry) const = 0;

 protected:
  std::vector<BagChannel> channels_;
  std::vector<BagEntry> entries_;
  std::vector<std::string> notes_;
  std::map<std::string, std::map<std::string, std::string>> metadata_;
};

/// True for a file that is read as a bag, by its name: *.mcap, *.db3.
bool IsBagFile(const std::filesystem::path& path);

/// A file, or the folder that `ros2 bag record` makes around a single one. Throws InputError: not
/// there, no bag, damaged, or of a kind that is not read, each with its cure.
std::unique_ptr<Bag> OpenBag(const std::filesystem::path& path);

std::unique_ptr<Bag> OpenMcap(const std::filesystem::path& file);
std::unique_ptr<Bag> OpenDb3(const std::filesystem::path& file);

/// The stamp of bytes that open with a header; 0 where they are too short.
std::int64_t LeadingStampNs(std::string_view message);

}  // namespace aisle
