#include "simulator/foreign/foreign_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kScene = R"({
  "camera": {"type": "perspective", "fov": 90,
             "transform": [1,0,0,0, 0,1,0,2, 0,0,1,-20, 0,0,0,1]},
  "film": {"size": [40, 20]},
  "textures": [],
  "bsdfs": [{"name": "grey", "type": "diffuse", "reflectance": [0.1, 0.2, 0.3]}],
  "shapes": [{"name": "square", "type": "obj", "filename": "square.obj"},
             {"name": "lamp", "type": "obj", "filename": "square.obj",
              "transform": [1,0,0,0, 0,1,0,5, 0,0,3,0, 0,0,0,1]}],
  "entities": [{"name": "floor", "shape": "square", "bsdf": "grey"},
               {"name": "lit", "shape": "lamp", "bsdf": "grey"}],
  "lights": [{"name": "sun", "type": "area", "entity": "lit", "radiance": [3, 2, 1]}]
})";

class ForeignSceneTest : public ::testing::Test {
 protected:
  ForeignSceneTest() {
    fs::create_directories(folder_);
    // Counter-clockwise from above: (1, ·, 1) → (1, ·, -1) goes along u × v = +y.
    Write("square.obj", "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n");
    Write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  ~ForeignSceneTest() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  ForeignScene Load(const std::string& text) const {
    Write("scene.json", text);
    return LoadForeignScene(folder_ / "scene.json");
  }
  /// The message about the scene with one piece of its text changed.
  std::string Complaint(const std::string& from, const std::string& to) const {
    std::string text = kScene;
    const std::size_t at = text.find(from);
    if (at == std::string::npos) return "the test is broken: no " + from;
    try {
      Load(text.replace(at, from.size(), to));
    } catch (const ForeignSceneError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_ =
      fs::temp_directory_path() / fmt::format("aisle_foreign_{}", static_cast<int>(getpid()));
};

TEST_F(ForeignSceneTest, IsReadInFullAndScaledToTenMetres) {
  const ForeignScene scene = Load(kScene);
  const float factor = 0.5f;  // the camera's 20 become 10
  EXPECT_EQ(scene.camera.width, 40);
  EXPECT_NEAR(scene.camera.fx, 20, 1e-9);  // 90° across 40 pixels
  EXPECT_NEAR(scene.camera.cy, 9.5, 1e-9);
  EXPECT_TRUE(scene.T_world_camera.translation().isApprox(Eigen::Vector3d(0, 1, -10)));
  // What is to the right in the picture is to the left of their x.
  EXPECT_TRUE((scene.T_world_camera.linear() * Eigen::Vector3d::UnitX())
                  .isApprox(-Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(scene.T_world_camera.linear().determinant(), 1, 1e-9);

  const WorldParts& green = scene.bands[1];
  EXPECT_FLOAT_EQ(green.materials[0].albedo, 0.2f);
  EXPECT_FLOAT_EQ(green.materials[1].emission, 2);
  EXPECT_EQ(green.materials[0].emission, 0);
  EXPECT_EQ(green.statics.mesh.triangles.size(), 4u);
  ASSERT_EQ(green.lights.size(), 1u);
  const AreaLight& light = green.lights[0];
  EXPECT_TRUE(light.center.isApprox(factor * Eigen::Vector3f(0, 5, 0)));
  const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
  EXPECT_TRUE(cross.isApprox(factor * factor * Eigen::Vector3f(0, 3, 0)));  // a quarter of its area
  EXPECT_FLOAT_EQ(light.radiance, 2);
  EXPECT_NO_THROW(World{WorldParts(green)});
}

TEST_F(ForeignSceneTest, MistakesAreNamedWithFileAndKey) {
  EXPECT_THAT(Complaint("\"perspective\"", "\"fisheye\""), HasSubstr("camera.type: 'fisheye'"));
  EXPECT_THAT(Complaint("\"fov\": 90", "\"fov\": 190"), HasSubstr("camera.fov"));
  EXPECT_THAT(Complaint("\"fov\": 90,", ""), HasSubstr("camera: 'fov' is missing"));
  EXPECT_THAT(Complaint("[40, 20]", "[40]"), HasSubstr("film.size"));
  EXPECT_THAT(Complaint("[40, 20]", "[40, 0.5]"), HasSubstr("film.size"));
  EXPECT_THAT(Complaint("0.3]", "1.3]"), HasSubstr("bsdfs[0].reflectance: 1.3"));
  EXPECT_THAT(Complaint("\"diffuse\"", "\"mirror\""), HasSubstr("bsdfs[0].type: 'mirror'"));
  EXPECT_THAT(Complaint("square.obj", "absent.obj"), HasSubstr("shapes[0].filename"));
  EXPECT_THAT(Complaint("square.obj", "../square.obj"), HasSubstr("shapes[0].filename"));
  EXPECT_THAT(Complaint("\"shape\": \"lamp\"", "\"shape\": \"bulb\""),
              HasSubstr("entities[1].shape: there is no shape 'bulb'"));
  EXPECT_THAT(Complaint("\"name\": \"lit\"", "\"name\": \"floor\""), HasSubstr("twice"));
  EXPECT_THAT(Complaint("\"area\"", "\"point\""), HasSubstr("lights[0].type: 'point'"));
  EXPECT_THAT(Complaint("0,0,3,0", "0,0,0,0"), HasSubstr("shapes[1].transform"));
  EXPECT_THAT(Complaint("[1,0,0,0, 0,1,0,2", "[2,0,0,0, 0,1,0,2"), HasSubstr("camera.transform"));
  EXPECT_THAT(Complaint("\"textures\": []", "\"textures\": [{}]"), HasSubstr("textures"));
  EXPECT_THAT(Complaint("\"film\": {", "\"film\": {\"gamma\": 2, "), HasSubstr("film.gamma"));
  EXPECT_THAT(Complaint("\"lamp\", \"type\": \"obj\", \"filename\": \"square.obj\"",
                        "\"lamp\", \"type\": \"obj\", \"filename\": \"triangle.obj\""),
              HasSubstr("lights[0].entity: its shape is not one parallelogram"));
  EXPECT_THAT(Complaint("\"camera\"", "camera"), HasSubstr("not JSON"));
  EXPECT_THAT(Complaint("\"camera\"", "camera"), StartsWith((folder_ / "scene.json").string()));
  EXPECT_THROW(LoadForeignScene(folder_ / "none.json"), ForeignSceneError);
}

}  // namespace
}  // namespace aisle::sim
