#include "simulator/world/captured_person.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/simulator/mesh/capture/made_walk.h"

namespace aisle::sim {
namespace {

/// A walk straight on that sways across its way, by a metre a second at the most.
std::string SwayingWalk() {
  std::istringstream lines(test::WalkWriter({}).Write());
  std::string text;
  int frame = -1;
  for (std::string line; std::getline(lines, line);) {
    if (frame >= 0) {
      const double left_cm = 50 * std::sin(2 * frame++ / test::MadeWalk::kRate_hz);
      line = fmt::format("{:.9f}{}", left_cm, line.substr(line.find(' ')));
    }
    if (line.starts_with("Frame Time")) frame = 0;
    text += line + "\n";
  }
  return text;
}

TEST(CapturedPerson, HasTheVelocityOfItsOriginSidewaysToo) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("aisle_sway_{}.bvh", ::getpid());
  std::ofstream(file) << SwayingWalk();
  PersonSpec person;
  person.name = "sways";
  person.capture.bvh = {{}, "sway.bvh", file.string()};
  person.route.plan.start = {3, -1};
  person.route.plan.heading_rad = 0.4;
  AssetLibrary assets(std::string(AISLE_SOURCE_DIR) + "/assets");
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  const Actor actor = MakeCapturedPerson(person, &assets, &wardrobe);
  std::filesystem::remove(file);
  constexpr double kHalf_s = 0.005;
  double fastest_aside_mps = 0;
  for (double t = 0.1; t < 3.8; t += 0.13) {
    const MoverState now = actor.at(t);
    const Eigen::Vector3d moved = (actor.at(t + kHalf_s).T_world_object.translation() -
                                   actor.at(t - kHalf_s).T_world_object.translation()) /
                                  (2 * kHalf_s);
    EXPECT_LT((now.velocity_mps - moved).norm(), 1e-3) << t;
    fastest_aside_mps =
        std::max(fastest_aside_mps, std::abs(moved.dot(now.T_world_object.linear().col(1))));
  }
  EXPECT_GT(fastest_aside_mps, 0.8);
}

}  // namespace
}  // namespace aisle::sim
