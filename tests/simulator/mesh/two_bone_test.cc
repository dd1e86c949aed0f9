#include "simulator/mesh/two_bone.h"

#include <gtest/gtest.h>

#include <random>

namespace aisle::sim {
namespace {

using Eigen::Affine3f, Eigen::AngleAxisf, Eigen::Vector3f;

constexpr float kThigh_m = 0.45f, kShin_m = 0.4f;

/// A leg that hangs on a pelvis, with toes below: nodes 1 to 3 are the limb.
Model Leg() {
  const auto at = [](float x, float z) {
    return NodePose{{x, 0, z}, Eigen::Quaternionf::Identity(), {1, 1, 1}};
  };
  Model leg;
  leg.nodes = {{"pelvis", -1, at(0, 1)},
               {"thigh", 0, at(0, 0)},
               {"shin", 1, at(0, -kThigh_m)},
               {"foot", 2, at(0, -kShin_m)},
               {"toes", 3, at(0.1f, -0.05f)}};
  return leg;
}
const Limb kLimb{1, 2, 3};

/// The leg with its thigh lifted to x by `bend_rad`, its shin hanging down, and all of it turned.
NodeFrames Bent(const Model& leg, float bend_rad, const AngleAxisf& turn) {
  NodeFrames frames = PoseNodes(leg, {});
  const auto about = [&](int node, const AngleAxisf& by) {
    const Vector3f at = frames[static_cast<std::size_t>(node)].translation();
    MoveSubtree(leg, node, Affine3f(Eigen::Translation3f(at) * by * Eigen::Translation3f(-at)),
                &frames);
  };
  about(1, AngleAxisf(-bend_rad, Vector3f::UnitY()));
  about(2, AngleAxisf(bend_rad, Vector3f::UnitY()));
  about(1, turn);
  return frames;
}

/// Which way the knee stands out from the line between hip and ankle, its height on that line left
/// out.
Vector3f KneeSide(const NodeFrames& frames) {
  const Vector3f hip = frames[1].translation(), knee = frames[2].translation() - hip;
  const Vector3f way = (frames[3].translation() - hip).normalized();
  return knee - knee.dot(way) * way;
}

TEST(ReachFor, BringsTheEndThereWithBonesAsLongAndTheKneeOnItsSide) {
  const Model leg = Leg();
  std::mt19937 random(4);
  const auto in = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) / static_cast<float>(1 << 24);
  };
  for (int trial = 0; trial < 300; ++trial) {
    const AngleAxisf turn(in(-3, 3), Vector3f(in(-1, 1), in(-1, 1), in(-1, 1)).normalized());
    NodeFrames frames = Bent(leg, in(0.1f, 1), turn);
    const Vector3f hip = frames[1].translation(), before = KneeSide(frames);
    // Near to where it was: further off, sides mean nothing.
    const Vector3f way = frames[3].translation() - hip;
    const Vector3f off = 0.1f * Vector3f(in(-1, 1), in(-1, 1), in(-1, 1));
    Affine3f target = frames[3];
    target.rotate(AngleAxisf(in(-0.5f, 0.5f), Vector3f::UnitX()));
    target.translation() = hip + std::min(0.84f, (way + off).norm()) * (way + off).normalized();
    const Affine3f T_foot_toes = frames[3].inverse() * frames[4];
    ReachFor(leg, kLimb, target, 0.9995f, &frames);
    EXPECT_LT((frames[3].matrix() - target.matrix()).norm(), 1e-5f);
    EXPECT_LT((frames[4].matrix() - (target * T_foot_toes).matrix()).norm(), 1e-5f);
    EXPECT_LT((frames[1].translation() - hip).norm(), 1e-6f);
    EXPECT_NEAR((frames[2].translation() - hip).norm(), kThigh_m, 1e-5f);
    EXPECT_NEAR((frames[3].translation() - frames[2].translation()).norm(), kShin_m, 1e-5f);
    EXPECT_GT(KneeSide(frames).dot(before), 0) << trial;
  }
}

TEST(ReachFor, WhatIsOutOfReachIsApproachedAsFarAsItMay) {
  const Model leg = Leg();
  NodeFrames frames = Bent(leg, 0.5f, AngleAxisf(0, Vector3f::UnitX()));
  const Vector3f hip = frames[1].translation();
  Affine3f target = frames[3];
  target.translation() = hip + Vector3f(0.6f, 0.2f, -1);
  ReachFor(leg, kLimb, target, 0.98f, &frames);
  const Vector3f expected =
      hip + 0.98f * (kThigh_m + kShin_m) * Vector3f(0.6f, 0.2f, -1).normalized();
  EXPECT_LT((frames[3].translation() - expected).norm(), 1e-5f);
  EXPECT_GT(KneeSide(frames).x(), 0);
}

}  // namespace
}  // namespace aisle::sim
