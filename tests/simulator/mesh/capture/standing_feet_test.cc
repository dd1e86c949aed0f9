#include "simulator/mesh/capture/standing_feet.h"

#include <gmock/gmock.h>

#include "simulator/mesh/two_bone.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;
using testing::ElementsAre;

constexpr double kFrame_s = 0.02;

/// One foot stands, is lifted, is held still in the air for a second, and stands again; the other
/// one stands all the time.
TEST(FindContacts, AFootThatRestsInTheAirDoesNotStand) {
  FootTracks tracks;
  for (int k = 0; k < 200; ++k) {
    const double t = kFrame_s * k;  // on the floor up to 1 s and from 3 s on
    const double lifted = std::clamp(std::min(2 * (t - 1), 2 * (3 - t)), 0.0, 1.0);
    tracks[0].emplace_back(0.2 * lifted, 0.1, 0.02 + 0.3 * lifted);
    tracks[1].emplace_back(0, -0.1, 0.02);
  }
  const FootContacts contacts = FindContacts(tracks, kFrame_s, {});
  EXPECT_THAT(contacts[1], ElementsAre(std::array<std::size_t, 2>{0, 199}));
  ASSERT_EQ(contacts[0].size(), 2u);
  EXPECT_EQ(contacts[0][0][0], 0u);
  EXPECT_NEAR(static_cast<double>(contacts[0][0][1]), 50, 3);
  EXPECT_NEAR(static_cast<double>(contacts[0][1][0]), 150, 3);
  EXPECT_EQ(contacts[0][1][1], 199u);
}

const Model& Anton() {
  static const Model model =
      ImportModel(std::string(AISLE_SOURCE_DIR) + "/assets/people/worker_anton.glb");
  return model;
}

struct Side {
  int thigh, shin, foot, toes;
};
std::array<Side, 2> Sides() {
  const auto of = [](const std::string& side) {
    return Side{Anton().FindNode("thigh_" + side), Anton().FindNode("shin_" + side),
                Anton().FindNode("foot_" + side), Anton().FindNode("toes_" + side)};
  };
  return {of("left"), of("right")};
}

Vector3f At(const NodeFrames& frames, int node) {
  return frames[static_cast<std::size_t>(node)].translation();
}

/// A recording that glides forwards and bobs from 4 cm too high to 10 cm too low for its feet.
std::vector<NodeFrames> Gliding() {
  std::vector<NodeFrames> poses;
  const NodeFrames rest = PoseNodes(Anton(), {});
  for (int k = 0; k < 60; ++k) {
    poses.push_back(rest);
    const Vector3f off(0.002f * static_cast<float>(k - 30), 0,
                       -0.03f + 0.07f * std::cos(0.2f * static_cast<float>(k)));
    MoveSubtree(Anton(), Anton().FindNode("pelvis"), Eigen::Affine3f(Eigen::Translation3f(off)),
                &poses.back());
  }
  return poses;
}

TEST(StandOnFloor, StandingFeetAreOnTheFloorWhereverThePelvisIs) {
  const float ball_m = At(PoseNodes(Anton(), {}), Sides()[0].toes).z();
  const std::vector<NodeFrames> recorded = Gliding();
  std::vector<NodeFrames> poses = recorded;
  StandOnFloor(Anton(), BodyOf(Anton()), ball_m, {{{{0, 59}}, {{0, 59}}}}, kFrame_s, {}, &poses);
  const int pelvis = Anton().FindNode("pelvis");
  float deepest_m = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (const Side& side : Sides()) {
      const Vector3f ball = At(poses[k], side.toes);
      EXPECT_NEAR(ball.z(), ball_m, 1e-4f) << k;
      EXPECT_LT((ball - At(poses[29], side.toes)).head<2>().norm(), 1e-4f) << k;
      // The rest pose looks along x, and so do its knees.
      const Vector3f hip = At(poses[k], side.thigh), ankle = At(poses[k], side.foot);
      const Vector3f knee = At(poses[k], side.shin) - hip, way = (ankle - hip).normalized();
      EXPECT_GT((knee - knee.dot(way) * way).x(), 0) << k;
    }
    const float sunk_m = At(recorded[k], pelvis).z() - At(poses[k], pelvis).z();
    EXPECT_GT(sunk_m, -1e-6f) << k;
    if (k % 31 == 15) {
      EXPECT_NEAR(sunk_m, 0, 1e-6f) << "low enough as it is";
    }
    deepest_m = std::max(deepest_m, sunk_m);
  }
  EXPECT_GT(deepest_m, 0.03f);
  EXPECT_LT(deepest_m, 0.06f);
}

}  // namespace
}  // namespace aisle::sim
