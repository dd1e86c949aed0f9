#include "harness/io/descriptor.h"

#include <fcntl.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

bool IsOpen(int fd) { return ::fcntl(fd, F_GETFD) != -1; }
int OpenNull() { return ::open("/dev/null", O_RDONLY | O_CLOEXEC); }

TEST(Descriptor, ClosesWithItsOwnerAndOnlyOnce) {
  const int fd = OpenNull();
  {
    Descriptor first(fd);
    Descriptor second(std::move(first));
    EXPECT_EQ(second.get(), fd);
    EXPECT_TRUE(IsOpen(fd));
  }
  EXPECT_FALSE(IsOpen(fd));
}

TEST(Descriptor, AssignedToAnotherClosesWhatWasThere) {
  const int before = OpenNull(), now = OpenNull();
  Descriptor held(before);
  held = Descriptor(now);
  EXPECT_EQ(held.get(), now);
  EXPECT_FALSE(IsOpen(before));
  held.Close();
  EXPECT_FALSE(IsOpen(now));
  held.Close();
  EXPECT_EQ(held.get(), -1);
}

}  // namespace
}  // namespace aisle
