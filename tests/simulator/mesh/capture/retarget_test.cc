#include "simulator/mesh/capture/retarget.h"

#include <gmock/gmock.h>

#include "simulator/mesh/capture/body_map.h"
#include "simulator/mesh/pose.h"
#include "tests/simulator/mesh/capture/made_walk.h"

namespace aisle::sim {
namespace {

using test::MadeWalk, test::WalkStyle, test::WalkWriter;

const Model& Anton() {
  static const Model model =
      ImportModel(std::string(AISLE_SOURCE_DIR) + "/assets/people/worker_anton.glb");
  return model;
}

Retargeted Walk(const WalkStyle& style, const RetargetOptions& options = {}) {
  return Retarget(ParseBvh(WalkWriter(style).Write()), Anton(), options);
}

/// Anton in the walk, posed at any time.
class Posed {
 public:
  explicit Posed(const Clip& clip) : model_(Anton()) { model_.clips = {clip}; }
  NodeFrames At(double time_s) const {
    const PoseLayer layer{0, time_s, 1, -1};
    return PoseNodes(model_, {&layer, 1});
  }
  Eigen::Vector3f Node(const char* name, double time_s) const {
    return At(time_s)[static_cast<std::size_t>(model_.FindNode(name))].translation();
  }
  std::vector<Eigen::Vector3f> Vertices(double time_s) const {
    std::vector<Eigen::Vector3f> positions;
    BlendVertices(model_, JointMatrices(model_, At(time_s)), &positions);
    return positions;
  }

 private:
  Model model_;
};

/// Vertices of a sole: they hang on foot or toes alone, and lie on the floor at rest.
std::vector<std::size_t> SoleOf(const std::string& side) {
  const Model& model = Anton();
  std::vector<std::size_t> sole;
  for (std::size_t i = 0; i < model.weights.size(); ++i) {
    bool is_foot = model.mesh.positions[i].z() < 0.02f;
    for (std::size_t k = 0; k < 4 && model.weights[i].weights[k] > 0; ++k) {
      const int node = model.joints[model.weights[i].joints[k]].node;
      const std::string& name = model.nodes[static_cast<std::size_t>(node)].name;
      is_foot = is_foot && (name == "foot_" + side || name == "toes_" + side);
    }
    if (is_foot) sole.push_back(i);
  }
  return sole;
}

/// The farthest that any point of a standing sole gets from where it was in the middle of its
/// standing, over all times a foot stands.
double Slip(const Clip& clip) {
  const Posed posed(clip);
  double slip = 0;
  for (const int side : {0, 1}) {
    const std::vector<std::size_t> sole = SoleOf(side == 0 ? "left" : "right");
    EXPECT_GT(sole.size(), 20u);
    for (int step = 0; step < 3; ++step) {
      const double begin = (step + (side == 0 ? 0.0 : 0.5)) * MadeWalk::kCycle_s;
      const double lasts = MadeWalk::kStance * MadeWalk::kCycle_s;
      if (begin + lasts > clip.duration_s) continue;
      const auto middle = posed.Vertices(begin + lasts / 2);
      for (int k = 0; k <= 40; ++k) {
        const auto now = posed.Vertices(begin + lasts * k / 40);
        for (const std::size_t i : sole) {
          slip = std::max<double>(slip, (now[i] - middle[i]).head<2>().norm());
        }
      }
    }
  }
  return slip;
}

TEST(Retarget, StandingFeetSlipByLessThanThreeCentimetres) {
  for (const double thigh_m : {0.4, 0.5}) {
    const double slip = Slip(Walk({.thigh_m = thigh_m}).clip);
    RecordProperty(fmt::format("slip_mm_{}", thigh_m), static_cast<int>(1000 * slip));
    EXPECT_LE(slip, 0.03) << thigh_m;
  }
  RetargetOptions nobody_stands;
  nobody_stands.still_mps = 0;
  EXPECT_GT(Slip(Walk({.thigh_m = 0.5}, nobody_stands).clip), 0.03);
}

TEST(Retarget, FindsTheContactsThatWereMade) {
  const Retargeted walk = Walk({});
  for (const std::size_t side : {0u, 1u}) {
    for (int frame = 2; frame + 2 < MadeWalk::kFrames; ++frame) {
      const double time = frame / MadeWalk::kRate_hz;
      const double phase = MadeWalk::Phase(time, static_cast<int>(side));
      const auto index = static_cast<std::size_t>(frame);
      const bool found = std::ranges::any_of(walk.contacts[side], [&](const auto& contact) {
        return contact[0] <= index && index <= contact[1];
      });
      if (phase > 0.04 && phase < MadeWalk::kStance - 0.04) {
        EXPECT_TRUE(found) << frame;
      }
      if (phase > MadeWalk::kStance + 0.08 && phase < 0.92) {
        EXPECT_FALSE(found) << frame;
      }
    }
  }
}

TEST(Retarget, WalksAsFarAsItsLegsAreLong) {
  const Posed posed(Walk({}).clip);
  const Eigen::Vector3f first = posed.Node("pelvis", 0), last = posed.Node("pelvis", 3);
  const Posed rest(Clip{});
  const double leg = (rest.Node("thigh_left", 0) - rest.Node("shin_left", 0)).norm() +
                     (rest.Node("shin_left", 0) - rest.Node("foot_left", 0)).norm();
  const double expected = 3 * MadeWalk::kSpeed * leg / (2 * MadeWalk::kLeg);
  EXPECT_NEAR((last - first).x(), expected, 0.005);
  EXPECT_NEAR(first.head<2>().norm(), 0, 0.05);
  EXPECT_NEAR((last - first).y(), 0, 0.005);
}

TEST(Retarget, ArmsPointWhereTheRecordingHasThem) {
  for (const bool hanging : {false, true}) {
    const Posed posed(Walk({.hanging_arms = hanging}).clip);
    for (const double time : {0.0, 1.3}) {
      const Eigen::Vector3f left =
          (posed.Node("hand_left", time) - posed.Node("upper_arm_left", time)).normalized();
      const Eigen::Vector3f right =
          (posed.Node("hand_right", time) - posed.Node("upper_arm_right", time)).normalized();
      EXPECT_GT(left.y(), 0.999f) << hanging;
      EXPECT_LT(right.y(), -0.999f) << hanging;
    }
  }
}

TEST(Retarget, OneMotionInOtherWordsIsTheSame) {
  const Posed as_is(Walk({}).clip);
  for (const WalkStyle& style :
       {WalkStyle{.unit_m = 1}, WalkStyle{.unit_m = 0.0254, .z_up = true}}) {
    const Posed other(Walk(style).clip);
    for (const double time : {0.0, 0.7, 2.9}) {
      for (const char* node : {"pelvis", "head", "hand_left", "foot_right", "toes_left"}) {
        EXPECT_LT((as_is.Node(node, time) - other.Node(node, time)).norm(), 1e-4f) << node;
      }
    }
  }
}

TEST(Retarget, ABodyThatIsNotThereIsOneError) {
  std::string text = WalkWriter({}).Write();
  for (std::size_t at = 0; (at = text.find("LeftUpLeg")) != std::string::npos;) {
    text.replace(at, 9, "Tail");
  }
  EXPECT_THAT([&] { Retarget(ParseBvh(text), Anton()); },
              testing::ThrowsMessage<ImportError>(testing::HasSubstr("left leg")));
}

TEST(Bvh, BrokenTextsAreOneErrorWithTheirLine) {
  const std::string whole = WalkWriter({}).Write();
  const auto error_of = [](const std::string& text) -> std::string {
    try {
      ParseBvh(text);
    } catch (const ImportError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of(whole), "");
  EXPECT_THAT(error_of(whole.substr(0, whole.size() / 2)), testing::HasSubstr("ends too early"));
  EXPECT_THAT(error_of(whole + "1"), testing::HasSubstr("follow"));
  EXPECT_THAT(error_of("HIERARCHY\nJOINT a"), testing::StartsWith("line 2"));
  for (const char* wrong : {"nan", "inf", "1e99", "x"}) {
    std::string text = whole;
    text.replace(text.find("0.000000000"), 11, wrong);
    EXPECT_THAT(error_of(text), testing::HasSubstr("expected a number"));
  }
  // Any cut and any lost line is an error or a whole motion, never a crash.
  for (std::size_t at = 0; at < whole.size() / 40; at += 97) error_of(whole.substr(at));
}

}  // namespace
}  // namespace aisle::sim
