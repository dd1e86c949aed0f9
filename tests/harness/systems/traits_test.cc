#include "harness/systems/traits.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

SystemTraits Traits(const std::string& like,
                    const std::map<std::string, std::string>& options = {}) {
  return TraitsOf(SystemSpec{.name = "mine", .like = like, .options = options});
}

TEST(SystemTraitsTest, ABuiltInSystemIsAsItsDefinitionSays) {
  const std::map<std::string, SystemTraits> expected = {
      {"orbslam2", {"orbslam2", MaskSource::kNone, "none"}},
      {"plain", {"plain", MaskSource::kNone, "none"}},
      {"semantic", {"orbslam2", MaskSource::kActors, "none"}},
      {"paper", {"orbslam2", MaskSource::kNone, "paper"}},
      {"robust", {"plain", MaskSource::kNone, "robust"}},
      {"oracle", {"plain", MaskSource::kDynamic, "none"}}};
  for (const System& system : Systems()) {
    ASSERT_TRUE(expected.contains(system.name)) << system.name;
    EXPECT_EQ(TraitsOf(BuiltIn(system.name)), expected.at(system.name)) << system.name;
  }
}

TEST(SystemTraitsTest, AnOptionOfAVariantDecidesOverTheDefinition) {
  for (const System& system : Systems()) {
    const SystemTraits own = TraitsOf(system);
    for (const std::string method : {"none", "paper", "robust"}) {
      const SystemTraits traits = Traits(system.name, {{"dynamic.method", method}});
      EXPECT_EQ(traits, (SystemTraits{own.base, own.masks, method})) << system.name;
      EXPECT_EQ(traits.Rejects(), method != "none" || own.ReceivesMasks()) << system.name;
    }
    for (const std::string base : {"plain", "orbslam2"}) {
      const SystemTraits traits = Traits(system.name, {{"base", base}});
      EXPECT_EQ(traits, (SystemTraits{base, own.masks, own.method})) << system.name;
    }
    EXPECT_EQ(Traits(system.name, {{"feature.features", "400"}}), own) << system.name;
  }
}

TEST(SystemTraitsTest, PlainThatRejectsDoesAndRobustThatDoesNotDoesNot) {
  EXPECT_FALSE(Traits("plain").Rejects());
  EXPECT_TRUE(Traits("plain", {{"dynamic.method", "robust"}}).Rejects());
  EXPECT_TRUE(Traits("robust").Rejects());
  EXPECT_FALSE(Traits("robust", {{"dynamic.method", "none"}}).Rejects());
}

TEST(SystemTraitsTest, OfAForeignSystemAndOneOfAnotherVersionNothingIsSupposed) {
  SystemSpec command{.name = "plain"};
  command.external.emplace();
  const SystemSpec gone{.name = "gone", .like = "gone", .options = {{"dynamic.method", "paper"}}};
  for (const SystemSpec& spec : {command, gone}) {
    EXPECT_EQ(TraitsOf(spec), SystemTraits{}) << spec.name;
    EXPECT_FALSE(TraitsOf(spec).IsKnown()) << spec.name;
    EXPECT_FALSE(TraitsOf(spec).Rejects()) << spec.name;
    EXPECT_EQ(OptionsOver(spec), spec.options) << spec.name;
  }
}

TEST(SystemSpecTest, IsOneOfOursAVariantOrACommandAndNothingBetween) {
  EXPECT_EQ(CheckSpec(BuiltIn("robust")), "");
  EXPECT_NE(CheckSpec(SystemSpec{}), "") << "a name";
  SystemSpec nothing{.name = "mine"};
  EXPECT_NE(CheckSpec(nothing), "");
  SystemSpec command = nothing;
  command.external.emplace();
  EXPECT_EQ(CheckSpec(command), "");
  SystemSpec both = command;
  both.like = "robust";
  EXPECT_NE(CheckSpec(both), "");
  SystemSpec options = command;
  options.options["feature.features"] = "800";
  EXPECT_NE(CheckSpec(options), "");
  SystemSpec told{.name = "network", .like = "semantic"};
  told.mask_errors.boundary_px = 3;
  EXPECT_EQ(CheckSpec(told), "");
  told.like = "robust";
  EXPECT_NE(CheckSpec(told), "") << "a system that finds its own masks cannot be given bad ones";
}

}  // namespace
}  // namespace aisle
