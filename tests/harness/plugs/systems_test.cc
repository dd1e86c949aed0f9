#include "harness/plugs/systems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/run/conformance.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::string ValueOf(const System& system, const std::string& path) {
  for (const SystemOption& option : OptionsOf(system)) {
    if (option.path == path) return option.value;
  }
  return "no such option";
}

TEST(SystemsTest, EveryOneHasItsOptionsWithHelpAndAValueThatIsAllowed) {
  for (const System& system : Systems()) {
    EXPECT_FALSE(system.description.empty()) << system.name;
    const std::vector<SystemOption> options = OptionsOf(system);
    EXPECT_GT(options.size(), 100u);
    for (const SystemOption& option : options) {
      EXPECT_FALSE(option.help.empty()) << option.path;
      EXPECT_EQ(CheckOption(option.path, option.value), "") << option.path;
    }
    EXPECT_EQ(CheckOptions(system, {}), "") << system.name;
  }
}

TEST(SystemsTest, ASystemIsItsOptions) {
  EXPECT_EQ(ValueOf(FindSystem("robust"), "dynamic.method"), "robust");
  EXPECT_EQ(ValueOf(FindSystem("paper"), "dynamic.method"), "paper");
  EXPECT_EQ(ValueOf(FindSystem("oracle"), "dynamic.method"), "none");
}

TEST(SystemsTest, ThePublishedSystemsStandOnThePublishedBaseAndOursOnOurs) {
  for (const char* name : {"orbslam2", "semantic", "paper"}) {
    EXPECT_EQ(ValueOf(FindSystem(name), "base"), "orbslam2") << name;
  }
  for (const char* name : {"plain", "robust", "oracle"}) {
    EXPECT_EQ(ValueOf(FindSystem(name), "base"), "plain") << name;
  }
}

/// Each system as it is and with every value of the options that its traits hang on.
TEST(SystemsTest, ReportsKnowAVariantAsTheSlamReadsIt) {
  std::vector<std::map<std::string, std::string>> variants = {{}};
  for (const char* base : {"plain", "orbslam2"}) {
    variants.push_back({{"base", base}});
    for (const char* method : {"none", "paper", "robust"}) {
      variants.push_back({{"dynamic.method", method}});
      variants.push_back({{"base", base}, {"dynamic.method", method}});
    }
  }
  for (const System& system : Systems()) {
    for (const auto& options : variants) {
      const SystemSpec spec{.name = "mine", .like = system.name, .options = options};
      ASSERT_EQ(CheckOptions(system, options), "") << system.name;
      const System read{.name = "mine", .description = "", .options = OptionsOfSpec(spec)};
      EXPECT_EQ(TraitsOf(spec).base, ValueOf(read, "base")) << system.name;
      EXPECT_EQ(TraitsOf(spec).method, ValueOf(read, "dynamic.method")) << system.name;
    }
  }
}

TEST(SystemsTest, AnOptionWithoutEffectIsNeitherListedNorTaken) {
  EXPECT_EQ(ValueOf(FindSystem("orbslam2"), "track.local_keyframes"), "no such option");
  EXPECT_EQ(ValueOf(FindSystem("plain"), "orbslam2.map_ratio"), "no such option");
  EXPECT_EQ(CheckOptions(FindSystem("paper"), {{"track.local_keyframes", "9"}}),
            "track.local_keyframes has no effect with base orbslam2; only base plain uses it");
  EXPECT_EQ(CheckOptions(FindSystem("paper"), {{"track.local_keyframes", "9"}, {"base", "plain"}}),
            "");
  EXPECT_THAT(CheckOptions(FindSystem("robust"), {{"orbslam2.map_ratio", "0.9"}}),
              HasSubstr("only base orbslam2 uses it"));
}

TEST(SystemsTest, OptionsComeFromAssignmentsAndSayWhatIsWrong) {
  const System& robust = FindSystem("robust");
  EXPECT_EQ(OptionsFromText({"feature.features=800"}, robust).at("feature.features"), "800");
  for (const char* bad : {"feature.features", "feature.features=x", "feature.nothing=1"}) {
    EXPECT_THROW(OptionsFromText({bad}, robust), InputError) << bad;
  }
}

TEST(SystemsTest, AForeignSystemDoesNotRunInside) {
  SystemSpec spec{.name = "mine"};
  spec.external.emplace();
  EXPECT_THROW(MakeSystem(spec, {}), InputError);
}

class OurSlam : public testing::TestWithParam<const char*> {};

TEST_P(OurSlam, KeepsTheContract) {
  const std::string file = SceneFile("smoke/short");
  const auto sequence = OpenSimulation(
      {.scene_file = file, .scene_name = "smoke/short", .assets_dir = AssetsDir().string()});
  const StereoCalibration calibration = sequence->calibration();
  EXPECT_THAT(CheckEstimator([&] { return MakeSystem(BuiltIn(GetParam()), calibration); },
                             *sequence, {.frames = 12}),
              IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Systems, OurSlam, testing::Values("oracle", "paper", "robust"));

}  // namespace
}  // namespace aisle
