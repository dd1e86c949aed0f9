#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/bag/mcap_records.h"
#include "harness/io/file.h"
#include "harness/ros/definition.h"

namespace aisle {

/// How long a topic's messages stay with who comes late, as rosbag2 replays them.
enum class TopicKind {
  kStream,   ///< what comes after the subscription
  kLatched,  ///< the latest stays: /tf_static, maps, paths
};

struct McapOptions {
  std::size_t chunk_bytes = std::size_t{4} << 20;  ///< uncompressed; a larger message stands alone
  int zstd_level = 1;  ///< 0: not compressed. Grey noise hardly shrinks, masks and depth do.
};

/// What a topic's messages are, as bags record it.
struct BagChannel {
  std::string topic, type, definition;  ///< type as "sensor_msgs/msg/Image"
  std::string qos = {};                 ///< rosbag2's YAML text
  std::uint64_t messages = 0;
};

/// Writes an MCAP file of ROS 2 messages: profile ros2, CDR, definitions in ros2msg, chunks with
/// CRCs and indexes, a summary. It grows aside and gets its name by Finish. Not thread-safe.
class McapWriter {
 public:
  using ChannelId = std::uint16_t;

  /// Throws as FileAside does.
  explicit McapWriter(const std::filesystem::path& path, const McapOptions& options = {});

  /// A topic has one type; the same topic again is the same channel.
  template <ros::Message T>
  ChannelId AddChannel(const std::string& topic, TopicKind kind = TopicKind::kStream) {
    return AddChannel(topic, ros::FullTypeName(T::kType), ros::DefinitionOf<T>(), kind);
  }
  ChannelId AddChannel(const std::string& topic, const std::string& type,
                       const std::string& definition, TopicKind kind);
  ChannelId AddChannel(const BagChannel& channel);

  /// Stamps in nanoseconds, not negative; in any order, though readers like them to rise.
  void Write(ChannelId channel, std::int64_t stamp_ns, std::string_view message);
  template <ros::Message T>
  void Write(ChannelId channel, std::int64_t stamp_ns, const T& message) {
    Write(channel, stamp_ns, ros::Serialize(message));
  }

  /// A file that goes along.
  void Attach(const std::string& name, const std::string& media_type, std::int64_t stamp_ns,
              std::string_view bytes);
  void AddMetadata(const std::string& name, const std::map<std::string, std::string>& values);

  /// Closes the file and names it. Nothing may be written after.
  void Finish();

  const std::vector<BagChannel>& channels() const { return channels_; }  ///< id: place + 1
  std::uint64_t messages() const { return messages_; }
  std::int64_t first_ns() const { return messages_ > 0 ? first_ns_ : 0; }
  std::int64_t last_ns() const { return last_ns_; }

 private:
  struct Entry {
    std::uint64_t stamp_ns, offset;
  };
  void PutDeclaration(ChannelId channel, std::string* to) const;
  void PutSchema(ChannelId channel, std::string* to) const;
  void EndChunk();
  void AppendRecord(mcap::Op op, std::string_view body);
  std::string Summary(std::uint64_t start) const;

  const McapOptions options_;
  FileAside file_;
  std::uint32_t crc_ = 0;  ///< of all that is in the file
  std::vector<BagChannel> channels_;
  std::vector<bool> declared_;
  std::uint64_t messages_ = 0;
  std::int64_t first_ns_ = 0, last_ns_ = 0;

  std::string chunk_;  ///< records of the chunk that is being filled
  std::uint64_t chunk_first_ns_ = 0, chunk_last_ns_ = 0;
  std::map<ChannelId, std::vector<Entry>> chunk_index_;

  std::string chunk_indexes_, attachment_indexes_, metadata_indexes_;  ///< records of the summary
  std::uint32_t chunks_ = 0, attachments_ = 0, metadata_ = 0;
};

}  // namespace aisle
