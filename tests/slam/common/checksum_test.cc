#include "slam/common/checksum.h"

#include <gtest/gtest.h>

#include <string>

namespace aisle::slam {
namespace {

TEST(ChecksumOfBytes, IsFnv1aAsPublished) {
  EXPECT_EQ(ChecksumOfBytes(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(ChecksumOfBytes("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(ChecksumOfBytes("foobar"), 0x85944171f73967e8ULL);
}

TEST(ChecksumOfWords, EveryBitReachesTheLowHalf) {
  const std::string whole(21, '\x5a');  // two words and five bytes
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      EXPECT_NE(static_cast<std::uint32_t>(ChecksumOfWords(damaged)),
                static_cast<std::uint32_t>(ChecksumOfWords(whole)))
          << "byte " << i << ", bit " << bit;
    }
  }
}

}  // namespace
}  // namespace aisle::slam
