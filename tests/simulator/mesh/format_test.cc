#include "simulator/mesh/model_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tests/simulator/mesh/scratch.h"

namespace aisle::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
constexpr const char* kCollada = "<?xml version=\"1.0\"?><!-- <x> --><COLLADA version=\"1.4.1\"/>";

TEST(FormatOf, ANameThatSaysOtherwiseIsRefusedAndBothAreNamed) {
  const Scratch scratch;
  EXPECT_THAT(ErrorOf(scratch.Write("a.glb", kObj)),
              AllOf(HasSubstr("named .glb"), HasSubstr("holds OBJ text"), HasSubstr("a.obj")));
  EXPECT_THAT(ErrorOf(scratch.Write("b.glb", kCollada)),
              AllOf(HasSubstr("named .glb"), HasSubstr("holds COLLADA"), HasSubstr("b.dae")));
  EXPECT_THAT(ErrorOf(scratch.Write("c.obj", kCollada)), HasSubstr("c.dae"));
  EXPECT_THAT(ErrorOf(scratch.Write("d.dae", kObj)), HasSubstr("d.obj"));
  EXPECT_THAT(ErrorOf(scratch.Write("e.gltf", "glTF\2")), HasSubstr("e.glb"));
  EXPECT_THAT(ErrorOf(scratch.Write("f.glb", "{}")), HasSubstr("f.gltf"));
  EXPECT_THAT(ErrorOf(scratch.Write("g.dae", "<html></html>")), HasSubstr("does not hold COLLADA"));
  EXPECT_THAT(ErrorOf(scratch.Write("h.glb", "\x89PNG\r\n")), HasSubstr("does not hold a binary"));
  EXPECT_THAT(ErrorOf(scratch.Write("i.OBJ", kObj)), "");
}

TEST(CheckObj, EveryMistakeIsNamedWithItsLine) {
  const Scratch scratch;
  const auto error = [&](const std::string& text) { return ErrorOf(scratch.Write("o.obj", text)); };
  const std::string three = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_THAT(error(three + "f 1 2 9\n"), HasSubstr("line 4: vertex 9 does not exist"));
  EXPECT_THAT(error(three + "f 1 2 -4\n"), HasSubstr("line 4: vertex -4 does not exist"));
  EXPECT_THAT(error(three + "f 1 2 0\n"), HasSubstr("line 4: vertex 0 does not exist"));
  EXPECT_THAT(error(three + "f 1/1 2/1 3/1\n"), HasSubstr("texture coordinate 1 does not"));
  EXPECT_THAT(error(three + "f 1 2\n"), HasSubstr("line 4: f has 2 corners"));
  EXPECT_THAT(error(three + "f 1 2 x\n"), HasSubstr("'x' is not a corner"));
  EXPECT_THAT(error("# made by hand\nv 0 0 nan\n"), HasSubstr("line 2: expected a finite"));
  EXPECT_THAT(error("v 0 0\n"), HasSubstr("line 1: v has 2 numbers"));
  EXPECT_THAT(error(three + "f 1 2 3\ncurv 0 1 1 2\n"), HasSubstr("line 5: 'curv'"));
  EXPECT_THAT(error(three + "f 1 2 \\\n 3\n"), "");
}

TEST(ImportModel, AbsurdCoordinatesAreRefusedWithTheBound) {
  const Scratch scratch;
  EXPECT_THAT(ErrorOf(scratch.Write("far.obj", "v 0 0 0\nv 1 0 0\nv -9.2e18 1 0\nf 1 2 3\n")),
              HasSubstr("more than 10000 m from the model's origin"));
  ImportOptions wide;
  wide.max_reach_m = 2e19f;
  EXPECT_EQ(ErrorOf(scratch.Write("far.obj", "v 0 0 0\nv 1 0 0\nv -9.2e18 1 0\nf 1 2 3\n"), wide),
            "");
}

/// A triangle in glTF, with places for what a test wants to be wrong.
struct Triangle {
  std::string node = R"("mesh": 0)";
  std::string primitive = R"("attributes": {"POSITION": 0}, "indices": 1)";
  std::string accessor = R"("bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3")";
  std::string view = R"("buffer": 0, "byteLength": 36)";
  std::string more;
  std::array<float, 9> points = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  std::array<std::uint16_t, 4> corners = {0, 1, 2, 0};

  std::string Glb() const {
    std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{{}}}],)"
        R"("meshes":[{{"primitives":[{{{}}}]}}],"accessors":[{{{}}},)"
        R"({{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}}],)"
        R"("bufferViews":[{{{}}},{{"buffer":0,"byteOffset":36,"byteLength":6}}],)"
        R"("buffers":[{{"byteLength":44}}]{}}})",
        node, primitive, accessor, view, more);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    const auto word = [&](std::size_t value) {
      const auto bits = static_cast<std::uint32_t>(value);
      glb.append(reinterpret_cast<const char*>(&bits), 4);
    };
    word(2), word(28 + json.size() + 44), word(json.size()), word(0x4E4F534A);
    glb += json;
    word(44), word(0x004E4942);
    glb.append(reinterpret_cast<const char*>(points.data()), 36);
    glb.append(reinterpret_cast<const char*>(corners.data()), 8);
    return glb;
  }
};

/// The error of a triangle that `change` made wrong.
template <class Change>
std::string ErrorWith(const Change& change) {
  const Scratch scratch;
  Triangle triangle;
  change(&triangle);
  return ErrorOf(scratch.Write("t.glb", triangle.Glb()));
}

TEST(GltfErrors, TheTriangleItselfIsFine) {
  EXPECT_EQ(ErrorWith([](Triangle*) {}), "");
}

TEST(GltfErrors, NameThePlaceInTheJson) {
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->corners[2] = 3; }),
              HasSubstr("meshes[0].primitives[0].indices: a face names vertex 3"));
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->points[4] = NAN; }),
              HasSubstr("accessors[0]: element 1 is not finite"));
  EXPECT_THAT(ErrorWith([](Triangle* t) {
                t->accessor = R"("bufferView":0,"componentType":5126,"count":4,"type":"VEC3")";
              }),
              HasSubstr("accessors[0]: 4 elements of 12 bytes"));
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->view = R"("buffer":0,"byteLength":99)"; }),
              HasSubstr("bufferViews[0]: bytes 0 to 99 are asked for"));
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->view = R"("buffer":1,"byteLength":36)"; }),
              HasSubstr("bufferViews[0].buffer: buffer 1 does not exist"));
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->node = R"("mesh": 7)"; }),
              HasSubstr("nodes[0].mesh: mesh 7 does not exist; there are 1"));
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->primitive = R"("attributes":{"POSITION":5})"; }),
              HasSubstr("POSITION: accessor 5 does not exist"));
  EXPECT_THAT(ErrorWith([](Triangle* t) {
                t->more = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
              }),
              HasSubstr("KHR_draco_mesh_compression is not read"));
}

TEST(GltfErrors, ScalesAndMatricesThatNoModelHas) {
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->node = R"("mesh":0,"scale":[1e5,1e5,1e5])"; }),
              HasSubstr("more than 10000 m"));
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->points[0] = -9.2e18f; }),
              HasSubstr("more than 10000 m"));
  EXPECT_THAT(ErrorWith([](Triangle* t) {
                t->node = R"("mesh":0,"matrix":[1,0,0,0,1,1,0,0,0,0,1,0,0,0,0,1])";
              }),
              HasSubstr("not made of translation, rotation and scale"));
  EXPECT_THAT(ErrorWith([](Triangle* t) { t->node = R"("mesh":0,"rotation":[0,0,0,0])"; }),
              HasSubstr("unit quaternion"));
}

TEST(GltfErrors, MorphTargetsWithWeightAreRefusedAndOthersDoNothing) {
  const std::string targets =
      R"("attributes": {"POSITION": 0}, "indices": 1, "targets": [{"POSITION": 0}])";
  EXPECT_EQ(ErrorWith([&](Triangle* t) { t->primitive = targets; }), "");
  EXPECT_THAT(ErrorWith([&](Triangle* t) {
                t->primitive = targets;
                t->node = R"("mesh": 0, "weights": [0.5])";
              }),
              HasSubstr("nodes[0].weights: morph targets are not read"));
  EXPECT_THAT(ErrorWith([&](Triangle* t) {
                t->primitive = targets;
                t->more = R"(,"animations":[{"samplers":[{"input":1,"output":1}],"channels":)"
                          R"([{"sampler":0,"target":{"node":0,"path":"weights"}}]}])";
              }),
              HasSubstr("channels[0].target: morph targets are not read"));
}

}  // namespace
}  // namespace aisle::sim
