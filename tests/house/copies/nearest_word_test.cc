// The houses do not know one another, so each has its own search for the word that was meant. A
// user does not notice which of them answers.

#include <gtest/gtest.h>

#include <random>

#include "harness/io/nearest_word.h"
#include "simulator/scene/issues.h"
#include "slam/common/nearest_name.h"

namespace aisle {
namespace {

using Words = std::vector<std::string>;

void ExpectNearest(const std::string& word, const Words& known, const std::string& expected) {
  EXPECT_EQ(NearestWord(word, known), expected) << "harness: " << word;
  EXPECT_EQ(sim::NearestWord(word, known), expected) << "simulator: " << word;
  EXPECT_EQ(slam::NearestName(word, known), expected) << "slam: " << word;
}

TEST(NearestWord, OneRuleInEveryHouse) {
  ExpectNearest("pir", {"rigs", "pri"}, "pri");    // two swapped letters are one mistake
  ExpectNearest("rob", {"orb", "robust"}, "orb");  // the first of equals
  ExpectNearest("rob", {"robust"}, "robust");      // begins alike
  ExpectNearest("robustness", {"paper", "robust"}, "robust");
  ExpectNearest("seds", {"suite", "seeds"}, "seeds");
  ExpectNearest("memory", {"memory_frames", "memory"}, "memory");
  ExpectNearest("orbslam3", {"plain", "orbslam2"}, "orbslam2");
  ExpectNearest("kitten", {"sitting"}, "");  // three of six are too many
  ExpectNearest("kittens", {"sittens"}, "sittens");
  ExpectNearest("zebra", {"scale", "levels"}, "");
  ExpectNearest("x", {"y"}, "");
  ExpectNearest("", {"", "a"}, "");
  ExpectNearest(std::string(1 << 24, 'x'), {"seeds"}, "");  // no table of that size is made
}

TEST(NearestWord, TheHousesAgreeOnAnyWords) {
  std::mt19937 random(1);
  const auto draw = [&] {
    std::string word(random() % 9, 'a');
    for (char& letter : word) letter = static_cast<char>('a' + random() % 3);
    return word;
  };
  int found = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string word = draw();
    const Words known = {draw(), draw(), draw()};
    const std::string nearest = NearestWord(word, known);
    found += nearest.empty() ? 0 : 1;
    ASSERT_EQ(sim::NearestWord(word, known), nearest) << word;
    ASSERT_EQ(slam::NearestName(word, known), nearest) << word;
  }
  EXPECT_GT(found, 1000);
  EXPECT_LT(found, 19000);
}

}  // namespace
}  // namespace aisle
