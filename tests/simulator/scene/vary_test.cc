#include "simulator/scene/vary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

const std::vector<std::string> kModels = {"a", "b", "c", "d", "e"};

/// Three people; the last one keeps the look of "c".
Scene Trio() {
  Scene scene;
  for (const char* model : {"b", "e", "c"}) {
    PersonSpec person;
    person.place = scene.people.size();
    person.name = model;
    person.model = model;
    person.level = static_cast<Dynamics>(1 + scene.people.size());
    person.vary = {0.5, 0.1, 0.2, scene.people.size() < 2};
    person.route.plan.start_s = 2;
    person.route.plan.steps.emplace_back().go = {{1, 0}, {2, 0}};
    scene.people.push_back(person);
  }
  return scene;
}

TEST(Seeded, ChangesTimingSpeedAndPathWithinTheirBounds) {
  std::set<double> starts;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    for (const PersonSpec& person : Seeded(Trio(), seed).people) {
      const RoutePlan& plan = person.route.plan;
      EXPECT_NEAR(plan.start_s, 2, 0.5);
      EXPECT_NEAR(plan.steps[0].speed_mps, 1, 0.1);
      EXPECT_LE((plan.steps[0].go[0] - Eigen::Vector2d(1, 0)).cwiseAbs().maxCoeff(), 0.2);
      EXPECT_EQ(plan.steps[0].go[1], Eigen::Vector2d(2, 0)) << "the end stays";
      starts.insert(plan.start_s);
    }
  }
  EXPECT_EQ(starts.size(), 150u) << "everybody's own, with every seed";
  EXPECT_LT(*starts.begin(), 1.6) << "some are early";
  EXPECT_GT(*starts.rbegin(), 2.4) << "and some late";
}

TEST(Seeded, SomebodyDoesTheSameWhoeverElseIsThere) {
  Scene few = Trio();
  few.people.erase(few.people.begin());
  const double alone = Seeded(few, 3).people[0].route.plan.start_s;
  EXPECT_EQ(alone, Seeded(Trio(), 3).people[1].route.plan.start_s);
}

TEST(WithLooks, TheFirstSeedShowsWhatIsWritten) {
  const Scene scene = WithLooks(Trio(), 1, kModels);
  for (const PersonSpec& person : scene.people) EXPECT_EQ(person.model, person.name);
}

TEST(WithLooks, EverybodyElseGetsAnyLookInTimeAndNoTwoTheSame) {
  std::set<std::string> seen;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    const Scene scene = WithLooks(Trio(), seed, kModels);
    EXPECT_EQ(scene.people[2].model, "c") << "the scene needs this one";
    EXPECT_NE(scene.people[0].model, scene.people[1].model);
    EXPECT_NE(scene.people[0].model, "c");
    EXPECT_NE(scene.people[1].model, "c");
    seen.insert(scene.people[0].model);
  }
  EXPECT_THAT(seen, testing::ElementsAre("a", "b", "d", "e"));
}

TEST(WithLooks, AModelThatIsUnknownStaysForTheErrorThatNamesIt) {
  Scene scene = Trio();
  scene.people[0].model = "nobody";
  EXPECT_EQ(WithLooks(scene, 4, kModels).people[0].model, "nobody");
}

TEST(CheckSeed, FindsWhatOneSeedAloneBrings) {
  const Scene scene = ParseScene(
      "about: A person passes close by.\nrig: {start: [0, 0]}\n"
      "hall: {from: [-8, -8], to: [8, 8]}\nlights: [{height_m: 2.5}]\n"
      "people:\n  - name: walker\n    start: [3, 0.7]\n    heading_deg: 180\n"
      "    vary: {path_m: 0.17}\n"
      "    steps: [{go: [[0, 0.7], [-3, 0.7]], corner_radius_m: 0.1}]\n",
      "close.yaml");
  int good = 0;
  constexpr int kSeeds = 200;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) good += CheckSeed(scene, seed).empty();
  EXPECT_EQ(good, kSeeds) << "0.7 - 0.17 m is clear of the 0.52 m they need";
}

}  // namespace
}  // namespace aisle::sim
