#include "harness/bag/mcap_writer.h"

#include "harness/bag/compression.h"
#include "harness/io/crc32.h"

namespace aisle {
namespace {

using mcap::Op;
using mcap::Put;
using mcap::PutMap;
using mcap::PutRecord;
using mcap::PutText;

/// As numbers: Humble reads nothing else, and those after it still do.
std::string QosOf(TopicKind kind) {
  return fmt::format(
      "- history: 1\n  depth: {}\n  reliability: 1\n  durability: {}\n"
      "  deadline:\n    sec: 0\n    nsec: 0\n  lifespan:\n    sec: 0\n    nsec: 0\n"
      "  liveliness: 1\n  liveliness_lease_duration:\n    sec: 0\n    nsec: 0\n"
      "  avoid_ros_namespace_conventions: false\n",
      kind == TopicKind::kLatched ? 1 : 10, kind == TopicKind::kLatched ? 1 : 2);
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path, const McapOptions& options)
    : options_(options), file_(path) {
  file_.Append(mcap::kMagic);
  crc_ = Crc32(mcap::kMagic);
  std::string header;
  PutText("ros2", &header);
  PutText("aisle", &header);
  AppendRecord(Op::kHeader, header);
}

McapWriter::ChannelId McapWriter::AddChannel(const std::string& topic, const std::string& type,
                                             const std::string& definition, TopicKind kind) {
  return AddChannel({.topic = topic, .type = type, .definition = definition, .qos = QosOf(kind)});
}

McapWriter::ChannelId McapWriter::AddChannel(const BagChannel& channel) {
  const auto known = std::ranges::find(channels_, channel.topic, &BagChannel::topic);
  if (known != channels_.end()) {
    if (known->type != channel.type) {
      throw std::invalid_argument(
          fmt::format("topic {} is of {} already", channel.topic, known->type));
    }
    return static_cast<ChannelId>(known - channels_.begin() + 1);
  }
  channels_.push_back(channel);
  channels_.back().messages = 0;
  declared_.push_back(false);
  return static_cast<ChannelId>(channels_.size());
}

/// A schema has the id of the first channel of its type.
void McapWriter::PutSchema(ChannelId channel, std::string* to) const {
  const BagChannel& of = channels_[channel - 1u];
  std::string body;
  Put(channel, &body);
  PutText(of.type, &body);
  PutText("ros2msg", &body);
  PutText(of.definition, &body);
  PutRecord(Op::kSchema, body, to);
}

void McapWriter::PutDeclaration(ChannelId channel, std::string* to) const {
  const BagChannel& of = channels_[channel - 1u];
  const auto first = std::ranges::find(channels_, of.type, &BagChannel::type) - channels_.begin();
  std::string body;
  Put(channel, &body);
  Put(static_cast<ChannelId>(first + 1), &body);
  PutText(of.topic, &body);
  PutText("cdr", &body);
  PutMap({{"offered_qos_profiles", of.qos}}, &body);
  PutRecord(Op::kChannel, body, to);
}

void McapWriter::Write(ChannelId channel, std::int64_t stamp_ns, std::string_view message) {
  if (stamp_ns < 0) throw std::invalid_argument("a stamp of a bag is not negative");
  BagChannel& of = channels_.at(channel - 1u);
  if (!declared_[channel - 1u]) {
    const auto first = std::ranges::find(channels_, of.type, &BagChannel::type) - channels_.begin();
    PutSchema(static_cast<ChannelId>(first + 1), &chunk_);
    PutDeclaration(channel, &chunk_);
    declared_[channel - 1u] = true;
  }
  const auto stamp = static_cast<std::uint64_t>(stamp_ns);
  chunk_first_ns_ = chunk_index_.empty() ? stamp : std::min(chunk_first_ns_, stamp);
  chunk_last_ns_ = chunk_index_.empty() ? stamp : std::max(chunk_last_ns_, stamp);
  chunk_index_[channel].push_back({stamp, chunk_.size()});
  constexpr std::size_t kFixed = 22;  // channel, sequence, two stamps
  Put(Op::kMessage, &chunk_);
  Put(static_cast<std::uint64_t>(kFixed + message.size()), &chunk_);
  Put(channel, &chunk_);
  Put(static_cast<std::uint32_t>(of.messages), &chunk_);
  Put(stamp, &chunk_);
  Put(stamp, &chunk_);
  chunk_.append(message);
  first_ns_ = messages_ == 0 ? stamp_ns : std::min(first_ns_, stamp_ns);
  last_ns_ = messages_ == 0 ? stamp_ns : std::max(last_ns_, stamp_ns);
  ++of.messages;
  ++messages_;
  if (chunk_.size() >= options_.chunk_bytes) EndChunk();
}

void McapWriter::AppendRecord(Op op, std::string_view body) {
  std::string head;
  Put(op, &head);
  Put(static_cast<std::uint64_t>(body.size()), &head);
  crc_ = Crc32(body, Crc32(head, crc_));
  file_.Append(head);
  file_.Append(body);
}

void McapWriter::EndChunk() {
  if (chunk_index_.empty()) return;
  const bool packs = options_.zstd_level > 0;
  const std::string packed = packs ? CompressZstd(chunk_, options_.zstd_level) : std::string();
  const bool worth_it = packs && packed.size() < chunk_.size();
  const std::string_view records = worth_it ? packed : chunk_;
  const std::string method = worth_it ? "zstd" : "";
  std::string body;
  Put(chunk_first_ns_, &body);
  Put(chunk_last_ns_, &body);
  Put(static_cast<std::uint64_t>(chunk_.size()), &body);
  Put(Crc32(chunk_), &body);
  PutText(method, &body);
  Put(static_cast<std::uint64_t>(records.size()), &body);
  body.append(records);
  const std::uint64_t at = file_.size();
  AppendRecord(Op::kChunk, body);
  const std::uint64_t end = file_.size();

  std::string offsets;  // where the index of each channel stands
  for (const auto& [channel, entries] : chunk_index_) {
    Put(channel, &offsets);
    Put(file_.size(), &offsets);
    std::string list, index;
    for (const Entry& entry : entries) Put(entry, &list);
    Put(channel, &index);
    PutText(list, &index);
    AppendRecord(Op::kMessageIndex, index);
  }
  std::string summary;
  Put(chunk_first_ns_, &summary);
  Put(chunk_last_ns_, &summary);
  Put(at, &summary);
  Put(end - at, &summary);
  PutText(offsets, &summary);
  Put(file_.size() - end, &summary);
  PutText(method, &summary);
  Put(static_cast<std::uint64_t>(records.size()), &summary);
  Put(static_cast<std::uint64_t>(chunk_.size()), &summary);
  PutRecord(Op::kChunkIndex, summary, &chunk_indexes_);
  ++chunks_;
  chunk_.clear();
  chunk_index_.clear();
}

void McapWriter::Attach(const std::string& name, const std::string& media_type,
                        std::int64_t stamp_ns, std::string_view bytes) {
  EndChunk();
  const std::uint64_t at = file_.size();
  const auto stamp = static_cast<std::uint64_t>(stamp_ns);
  std::string body;
  Put(stamp, &body);
  Put(stamp, &body);
  PutText(name, &body);
  PutText(media_type, &body);
  Put(static_cast<std::uint64_t>(bytes.size()), &body);
  body.append(bytes);
  Put(Crc32(body), &body);
  AppendRecord(Op::kAttachment, body);
  std::string index;
  Put(at, &index);
  Put(file_.size() - at, &index);
  Put(stamp, &index);
  Put(stamp, &index);
  Put(static_cast<std::uint64_t>(bytes.size()), &index);
  PutText(name, &index);
  PutText(media_type, &index);
  PutRecord(Op::kAttachmentIndex, index, &attachment_indexes_);
  ++attachments_;
}

void McapWriter::AddMetadata(const std::string& name,
                             const std::map<std::string, std::string>& values) {
  EndChunk();
  const std::uint64_t at = file_.size();
  std::string body, index;
  PutText(name, &body);
  PutMap(values, &body);
  AppendRecord(Op::kMetadata, body);
  Put(at, &index);
  Put(file_.size() - at, &index);
  PutText(name, &index);
  PutRecord(Op::kMetadataIndex, index, &metadata_indexes_);
  ++metadata_;
}

/// From `start` on, but for the footer: groups of records, then where each group stands.
std::string McapWriter::Summary(std::uint64_t start) const {
  std::string schemas, declarations, statistics;
  std::uint16_t types = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto id = static_cast<ChannelId>(i + 1);
    const auto first = std::ranges::find(channels_, channels_[i].type, &BagChannel::type);
    if (first == channels_.begin() + static_cast<std::ptrdiff_t>(i)) {
      PutSchema(id, &schemas);
      ++types;
    }
    PutDeclaration(id, &declarations);
  }
  std::string body, counts;
  Put(messages_, &body);
  Put(types, &body);
  Put(static_cast<std::uint32_t>(channels_.size()), &body);
  Put(attachments_, &body);
  Put(metadata_, &body);
  Put(chunks_, &body);
  Put(static_cast<std::uint64_t>(first_ns()), &body);
  Put(static_cast<std::uint64_t>(last_ns_), &body);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    Put(static_cast<ChannelId>(i + 1), &counts);
    Put(channels_[i].messages, &counts);
  }
  PutText(counts, &body);
  PutRecord(Op::kStatistics, body, &statistics);

  std::string summary, offsets;
  for (const auto& [op, group] : std::initializer_list<std::pair<Op, const std::string&>>{
           {Op::kSchema, schemas},
           {Op::kChannel, declarations},
           {Op::kStatistics, statistics},
           {Op::kChunkIndex, chunk_indexes_},
           {Op::kAttachmentIndex, attachment_indexes_},
           {Op::kMetadataIndex, metadata_indexes_}}) {
    if (group.empty()) continue;
    std::string offset;
    Put(op, &offset);
    Put(start + summary.size(), &offset);
    Put(static_cast<std::uint64_t>(group.size()), &offset);
    PutRecord(Op::kSummaryOffset, offset, &offsets);
    summary += group;
  }
  const std::uint64_t offset_start = start + summary.size();
  summary += offsets;
  Put(Op::kFooter, &summary);
  constexpr std::uint64_t kFooterBytes = 20;
  Put(kFooterBytes, &summary);
  Put(start, &summary);
  Put(offset_start, &summary);
  return summary;
}

void McapWriter::Finish() {
  EndChunk();
  std::string end;
  Put(crc_, &end);
  AppendRecord(Op::kDataEnd, end);
  std::string summary = Summary(file_.size());
  Put(Crc32(summary), &summary);
  file_.Append(summary);
  file_.Append(mcap::kMagic);
  file_.Commit();
}

}  // namespace aisle
