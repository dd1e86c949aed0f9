// Files of others, scored by the real program.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "harness/io/file.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kEpoch_ns = 1'403'636'579'000'000'000;

/// A lap of a circle of 4 m in `seconds`, the heading along it: rows of `row(stamp, x, y, half the
/// heading)`.
template <class Row>
std::string Lap(std::int64_t step_ms, double seconds, const Row& row) {
  std::string rows;
  for (std::int64_t ms = 0; ms <= std::llround(1000 * seconds); ms += step_ms) {
    const double angle = 0.4e-3 * static_cast<double>(ms);
    rows += row(kEpoch_ns + ms * 1'000'000, 4 * std::cos(angle), 4 * std::sin(angle), angle / 2);
  }
  return rows;
}
std::string InSeconds(std::int64_t stamp_ns, double x, double y, double half) {
  return fmt::format("{}.{:09} {} {} 0 0 0 {} {}\n", stamp_ns / 1'000'000'000,
                     stamp_ns % 1'000'000'000, x, y, std::sin(half), std::cos(half));
}
/// TUM's order of columns, EuRoC's stamps.
std::string InNanoseconds(std::int64_t stamp_ns, double x, double y, double half) {
  return fmt::format("{} {} {} 0 0 0 {} {}\n", stamp_ns, x, y, std::sin(half), std::cos(half));
}

class ScoreTest : public ProgramTest {
 protected:
  std::string Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
    return (folder_ / name).string();
  }
  static nlohmann::json Scores(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "score");
    arguments.emplace_back("--json");
    const Said said = Run(arguments);
    EXPECT_EQ(said.code, 0) << said.text;
    return nlohmann::json::parse(said.text.substr(said.text.find('{')));
  }
};

TEST_F(ScoreTest, StampsInNanosecondsChangeNoScore) {
  const std::string truth = Write("truth.txt", Lap(5, 20, InSeconds));
  const std::string seconds = Write("s.txt", Lap(50, 20, InSeconds));
  const std::string nanoseconds = Write("ns.txt", Lap(50, 20, InNanoseconds));
  const nlohmann::json usual = Scores({"--truth", truth, "--estimate", seconds});
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--format", "tum"}, {"--format-estimate", "tum"}}) {
    std::vector<std::string> arguments = {"--truth", truth, "--estimate", nanoseconds};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(Scores(arguments).at("scores"), usual.at("scores"));
  }
  const Said said = Run({"score", "--truth", truth, "--estimate", nanoseconds});
  EXPECT_THAT(said.text, HasSubstr("read as      TUM, qw last (truth); TUM, qw last (estimate)"));
  EXPECT_THAT(said.text, HasSubstr("note: the estimate was read as TUM, qw last"));
  const Said both = Run({"score", "--truth", nanoseconds, "--estimate", seconds});
  EXPECT_EQ(both.code, 4);
  EXPECT_THAT(both.text, HasSubstr("ns.txt: 8 columns, the first in nanoseconds"));
  EXPECT_THAT(both.text, HasSubstr("--format-truth tum (last)"));
}

TEST_F(ScoreTest, WhatTruthDoesNotShowIsNotLostAndToldInWords) {
  const std::string lap = Lap(5, 20, InSeconds);
  const std::string seen = Lap(5, 5, InSeconds) + lap.substr(lap.find("\n1403636592.") + 1);
  const std::vector<std::string> files = {"--truth", Write("truth.txt", seen), "--estimate",
                                          Write("e.txt", Lap(50, 20, InSeconds))};
  const nlohmann::json json = Scores(files);
  EXPECT_EQ(json.at("scores").at("coverage").at("value"), 1);
  EXPECT_EQ(json.at("scores").at("times_lost").at("value"), 0);
  EXPECT_TRUE(json.at("scores").at("error_all_p95_m").contains("value"));
  EXPECT_THAT(json.at("notes").dump(), HasSubstr("no truth of their own within 10 ms"));
}

/// Whoever asks for a figure and gets none sees so by the exit code, alone or among others.
TEST_F(ScoreTest, AnEstimateThatIsOfOtherTimesHasNoScore) {
  const std::string truth = Write("truth.txt", Lap(50, 20, InSeconds));
  const std::string good = Write("good.txt", Lap(50, 20, InSeconds));
  const std::string lap = Lap(50, 20, [](std::int64_t stamp_ns, double x, double y, double half) {
    return InSeconds((stamp_ns - kEpoch_ns) * 1000, x, y, half);  // from 0, in milliseconds
  });
  const std::string strange = Write("strange.txt", lap);
  for (const std::vector<std::string>& estimates :
       {std::vector{strange}, std::vector{good, strange}}) {
    std::vector<std::string> arguments = {"score", "--truth", truth, "--estimate"};
    arguments.insert(arguments.end(), estimates.begin(), estimates.end());
    const Said said = Run(arguments);
    EXPECT_EQ(said.code, 5) << said.text;
    EXPECT_THAT(said.text, HasSubstr("no stamp of the estimate is near one of the truth"));
  }
  const std::string from_0 =
      Write("from_0.txt", Lap(50, 20, [](std::int64_t stamp_ns, double x, double y, double half) {
              return InSeconds(stamp_ns - kEpoch_ns, x, y, half);
            }));
  const Said said = Run({"score", "--truth", from_0, "--estimate", strange, "--all"});
  EXPECT_EQ(said.code, 5) << said.text;
  EXPECT_THAT(said.text, HasSubstr("alignment by se3 leaves an error of 3 pairs or more"));
  EXPECT_THAT(said.text, HasSubstr("is one of the files in milliseconds?"));
}

}  // namespace
}  // namespace aisle
