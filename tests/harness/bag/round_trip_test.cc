// Any messages on any topics, in chunks of any size: the bag gives each back.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include "harness/bag/bag.h"
#include "tests/support/arbitrary.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Said {
  std::size_t channel = 0;
  std::int64_t stamp_ns = 0;
  std::string bytes;
};

std::vector<BagChannel> AnyChannels() {
  std::vector<BagChannel> channels;
  for (int left = AnyOf(1, 5); left > 0; --left) {
    channels.push_back({.topic = fmt::format("/t{}{}", left, AnyText()),
                        .type = fmt::format("a_msgs/msg/Thing{}", left),  // has one definition
                        .definition = AnyText(),
                        .qos = AnyText()});
  }
  return channels;
}

TEST(McapRoundTrip, GivesBackTopicsMessagesAndMetadata) {
  const fs::path file =
      fs::temp_directory_path() / fmt::format("aisle_bag_round_{}.mcap", ::getpid());
  EXPECT_TRUE(rc::check([&file] {
    const std::vector<BagChannel> channels = AnyChannels();
    const auto metadata = AnyMap(3, AnyText);
    std::vector<Said> said;
    McapWriter writer(
        file, {.chunk_bytes = static_cast<std::size_t>(AnyOf(1, 2000)), .zstd_level = AnyOf(0, 4)});
    std::vector<McapWriter::ChannelId> ids;
    for (const BagChannel& channel : channels) ids.push_back(writer.AddChannel(channel));
    for (int left = AnyOf(0, 40); left > 0; --left) {
      const auto channel = static_cast<std::size_t>(AnyOf(0, static_cast<int>(channels.size())));
      said.push_back(
          {channel, *rc::gen::inRange<std::int64_t>(0, 2'000'000'000'000'000'000), AnyBytes()});
      writer.Write(ids[channel], said.back().stamp_ns, said.back().bytes);
    }
    writer.AddMetadata("more", metadata);
    writer.Finish();

    const std::unique_ptr<Bag> bag = OpenBag(file);
    RC_ASSERT(bag->notes().empty());
    RC_ASSERT(bag->metadata().at("more") == metadata);
    RC_ASSERT(bag->entries().size() == said.size());
    for (std::size_t i = 0; i < said.size(); ++i) {
      const BagEntry& entry = bag->entries()[i];
      RC_ASSERT(entry.log_ns == said[i].stamp_ns);
      RC_ASSERT(bag->Read(entry) == said[i].bytes);
      const BagChannel &read = bag->channels()[entry.channel], &made = channels[said[i].channel];
      RC_ASSERT(read.topic == made.topic && read.type == made.type);
      RC_ASSERT(read.definition == made.definition && read.qos == made.qos);
    }
  }));
  fs::remove(file);
}

}  // namespace
}  // namespace aisle
