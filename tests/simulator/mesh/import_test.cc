#include "simulator/mesh/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "simulator/mesh/pose.h"
#include "tests/simulator/mesh/scratch.h"
#include "tests/support/test_data.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = TestData("models");

#define SKIP_WITHOUT_MODELS() \
  if (!fs::exists(kModels)) GTEST_SKIP() << "no real models at " << kModels

struct Bounds {
  Eigen::Vector3f low, high;
};

Bounds BoundsOf(const std::vector<Eigen::Vector3f>& points) {
  Bounds bounds{points.front(), points.front()};
  for (const Eigen::Vector3f& point : points) {
    bounds.low = bounds.low.cwiseMin(point);
    bounds.high = bounds.high.cwiseMax(point);
  }
  return bounds;
}

void ExpectBounds(const Bounds& bounds, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  const float tolerance = 1e-4f * (high - low).norm();
  EXPECT_LT((bounds.low - low).norm(), tolerance) << bounds.low.transpose();
  EXPECT_LT((bounds.high - high).norm(), tolerance) << bounds.high.transpose();
}

Bounds FoxAt(const Model& fox, const std::string& clip, double time_s) {
  const PoseLayer layer{fox.FindClip(clip), time_s, 1, -1};
  std::vector<Eigen::Vector3f> positions, normals;
  SkinVertices(fox, JointMatrices(fox, PoseNodes(fox, {&layer, 1})), &positions, &normals);
  return BoundsOf(positions);
}

TEST(ImportModel, TheFoxIsWhereTheReferenceSays) {
  SKIP_WITHOUT_MODELS();
  ImportOptions options;
  options.frame = ModelFrame::kAsStored;
  const Model fox = ImportModel(kModels / "Fox.glb", options);
  EXPECT_EQ(fox.joints.size(), 24u);
  ExpectBounds(BoundsOf(fox.mesh.positions), {-12.592719f, -0.121744f, -88.095006f},
               {12.592717f, 78.907198f, 66.62486f});
  ExpectBounds(FoxAt(fox, "Walk", 0.35), {-12.778858f, -0.026482f, -91.326738f},
               {12.406456f, 74.459864f, 70.043058f});
  ExpectBounds(FoxAt(fox, "Run", 0.5), {-13.145187f, -1.251693f, -95.988523f},
               {14.062113f, 73.817078f, 68.206712f});
  EXPECT_FALSE(fox.textures.empty());
  EXPECT_GE(fox.materials[0].albedo_texture, 0);
}

TEST(ImportModel, YUpBecomesZUp) {
  SKIP_WITHOUT_MODELS();
  const Model fox = ImportModel(kModels / "Fox.glb");
  ExpectBounds(BoundsOf(fox.mesh.positions), {-12.592719f, -66.62486f, -0.121744f},
               {12.592717f, 88.095006f, 78.907198f});
}

TEST(ImportModel, AWarehouseKitLoadsUprightAndTextured) {
  SKIP_WITHOUT_MODELS();
  for (const std::string kind : {"ShelfF", "ClutteringA", "PalletJackB"}) {
    const std::string name = fmt::format("aws_robomaker_warehouse_{}_01", kind);
    const fs::path folder = kModels / "aws-warehouse" / name;
    ImportOptions options;
    options.root = folder;
    const Model model = ImportModel(folder / "meshes" / (name + "_visual.DAE"), options);
    const Bounds bounds = BoundsOf(model.mesh.positions);
    EXPECT_NEAR(bounds.low.z(), 0, 0.1) << kind << " does not stand on the floor";
    EXPECT_GT(bounds.high.z(), 0.8) << kind;
    EXPECT_LT(bounds.high.z(), 8) << kind << ": centimetres taken for metres?";
    EXPECT_FALSE(model.textures.empty()) << kind;
    // A texture's colour multiplies nothing else in COLLADA.
    for (const Material& material : model.materials) {
      EXPECT_TRUE(material.albedo_texture < 0 || material.albedo == 1);
    }
  }
}

TEST(ImportModel, NothingOutsideTheRootIsOpened) {
  SKIP_WITHOUT_MODELS();
  const std::string name = "aws_robomaker_warehouse_ShelfF_01";
  const fs::path file = kModels / "aws-warehouse" / name / "meshes" / (name + "_visual.DAE");
  EXPECT_THROW(ImportModel(file), ImportError) << "its textures lie in a neighbouring folder";
}

TEST(ImportModel, AnObjHasItsMaterialAndPolygonsBecomeTriangles) {
  const Scratch scratch;
  scratch.Write("box.mtl", "newmtl grey\nKd 0.25 0.25 0.25\n");
  const fs::path file = scratch.Write(
      "box.obj", "mtllib box.mtl\nusemtl grey\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const Model model = ImportModel(file);
  EXPECT_EQ(model.mesh.triangles.size(), 2u);
  EXPECT_NEAR(model.materials[model.mesh.materials[0]].albedo, 0.25f, 1e-6);
  EXPECT_TRUE(model.mesh.positions[2].isApprox(Eigen::Vector3f(1, 0, 1)));
  EXPECT_TRUE(model.mesh.normals[0].isApprox(Eigen::Vector3f(0, -1, 0)));
}

TEST(ImportModel, EveryBadFileGivesOneClearError) {
  const Scratch scratch;
  EXPECT_THAT(ErrorOf("nowhere.glb"), testing::HasSubstr("there is no such file"));
  EXPECT_THAT(ErrorOf(scratch.Write("a.ply", "ply\n")), testing::HasSubstr("models are .glb"));
  EXPECT_THAT(ErrorOf(scratch.Write("b.glb", "glTF broken")), testing::HasSubstr("it is cut"));
  EXPECT_THAT(ErrorOf(scratch.Write("c.glb", "")), testing::HasSubstr("it is empty"));
  EXPECT_THAT(ErrorOf(scratch.Write("d.obj", "v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")),
              testing::HasSubstr("d.obj"));
  ImportOptions tight;
  tight.max_triangles = 1;
  EXPECT_THAT(
      ErrorOf(scratch.Write("e.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 3 2 1\n"), tight),
      testing::HasSubstr("the limit is 1"));
}

/// The triangle of an OBJ file with a texture.
constexpr const char* kTexturedObj =
    "mtllib t.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
    "f 1/1 2/2 3/3\n";

TEST(ImportModel, AMissingTextureIsNamed) {
  const Scratch scratch;
  scratch.Write("t.mtl", "newmtl m\nmap_Kd nowhere.png\n");
  EXPECT_THAT(ErrorOf(scratch.Write("t.obj", kTexturedObj)), testing::HasSubstr("nowhere.png"));
}

TEST(ImportModel, ACorruptOrHugeTextureIsNamed) {
  const Scratch scratch;
  scratch.Write("t.mtl", "newmtl m\nmap_Kd t.png\n");
  const fs::path model = scratch.Write("t.obj", kTexturedObj);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", cv::Mat1b(20, 30, std::uint8_t{9}), bytes);
  std::string png(bytes.begin(), bytes.end());
  scratch.Write("t.png", png);
  EXPECT_EQ(ErrorOf(model), "");
  scratch.Write("t.png", "no picture at all, but long enough for a header");
  EXPECT_THAT(ErrorOf(model), testing::HasSubstr("neither PNG nor JPEG"));
  png[18] = 20000 >> 8;  // the width, as its header claims
  png[19] = 20000 & 255;
  scratch.Write("t.png", png);
  EXPECT_THAT(ErrorOf(model), testing::HasSubstr("20000x20 pixels, the limit is 8192"));
}

/// A closed cube of side 1 in one node of a COLLADA file.
std::string CubeIn(const std::string& matrix) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="meter"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
 <source id="p"><float_array id="pa" count="24">
   0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</float_array>
  <technique_common><accessor source="#pa" count="8" stride="3"><param name="X" type="float"/>
   <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
 </source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
 <triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>
  0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="n"><matrix>)" +
         matrix + R"(</matrix><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

/// Positive where triangles are counter-clockwise from outside.
float SignedVolume(const TriangleMesh& mesh) {
  float six_fold = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six_fold += mesh.positions[a].dot(mesh.positions[b].cross(mesh.positions[c]));
  }
  return six_fold / 6;
}

TEST(ImportModel, AMirroredColladaNodeIsNotInsideOut) {
  const Scratch scratch;
  for (const char* matrix : {"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1",
                             "0 -2 0 3 1 0 0 0 0 0 -1 0 0 0 0 1"}) {
    const TriangleMesh mesh = ImportModel(scratch.Write("cube.dae", CubeIn(matrix))).mesh;
    EXPECT_GT(SignedVolume(mesh), 0.9f) << matrix;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3f outwards =
          (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
      EXPECT_GT(outwards.dot(mesh.normals[a]), 0) << matrix;
    }
  }
}

TEST(ImportModel, AShearedColladaNodeIsRefused) {
  const Scratch scratch;
  const fs::path file = scratch.Write("cube.dae", CubeIn("1 2 0 0 0 1 0 0 0 0 1 0 0 0 0 1"));
  EXPECT_THAT(ErrorOf(file),
              testing::HasSubstr("node 'n' is not made of translation, rotation and scale"));
}

TEST(ImportModel, NormalsThatSayNoDirectionAreAsNone) {
  const Scratch scratch;
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\n";
  const fs::path without = scratch.Write("without.obj", corners + "f 1 2 3\nf 1 3 4\n");
  const fs::path zero =
      scratch.Write("zero.obj", corners + "vn 0 0 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
  const Model expected = ImportModel(without), model = ImportModel(zero);
  ASSERT_EQ(model.mesh.triangles.size(), expected.mesh.triangles.size());
  for (std::size_t i = 0; i < model.mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto normal_of = [&](const TriangleMesh& mesh) -> const Eigen::Vector3f& {
        return mesh.normals[mesh.triangles[i][k]];
      };
      EXPECT_EQ(normal_of(model.mesh), normal_of(expected.mesh));
      EXPECT_NEAR(normal_of(model.mesh).norm(), 1, 1e-6);
    }
  }
}

/// A triangle whose material has a normal map of strength 0.5: positions, texture coordinates and
/// indices are in the buffer.
constexpr const char* kBumpyTriangle = R"({
  "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2,
                              "material": 0}]}],
  "materials": [{"normalTexture": {"index": 0, "scale": 0.5}}],
  "textures": [{"source": 0}], "images": [{"uri": "bumps.png"}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
     "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
    {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                  {"buffer": 0, "byteOffset": 36, "byteLength": 24},
                  {"buffer": 0, "byteOffset": 60, "byteLength": 6}],
  "buffers": [{"byteLength": 66, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAABAAIA"}]
})";

TEST(ImportModel, ANormalMapComesInColourAndWithItsStrength) {
  const Scratch scratch;
  std::vector<std::uint8_t> png;
  cv::imencode(".png", cv::Mat3b(4, 4, cv::Vec3b(250, 128, 200)), png);
  scratch.Write("bumps.png", std::string(png.begin(), png.end()));
  const Model model = ImportModel(scratch.Write("bumpy.gltf", kBumpyTriangle));
  const Material& material = model.materials.at(model.mesh.materials.at(0));
  EXPECT_FLOAT_EQ(material.normal_scale, 0.5f);
  ASSERT_GE(material.normal_texture, 0);
  const cv::Mat map = model.textures.at(static_cast<std::size_t>(material.normal_texture)).image;
  ASSERT_EQ(map.type(), CV_8UC3);
  EXPECT_EQ(map.at<cv::Vec3b>(1, 1), cv::Vec3b(200, 128, 250)) << "red, green, blue: x, y, z";
}

TEST(ImportModel, OneFileAloneTakesNoPictureFromBesideIt) {
  const Scratch scratch;
  ImportOptions alone;
  alone.one_file = true;
  const auto file = scratch.Write("bumpy.gltf", kBumpyTriangle);
  EXPECT_THAT(ErrorOf(file, alone),
              testing::HasSubstr("images[0].uri: it names a separate file, bumps.png; save the "
                                 "model as one .glb, or make one file of it: aisle import-mesh "
                                 "bumpy.gltf"));
}

TEST(ImportModel, TheColourSaysWhichTextureCoordinatesAreRead) {
  const Scratch scratch;
  std::vector<std::uint8_t> png;
  cv::imencode(".png", cv::Mat3b(4, 4, cv::Vec3b(250, 128, 200)), png);
  scratch.Write("bumps.png", std::string(png.begin(), png.end()));
  const auto with = [&](const std::string& attributes, const std::string& material) {
    std::string text = kBumpyTriangle;
    const auto put = [&](const std::string& old, const std::string& now) {
      text.replace(text.find(old), old.size(), now);
    };
    put(R"("TEXCOORD_0": 1)", attributes);
    put(R"("normalTexture": {"index": 0, "scale": 0.5})", material);
    return ImportModel(scratch.Write("sets.gltf", text));
  };
  const std::string colour = R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0)";
  const Model first = with(R"("TEXCOORD_0": 1)", colour + "}}");
  ASSERT_FALSE(first.mesh.uvs[1].isZero());
  // The second set is read where the colour names it, and only there.
  EXPECT_EQ(with(R"("TEXCOORD_1": 1)", colour + R"(, "texCoord": 1}})").mesh.uvs, first.mesh.uvs);
  EXPECT_TRUE(with(R"("TEXCOORD_1": 1)", colour + "}}").mesh.uvs[1].isZero());
  // A normal map has its own only where no colour has others.
  const std::string bumps = R"("normalTexture": {"index": 0, "texCoord": 1})";
  const Model alone = with(R"("TEXCOORD_1": 1)", bumps);
  EXPECT_EQ(alone.mesh.uvs, first.mesh.uvs);
  EXPECT_GE(alone.materials[0].normal_texture, 0);
  const Model both = with(R"("TEXCOORD_0": 1)", colour + "}}, " + bumps);
  EXPECT_EQ(both.materials[0].normal_texture, -1);
  EXPECT_THAT(both.left_out,
              testing::ElementsAre("1 normal map on other coordinates than its colour"));
}

/// The first material of the bumpy triangle with this one in its place; its image is half one
/// colour, half another (blue, green, red).
Material MaterialOf(const std::string& json, const cv::Vec3b& left = {},
                    const cv::Vec3b& right = {}) {
  const Scratch scratch;
  cv::Mat3b picture(4, 4, left);
  picture.colRange(2, 4) = right;
  std::vector<std::uint8_t> png;
  cv::imencode(".png", picture, png);
  scratch.Write("bumps.png", std::string(png.begin(), png.end()));
  std::string text = kBumpyTriangle;
  const std::string old = R"({"normalTexture": {"index": 0, "scale": 0.5}})";
  text.replace(text.find(old), old.size(), json);
  return ImportModel(scratch.Write("metal.gltf", text)).materials.at(0);
}

/// What comes back of light from straight ahead, if a lobe is only where it is narrow enough.
float ReflectedBy(const Material& material) {
  return material.albedo + (material.roughness < kDullRoughness ? material.specular_f0 : 0);
}

TEST(ImportModel, AMetalReflectsItsColourHoweverRough) {
  const auto with = [](const std::string& factors) {
    return MaterialOf(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1])" +
                      factors + "}}");
  };
  EXPECT_NEAR(ReflectedBy(MaterialOf("{}")), 1, 1e-6) << "a white metal is what glTF takes it for";
  EXPECT_NEAR(ReflectedBy(with("")), 0.8, 1e-6);
  for (const char* roughness : {"0.1", "0.39", "0.4", "0.7", "1"}) {
    const std::string rough = std::string(R"(, "roughnessFactor": )") + roughness;
    EXPECT_NEAR(ReflectedBy(with(rough)), 0.8, 1e-6) << roughness;
    EXPECT_GE(ReflectedBy(with(rough + R"(, "metallicFactor": 0.5)")), 0.4) << roughness;
  }
  EXPECT_EQ(with(R"(, "roughnessFactor": 0.2)").albedo, 0) << "all of it is the lobe's";
}

TEST(ImportModel, AMapOfMetalAndRoughnessCountsByItsMean) {
  const std::string map = R"("metallicRoughnessTexture": {"index": 0})";
  // Half metal, half not: blue. A fifth and three fifths of roughness: green.
  const cv::Vec3b metal(255, 51, 255), paint(0, 153, 255);
  const Material dull = MaterialOf(R"({"pbrMetallicRoughness": {)" + map + "}}", metal, paint);
  EXPECT_NEAR(dull.roughness, 0.4, 1e-3);
  EXPECT_NEAR(ReflectedBy(dull), 1, 0.05);
  const Material keen = MaterialOf(
      R"({"pbrMetallicRoughness": {"roughnessFactor": 0.5, )" + map + "}}", metal, paint);
  EXPECT_NEAR(keen.roughness, 0.2, 1e-3);
  EXPECT_NEAR(keen.albedo, 0.5, 1e-3);
  EXPECT_NEAR(keen.specular_f0, 0.5 + 0.5 * 0.04, 1e-3);
  EXPECT_NEAR(
      MaterialOf(R"({"pbrMetallicRoughness": {"metallicFactor": 0, )" + map + "}}", metal, paint)
          .albedo,
      1, 1e-6);
}

TEST(ImportModel, APolishedMetalIsAsBrightAsItsTextureIsOnAverage) {
  const Material metal = MaterialOf(
      R"({"pbrMetallicRoughness": {"roughnessFactor": 0.1, "baseColorTexture": {"index": 0}}})",
      {255, 255, 255}, {0, 0, 0});
  EXPECT_NEAR(metal.specular_f0, 0.5, 1e-6);
}

TEST(ImportModel, AnIndexOutOfRangeIsAnError) {
  const Scratch scratch;
  EXPECT_NE(ErrorOf(scratch.Write("i.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n")), "");
}

TEST(ImportModel, NodesMustFormATree) {
  const Scratch scratch;
  const auto with_nodes = [&](const std::string& nodes) {
    return ErrorOf(scratch.Write("n.gltf",
                                 "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,"
                                 "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[" +
                                     nodes + "]}"));
  };
  EXPECT_THAT(with_nodes(R"({"children":[1]},{"children":[0]})"),
              testing::HasSubstr("hangs below itself"));
  EXPECT_THAT(with_nodes(R"({"children":[0]})"), testing::HasSubstr("hangs below itself"));
  EXPECT_THAT(with_nodes(R"({"children":[7]})"), testing::HasSubstr("does not exist"));
  EXPECT_THAT(with_nodes(R"({"children":[2]},{"children":[2]},{})"),
              testing::HasSubstr("child of node 0 and of node 1"));
  std::string chain;
  for (int i = 1; i < 2000; ++i) chain += fmt::format("{{\"children\":[{}]}},", i);
  EXPECT_THAT(with_nodes(chain + "{}"), testing::HasSubstr("one below another"));
}

TEST(ImportModel, ATruncatedModelNeverCrashes) {
  SKIP_WITHOUT_MODELS();
  std::ifstream stream(kModels / "Fox.glb", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  const Scratch scratch;
  for (std::size_t length = 0; length < whole.size(); length += whole.size() / 23) {
    EXPECT_NE(ErrorOf(scratch.Write("cut.glb", whole.substr(0, length))), "") << length;
  }
}

TEST(GreyOf, KeepsGreyAndWeighsColoursInLinearLight) {
  const cv::Mat grey(1, 1, CV_8UC3, cv::Scalar(77, 77, 77));
  EXPECT_EQ(GreyOf(grey, Band::kLuminance)(0, 0), 77);
  const cv::Mat green(1, 1, CV_8UC3, cv::Scalar(0, 255, 0));
  // 0.7152 linear is 0.8628 encoded.
  EXPECT_NEAR(GreyOf(green, Band::kLuminance)(0, 0), 220, 1);
  EXPECT_EQ(GreyOf(green, Band::kRed)(0, 0), 0);
}

TEST(DecodeImage, TheHeaderIsBelievedBeforeThePixelsAreTouched) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", cv::Mat1b(20, 30, std::uint8_t{9}), bytes);
  EXPECT_EQ(DecodeImage(bytes, "t", 64).cols, 30);
  EXPECT_THROW(DecodeImage(bytes, "t", 16), ImportError);
  bytes[17] = 0xFF;  // claims to be huge
  EXPECT_THROW(DecodeImage(bytes, "t", 8192), ImportError);
  EXPECT_THROW(DecodeImage({'G', 'I', 'F', '8'}, "t", 64), ImportError);
  cv::imencode(".jpg", cv::Mat1b(20, 30, std::uint8_t{9}), bytes);
  EXPECT_EQ(DecodeImage(bytes, "t", 64).rows, 20);
  EXPECT_THROW(DecodeImage(bytes, "t", 16), ImportError);
}

}  // namespace
}  // namespace aisle::sim
