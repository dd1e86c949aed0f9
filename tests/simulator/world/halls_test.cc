#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "simulator/scene/load.h"
#include "simulator/scene/vary.h"
#include "simulator/world/build.h"
#include "simulator/world/warehouse.h"
#include "tests/simulator/world/mesh_items.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3f;

const std::string kRoot = AISLE_SOURCE_DIR;

std::vector<std::string> FilesIn(const std::string& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(kRoot + "/scenes/" + folder)) {
    if (entry.path().extension() == ".yaml") files.insert(entry.path().string());
  }
  return {files.begin(), files.end()};
}

World Built(const Scene& scene, std::uint64_t seed = 1) {
  return BuildWorld(WithoutActors(scene), kRoot + "/assets", seed);
}

/// What a body would touch: the plan of each triangle between shin and head height, floors, lamps
/// and a curtain's strips left out.
std::vector<Eigen::AlignedBox2f> Touched(const World& world) {
  std::vector<Eigen::AlignedBox2f> boxes;
  const TriangleMesh& mesh = world.statics().mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Instance& thing = world.instances()[world.statics().instances[i]];
    if (thing.object_class == ObjectClass::kFloor || thing.name.starts_with("strip_curtain")) {
      continue;
    }
    Eigen::AlignedBox3f box;
    for (const std::uint32_t v : mesh.triangles[i]) box.extend(mesh.positions[v]);
    if (box.max().z() < 0.07f || box.min().z() > 1.7f) continue;
    boxes.emplace_back(box.min().head<2>(), box.max().head<2>());
  }
  return boxes;
}

/// Cells of 0.25 m that are taken.
std::set<std::pair<int, int>> PlanOf(const World& world) {
  constexpr float kCell_m = 0.25f;
  std::set<std::pair<int, int>> cells;
  for (const auto& box : Touched(world)) {
    if (box.sizes().maxCoeff() > 4) continue;  // the walls
    const Eigen::Array2i low = (box.min().array() / kCell_m).floor().cast<int>();
    const Eigen::Array2i high = (box.max().array() / kCell_m).floor().cast<int>();
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) cells.emplace(x, y);
    }
  }
  return cells;
}

TEST(Halls, NoTwoHaveOnePlan) {
  std::map<std::string, std::set<std::pair<int, int>>> plans;
  for (const std::string& file : FilesIn("halls")) plans[file] = PlanOf(Built(LoadScene(file)));
  ASSERT_GE(plans.size(), 6u);
  for (auto a = plans.begin(); a != plans.end(); ++a) {
    for (auto b = std::next(a); b != plans.end(); ++b) {
      std::vector<std::pair<int, int>> shared;
      std::ranges::set_intersection(a->second, b->second, std::back_inserter(shared));
      const auto all = static_cast<double>(a->second.size() + b->second.size() - shared.size());
      EXPECT_LT(static_cast<double>(shared.size()) / all, 0.55) << a->first << " " << b->first;
    }
  }
}

/// Whether something stands within `radius` of a point.
bool Meets(const std::vector<Eigen::AlignedBox2f>& boxes, const Vector2d& at, double radius) {
  return std::ranges::any_of(boxes, [&](const Eigen::AlignedBox2f& box) {
    return box.exteriorDistance(Vector2f(at.cast<float>())) < static_cast<float>(radius);
  });
}

/// `aisle check` looks at footprints; this at all that is built, what lies about among it.
TEST(Halls, WaysOfTheScenesInThemStayFree) {
  int in_halls = 0;
  for (const std::string& file : FilesIn("weakness")) {
    const Scene scene = LoadScene(file);
    if (scene.hall.use.empty()) continue;
    ++in_halls;
    const std::vector<Eigen::AlignedBox2f> boxes = Touched(Built(scene));
    const auto expect_free = [&](const RouteSpec& route, double radius, const std::string& who) {
      const Route way(route.plan, route.limits);
      for (double t = 0; t <= std::min(way.duration_s(), scene.duration_s()); t += 0.2) {
        const Vector2d at = way.At(t).position;
        ASSERT_FALSE(Meets(boxes, at, radius)) << file << " " << who << " at " << at.transpose();
      }
    };
    expect_free(scene.rig.route, 0.25, "rig");
    for (const PersonSpec& person : scene.people) expect_free(person.route, 0.2, person.name);
    for (const VehicleSpec& vehicle : scene.vehicles) {
      expect_free(vehicle.route, 0.45, vehicle.name);
    }
  }
  EXPECT_GE(in_halls, 18);
}

bool Hangs(const std::string& name) {
  return std::ranges::any_of(std::array{"evaporator", "duct", "cable_tray", "cable_drop", "crane"},
                             [&](const char* kind) { return name.starts_with(kind); });
}

TEST(Halls, NothingFloatsAndNothingIsBelowTheFloorOrAboveTheRoof) {
  for (const std::string& file : FilesIn("halls")) {
    const Scene scene = LoadScene(file);
    const World world = Built(scene);
    std::map<std::string, Eigen::AlignedBox3f> things;
    const TriangleMesh& mesh = world.statics().mesh;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      auto& box = things[world.instances()[world.statics().instances[i]].name];
      for (const std::uint32_t v : mesh.triangles[i]) box.extend(mesh.positions[v]);
    }
    const auto roof = static_cast<float>(scene.hall.height_m);
    for (const auto& [name, box] : things) {
      EXPECT_GE(box.min().z(), -0.005f) << file << " " << name;
      EXPECT_LE(box.max().z(), roof + 0.11f) << file << " " << name;
      const bool of_roof = name == "roof" || name.starts_with("lights") || Hangs(name);
      if (of_roof) {
        EXPECT_GE(box.max().z(), roof - 0.02f) << file << " " << name;
      } else if (name.find("fittings") == std::string::npos && !name.starts_with("goods_")) {
        EXPECT_LE(box.min().z(), 0.03f) << file << " " << name;
      }
    }
  }
}

TEST(Halls, ASeedDealsWhatLiesAboutAndNothingElse) {
  const Scene scene = LoadScene(kRoot + "/scenes/halls/workshop.yaml");
  const World one = Built(scene, 3), again = Built(scene, 3), other = Built(scene, 4);
  EXPECT_EQ(one.statics().mesh.positions, again.statics().mesh.positions);
  EXPECT_EQ(one.statics().mesh.uvs, again.statics().mesh.uvs);
  EXPECT_NE(one.statics().mesh.positions, other.statics().mesh.positions);
  const auto names = [](const World& world) {
    std::vector<std::string> all;
    for (const Instance& thing : world.instances()) {
      if (!thing.name.starts_with("litter") && !thing.name.starts_with("left_standing")) {
        all.push_back(thing.name);
      }
    }
    return all;
  };
  EXPECT_EQ(names(one), names(other));
}

TEST(Halls, RacksOfNothingAreEmpty) {
  const World world = Built(LoadScene(kRoot + "/scenes/halls/new.yaml"));
  EXPECT_TRUE(test::TrianglesOf(world.instances(), world.statics(), "goods_0").empty());
  EXPECT_FALSE(test::TrianglesOf(world.instances(), world.statics(), "goods_1").empty());
}

/// Area of what shows a light: on its plane, within it, on its bright side, as bright as it is.
float AreaThatShows(const World& world, const AreaLight& light) {
  const Vector3f normal = light.half_u.cross(light.half_v).normalized();
  const TriangleMesh& mesh = world.statics().mesh;
  float area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (std::abs(world.materials()[mesh.materials[i]].emission - light.radiance) > 1e-6f) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const Vector3f &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
    const Vector3f way = (p + q + r) / 3 - light.center, cross = (q - p).cross(r - p) / 2;
    const auto within = [&](const Vector3f& half) {
      return std::abs(way.dot(half)) < half.squaredNorm();
    };
    if (within(light.half_u) && within(light.half_v) && std::abs(way.dot(normal)) < 0.1f) {
      area += cross.dot(normal);
    }
  }
  return area;
}

/// What is seen of lamps, open doors, windows and the sky is what they send.
TEST(Lights, ShowAsBrightAsTheyAre) {
  std::vector<std::string> files = FilesIn("halls");
  for (const char* more : {"street/road", "weakness/wandering_sun", "weakness/dim_light"}) {
    files.push_back(fmt::format("{}/scenes/{}.yaml", kRoot, more));
  }
  for (const std::string& file : files) {
    const World world = Built(LoadScene(file));
    for (std::size_t i = 0; i < world.lights().size(); ++i) {
      const AreaLight& light = world.lights()[i];
      const float area = 4 * light.half_u.cross(light.half_v).norm();
      EXPECT_NEAR(AreaThatShows(world, light), area, 0.01f * area) << file << ", light " << i;
    }
  }
}

TEST(Lights, TheWholeSkyIsAsBrightAsItsLights) {
  Scene scene;
  scene.hall.walls = WallKind::kSky;
  scene.lights.resize(1);
  scene.lights[0].brightness = 0.5;
  const World world = Built(scene);
  for (const Material& material : world.materials()) {
    EXPECT_TRUE(material.emission == 0 || material.emission == 0.5f) << material.name;
  }
}

TEST(Daylight, EachOpenDoorIsAsBrightAsItsOwnDay) {
  Scene scene = LoadScene(kRoot + "/scenes/halls/loading_dock.yaml");
  ASSERT_GE(scene.doors.size(), 2u);
  for (std::size_t i = 0; i < scene.doors.size(); ++i) {
    scene.doors[i].daylight = 1.0 + static_cast<double>(i);
  }
  const World world = Built(scene);
  ASSERT_EQ(world.lights().size(), LightScale(scene, 0).size());
  for (const AreaLight& light : world.lights()) {
    const float area = 4 * light.half_u.cross(light.half_v).norm();
    EXPECT_NEAR(AreaThatShows(world, light), area, 0.01f * area);
  }
}

/// Clouds dim the doors and nothing else, smoothly, within what the hall says.
TEST(Daylight, DimsAsCloudsPass) {
  Scene scene;
  scene.hall.cloud = 0.6;
  scene.hall.cloud_s = 8;
  scene.lights.resize(1);
  scene.lights[0].rows = scene.lights[0].per_row = 1;
  scene.doors.resize(2);
  scene.doors[1].daylight = 0.5;
  float least = 1, most = 0, before = LightScale(scene, 0)[1];
  for (double t = 0; t < 120; t += 0.05) {
    const std::vector<float> scale = LightScale(scene, t);
    ASSERT_EQ(scale.size(), 3u);  // a lamp, and the open door's sky and yard
    EXPECT_EQ(scale[0], 1);
    EXPECT_EQ(scale[2], scale[1]);
    EXPECT_LT(std::abs(scale[1] - before), 0.04f);
    before = scale[1];
    least = std::min(least, before);
    most = std::max(most, before);
  }
  EXPECT_NEAR(least, 0.4f, 0.01f);
  EXPECT_NEAR(most, 1, 0.01f);
}

/// What the hall itself does must not tell twins apart whose errors are subtracted.
TEST(Daylight, AndLampsThatGoOffAreTheSameInEveryTwin) {
  Scene scene = LoadScene(kRoot + "/scenes/halls/loading_dock.yaml");
  scene.lights.at(0).off = {{.from_s = 2, .to_s = 3}};
  for (const double t : {0.0, 1.3, 2.5, 4.7}) {
    EXPECT_EQ(LightScale(Frozen(scene), t), LightScale(scene, t));
    EXPECT_EQ(LightScale(WithoutActors(scene), t), LightScale(scene, t));
    EXPECT_EQ(LightScale(WithDynamics(scene, Dynamics::kNone), t), LightScale(scene, t));
  }
  EXPECT_NE(LightScale(Frozen(scene), 0), LightScale(Frozen(scene), 2.5));
}

}  // namespace
}  // namespace aisle::sim
