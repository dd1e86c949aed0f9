#include "simulator/world/labels.h"

#include <gtest/gtest.h>

#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

TEST(Matches, StarsAndQuestionMarks) {
  EXPECT_TRUE(Matches("*", ""));
  EXPECT_TRUE(Matches("*rack*", "Rack_03"));
  EXPECT_TRUE(Matches("r?ck", "RACK"));
  EXPECT_TRUE(Matches("a*b*c", "axxbxbyc"));
  EXPECT_FALSE(Matches("rack", "racks"));
  EXPECT_FALSE(Matches("r?ck", "rck"));
  EXPECT_FALSE(Matches("a*b", "axxbc"));
  EXPECT_FALSE(Matches("", "a"));
}

TEST(LabelOfNode, TheNearestNameThatSaysSomethingDecides) {
  EXPECT_EQ(LabelOfNode("Hall/Floor", {}), MeshLabel::kFloor);
  EXPECT_EQ(LabelOfNode("Floor/Racks/R1/beam", {}), MeshLabel::kRack);
  EXPECT_EQ(LabelOfNode("Hall/Bodenplatte", {}), MeshLabel::kFloor);
  EXPECT_EQ(LabelOfNode("Hall/Conveyor", {}), MeshLabel::kFurniture);
  EXPECT_EQ(LabelOfNode("", {}), MeshLabel::kFurniture);
}

TEST(LabelOfNode, TheUsersRulesComeFirst) {
  const std::vector<LabelRule> rules = {{"rack_9", MeshLabel::kGoods}, {"x*", MeshLabel::kColumn}};
  EXPECT_EQ(LabelOfNode("Hall/Rack_9", rules), MeshLabel::kGoods);
  EXPECT_EQ(LabelOfNode("Hall/Rack_8", rules), MeshLabel::kRack);
  EXPECT_EQ(LabelOfNode("X1/beam", rules), MeshLabel::kColumn);
}

TEST(ClassOfLabel, IsTheClassOfThatName) {
  EXPECT_EQ(ClassName(ClassOfLabel(MeshLabel::kFloor)), "floor");
  EXPECT_EQ(ClassName(ClassOfLabel(MeshLabel::kGoods)), "goods");
  EXPECT_EQ(ClassName(ClassOfLabel(MeshLabel::kFurniture)), "furniture");
}

/// Labels are pictures of 16 bits: one more would bear the name of the first.
TEST(WorldBuilder, NoThingTakesTheLabelOfAnother) {
  WorldParts parts;
  WorldBuilder builder(&parts);
  for (int i = 1; i <= 65'535; ++i) ASSERT_EQ(builder.Add("box", ObjectClass::kGoods), i);
  try {
    builder.Add("the last one", ObjectClass::kGoods);
    FAIL() << "it was added";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("'the last one'"), std::string::npos);
  }
}

}  // namespace
}  // namespace aisle::sim
