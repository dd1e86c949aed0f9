#include "harness/cluster/array.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace aisle {
namespace {

/// The tasks that Slurm would start for a part.
std::vector<std::size_t> TasksOf(const ArrayPart& part) {
  std::vector<std::size_t> tasks;
  std::stringstream text(part.indices);
  for (std::string range; std::getline(text, range, ',');) {
    const std::size_t hyphen = range.find('-');
    const std::size_t first = std::stoul(range);
    const std::size_t last =
        hyphen == std::string::npos ? first : std::stoul(range.substr(hyphen + 1));
    for (std::size_t i = first; i <= last; ++i) tasks.push_back(i + part.offset);
  }
  return tasks;
}

TEST(ArrayTest, IsWrittenAsSbatchTakesIt) {
  EXPECT_EQ(SplitArray({0, 1, 2, 3, 7, 9, 10}, 1001), (std::vector<ArrayPart>{{0, "0-3,7,9-10"}}));
  EXPECT_TRUE(SplitArray({}, 1001).empty());
  EXPECT_THROW(SplitArray({0}, 0), std::invalid_argument);
}

TEST(ArrayTest, EveryTaskOnceAndNoIndexAtOrOverTheLimit) {
  for (const std::size_t limit : {1, 2, 7, 1001}) {
    std::vector<std::size_t> tasks;
    for (std::size_t i = 0; i < 2500; ++i) {
      if (i % 5 != 3 && (i < 300 || i > 1400)) tasks.push_back(i);
    }
    std::vector<std::size_t> started;
    for (const ArrayPart& part : SplitArray(tasks, limit)) {
      for (const std::size_t task : TasksOf(part)) {
        EXPECT_LT(task - part.offset, limit);
        started.push_back(task);
      }
    }
    EXPECT_EQ(started, tasks) << limit;
  }
}

}  // namespace
}  // namespace aisle
