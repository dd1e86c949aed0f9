#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <regex>
#include <sstream>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Those that say all themselves: of another file's keys nothing in the text can be changed.
std::vector<fs::path> ProjectScenes() {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(AISLE_SOURCE_DIR) / "scenes")) {
    const fs::path& file = entry.path();
    if (file.extension() != ".yaml" || file.parent_path().filename() == "suites") continue;
    const std::string text = TextOf(file);
    const bool whole = text.find("\nextend:") == std::string::npos;
    if (whole && text.find("hall: {use:") == std::string::npos) files.push_back(file);
  }
  std::ranges::sort(files);
  return files;
}

/// A scene with one wrong thing in it.
struct Mutation {
  std::string text;
  std::string what;  ///< for the test's messages
  int line = 0;      ///< where
  std::string key;   ///< that a message must name
};

/// Replaces one key with a number by something wrong.
Mutation Mutate(const std::string& text, std::mt19937* random) {
  const std::regex pattern(R"(([a-z_]+): (-?[0-9]+(\.[0-9]+)?)(?=[,}\n ]))");
  std::vector<std::smatch> places(std::sregex_iterator(text.begin(), text.end(), pattern), {});
  const std::smatch& place = places[(*random)() % places.size()];
  const std::string key = place[1], number = place[2];
  const std::array<std::string, 5> wrong = {key + "x: " + number, key + ": lots",
                                            key + ": [1, 2, 3]", key + ": -98765432",
                                            key + ": \"" + number + "\""};
  Mutation mutation;
  mutation.what = wrong[(*random)() % wrong.size()];
  mutation.key = key;
  const auto at = static_cast<std::size_t>(place.position());
  mutation.line =
      1 + static_cast<int>(std::count(text.begin(), text.begin() + place.position(), '\n'));
  mutation.text = text;
  mutation.text.replace(at, static_cast<std::size_t>(place.length()), mutation.what);
  return mutation;
}

TEST(RandomMutations, OfAnySceneGiveOneErrorThatNamesTheLineAndTheKey) {
  std::mt19937 random(1);
  constexpr int kEach = 4;
  for (const fs::path& file : ProjectScenes()) {
    const std::string text = TextOf(file);
    for (int i = 0; i < kEach; ++i) {
      const Mutation mutation = Mutate(text, &random);
      std::vector<std::string> messages;
      try {
        ParseScene(mutation.text, "scene.yaml");
      } catch (const SceneError& error) {
        messages = error.messages();
      }
      ASSERT_EQ(messages.size(), 1u) << file << ": " << mutation.what << " in line "
                                     << mutation.line << ": " << testing::PrintToString(messages);
      EXPECT_THAT(messages[0],
                  testing::StartsWith("scene.yaml:" + std::to_string(mutation.line) + ":"))
          << file << ": " << mutation.what;
      EXPECT_THAT(messages[0], testing::HasSubstr(mutation.key)) << mutation.what;
    }
  }
}

}  // namespace
}  // namespace aisle::sim
