#include "slam/common/option_fields.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace aisle::slam {
namespace {

enum class Colour { kRed, kGreen };

struct Wheel {
  double radius_m = 0.3;
  std::array<double, 2> offset = {-1, 1};
};

struct Cart {
  int wheels = 4;
  bool braked = false;
  Colour colour = Colour::kGreen;
  Wheel wheel;
  std::uint64_t seed = 7;
};

void Describe(OptionFields& fields, Wheel& wheel) {
  fields.Number("radius_m", &wheel.radius_m, {0.1, 2}, "m", "How large it is.");
  fields.Numbers("offset", &wheel.offset, {-5, 5}, "m", "Where it is.");
}

void Describe(OptionFields& fields, Cart& cart) {
  fields.Integer("wheels", &cart.wheels, {1, 8}, "", "How many it has.");
  fields.Flag("braked", &cart.braked, "Whether it stands.");
  fields.Choice("colour", &cart.colour, {"red", "green"}, "How it looks.");
  fields.Group("wheel", &cart.wheel);
  fields.Seed("seed", &cart.seed, "Of what is random.");
  fields.Require(cart.wheels % 2 == 0, "wheels", cart.wheels, "be even");
}

std::string Set(const std::string& path, const std::string& text, Cart* cart) {
  const OptionFields fields = FieldsOf(*cart);
  for (const OptionField& field : fields.fields()) {
    if (field.path == path) return SetFrom(text, field);
  }
  return "no such path";
}

std::vector<std::string> Texts(Cart cart) {
  std::vector<std::string> texts;
  const OptionFields fields = FieldsOf(cart);
  for (const OptionField& field : fields.fields()) {
    texts.push_back(field.path + "=" + TextOf(field));
  }
  return texts;
}

TEST(OptionFields, AreListedWithPathsInOrder) {
  EXPECT_THAT(Texts({}),
              testing::ElementsAre("wheels=4", "braked=false", "colour=green", "wheel.radius_m=0.3",
                                   "wheel.offset.0=-1", "wheel.offset.1=1", "seed=7"));
}

TEST(OptionFields, AreSetFromText) {
  Cart cart;
  for (const auto& [path, text] : {std::pair{"wheels", "6"},
                                   {"braked", "true"},
                                   {"colour", "red"},
                                   {"wheel.radius_m", "1e-1"},
                                   {"wheel.offset.1", "-2.5"},
                                   {"seed", "4294967295"}}) {
    EXPECT_EQ(Set(path, text, &cart), "");
  }
  EXPECT_EQ(cart.wheels, 6);
  EXPECT_TRUE(cart.braked);
  EXPECT_EQ(cart.colour, Colour::kRed);
  EXPECT_EQ(cart.wheel.radius_m, 0.1);
  EXPECT_EQ(cart.wheel.offset[0], -1);
  EXPECT_EQ(cart.wheel.offset[1], -2.5);
  EXPECT_EQ(cart.seed, 4294967295u);
}

TEST(OptionFields, RefuseWhatIsNoValueAndStayAsTheyAre) {
  Cart cart;
  EXPECT_EQ(Set("wheels", "many", &cart),
            "wheels is \"many\"; it must be a whole number in [1, 8]");
  EXPECT_EQ(Set("wheels", "4.5", &cart), "wheels is \"4.5\"; it must be a whole number in [1, 8]");
  EXPECT_EQ(Set("wheels", "9", &cart), "wheels is 9; it must be in [1, 8]");
  EXPECT_EQ(Set("wheels", "4294967300", &cart), "wheels is 4294967300; it must be in [1, 8]");
  EXPECT_EQ(Set("seed", "-1", &cart), "seed is -1; it must be in [0, 4294967295]");
  EXPECT_EQ(Set("wheel.radius_m", "0.1m", &cart),
            "wheel.radius_m is \"0.1m\"; it must be a number in [0.1, 2] m");
  EXPECT_EQ(Set("wheel.radius_m", "", &cart),
            "wheel.radius_m is \"\"; it must be a number in [0.1, 2] m");
  EXPECT_EQ(Set("wheel.radius_m", "nan", &cart), "wheel.radius_m is nan; it must be in [0.1, 2] m");
  EXPECT_EQ(Set("wheel.offset.0", "inf", &cart), "wheel.offset.0 is inf; it must be in [-5, 5] m");
  EXPECT_EQ(Set("braked", "maybe", &cart), "braked is \"maybe\"; it must be true or false");
  EXPECT_EQ(Set("colour", "gren", &cart),
            "colour is \"gren\"; it must be one of red, green; did you mean green?");
  EXPECT_EQ(Texts(cart), Texts({}));
}

TEST(OptionFields, NumbersReadBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3, std::nextafter(0.7, 1.0), 2.0, 0.1 + 0.2}) {
    Cart from, to;
    from.wheel.radius_m = value;
    EXPECT_EQ(Set("wheel.radius_m", TextOf(FieldsOf(from).fields()[3]), &to), "");
    EXPECT_EQ(to.wheel.radius_m, value);
  }
}

TEST(Validate, NamesTheFirstValueOutOfRangeThenTheFirstBrokenRule) {
  Cart cart;
  EXPECT_EQ(Validate(cart), "");
  cart.wheels = 5;
  EXPECT_EQ(Validate(cart), "wheels is 5; it must be even");
  cart.wheel.radius_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Validate(cart), "wheel.radius_m is nan; it must be in [0.1, 2] m");
  cart.colour = static_cast<Colour>(7);
  EXPECT_EQ(Validate(cart), "colour is not among its choices");
  cart.wheels = 0;
  EXPECT_EQ(Validate(cart), "wheels is 0; it must be in [1, 8]");
}

TEST(Validate, NamesBothSidesOfARule) {
  int low = 5, high = 3;
  OptionFields fields;
  fields.Integer("low", &low, {0, 9}, "", "The lower one.");
  fields.RequireNotAbove("low", low, "high", high);
  EXPECT_EQ(FirstBrokenRule(fields), "low is 5; it must not exceed high, which is 3");
}

}  // namespace
}  // namespace aisle::slam
