#include "simulator/mesh/pose.h"

#include <gtest/gtest.h>

#include <numbers>

namespace aisle::sim {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// An arm of two bones along x, joint at x = 1, with a clip that bends the elbow by 90° in 1 s.
Model Arm() {
  Model arm;
  arm.nodes = {{"upper", -1, {}},
               {"lower", 0, {{1, 0, 0}, Eigen::Quaternionf::Identity(), {1, 1, 1}}}};
  arm.joints = {{0, Eigen::Affine3f::Identity()},
                {1, Eigen::Affine3f(Eigen::Translation3f(-1, 0, 0))}};
  arm.bind_positions = {{0.5f, 0, 0}, {1.5f, 0, 0}, {1, 0, 0}};
  arm.bind_normals.assign(3, Eigen::Vector3f::UnitZ());
  arm.weights = {{{0, 0, 0, 0}, {1, 0, 0, 0}},
                 {{1, 0, 0, 0}, {1, 0, 0, 0}},
                 {{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}}};
  ClipChannel bend;
  bend.node = 1;
  bend.rotations.keys = {
      {0.0f, Eigen::Quaternionf::Identity()},
      {1.0f, Eigen::Quaternionf(Eigen::AngleAxisf(kPi / 2, Eigen::Vector3f::UnitZ()))}};
  arm.clips = {{"bend", 1.0f, {bend}}};
  return arm;
}

std::vector<Eigen::Vector3f> Skinned(const Model& model, std::span<const PoseLayer> layers,
                                     std::span<const NodeMove> moves = {}) {
  std::vector<Eigen::Vector3f> positions, normals;
  SkinVertices(model, JointMatrices(model, PoseNodes(model, layers, moves)), &positions, &normals);
  return positions;
}

TEST(Skinning, TheRestPoseIsTheBindPose) {
  const Model arm = Arm();
  const auto positions = Skinned(arm, {});
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_TRUE(positions[i].isApprox(arm.bind_positions[i], 1e-6f));
  }
}

TEST(Skinning, AJointCarriesWhatFollowsItAndTheElbowStays) {
  const Model arm = Arm();
  const PoseLayer layer{0, 0.999999, 1, -1};
  const auto positions = Skinned(arm, {&layer, 1});
  EXPECT_TRUE(positions[0].isApprox(Eigen::Vector3f(0.5f, 0, 0), 1e-4f));
  EXPECT_TRUE(positions[1].isApprox(Eigen::Vector3f(1, 0.5f, 0), 1e-4f));
  EXPECT_TRUE(positions[2].isApprox(Eigen::Vector3f(1, 0, 0), 1e-4f));
}

TEST(Skinning, EqualLayersMeetHalfWay) {
  const Model arm = Arm();
  const std::vector<PoseLayer> layers = {{0, 0, 2, -1}, {0, 0.999999, 2, -1}};
  const float half = 0.5f * std::numbers::sqrt2_v<float> / 2;
  EXPECT_TRUE(Skinned(arm, layers)[1].isApprox(Eigen::Vector3f(1 + half, half, 0), 1e-4f));
}

TEST(Skinning, APartLayerLeavesTheRestAlone) {
  const Model arm = Arm();
  const std::vector<PoseLayer> layers = {{-1, 0, 1, -1}, {0, 0.999999, 1, 1}};
  const auto positions = Skinned(arm, layers);
  EXPECT_TRUE(positions[0].isApprox(Eigen::Vector3f(0.5f, 0, 0), 1e-4f));
  EXPECT_TRUE(positions[1].isApprox(Eigen::Vector3f(1, 0.5f, 0), 1e-4f));
}

TEST(Skinning, ANodeMoveTurnsAboutTheNodesOwnOrigin) {
  const Model arm = Arm();
  const NodeMove move{1, Eigen::Affine3f(Eigen::AngleAxisf(kPi, Eigen::Vector3f::UnitZ()))};
  const auto positions = Skinned(arm, {}, {&move, 1});
  EXPECT_TRUE(positions[1].isApprox(Eigen::Vector3f(0.5f, 0, 0), 1e-5f));
}

TEST(Skinning, ClipsRepeat) {
  const Model arm = Arm();
  const PoseLayer once{0, 0.3, 1, -1}, later{0, 5.3, 1, -1}, before{0, -0.7, 1, -1};
  EXPECT_TRUE(Skinned(arm, {&once, 1})[1].isApprox(Skinned(arm, {&later, 1})[1], 1e-5f));
  EXPECT_TRUE(Skinned(arm, {&once, 1})[1].isApprox(Skinned(arm, {&before, 1})[1], 1e-5f));
}

}  // namespace
}  // namespace aisle::sim
