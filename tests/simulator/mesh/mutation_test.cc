/// Files as they come from anyone: broken in hundreds of ways, each loads or gives one clear error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <random>

#include "tests/simulator/mesh/scratch.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr double kLongest_s = 20;          // for one small file, on a busy machine
constexpr long kMostMemory_kb = 1L << 20;  // that all mutants together may add

/// One of the numbers that parsers stumble over, in place of a digit or more of the text.
void MutateNumber(std::string* text, std::mt19937* random) {
  constexpr std::array<const char*, 12> kNumbers = {
      "-1",   "0",       "65536", "99999999999", "4294967295", "2147483648",
      "1e39", "-9.2e18", "1e5",   "nan",         "0.5",        ""};
  const std::size_t from = (*random)() % text->size();
  const std::size_t at = text->find_first_of("0123456789", from);
  if (at == std::string::npos) return;
  const std::size_t end = std::min(text->find_first_not_of("0123456789.", at), text->size());
  text->replace(at, end - at, kNumbers[(*random)() % kNumbers.size()]);
}

/// Bytes changed, cut out, doubled, or the rest lost.
void MutateBytes(std::string* text, std::mt19937* random) {
  const std::size_t at = (*random)() % text->size();
  switch ((*random)() % 6) {
    case 0:
      text->erase(at, 1 + (*random)() % 20);
      break;
    case 1:
      text->insert(at, text->substr((*random)() % text->size(), 1 + (*random)() % 40));
      break;
    case 2:
      text->resize(at);
      break;
    default:
      (*text)[at] = static_cast<char>((*random)());
  }
}

std::string MutatedText(std::string text, std::mt19937* random) {
  for (std::size_t edits = 1 + (*random)() % 3; edits > 0 && !text.empty(); --edits) {
    (*random)() % 3 == 0 ? MutateBytes(&text, random) : MutateNumber(&text, random);
  }
  return text;
}

std::uint32_t WordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

void SetWord(std::string* bytes, std::size_t at, std::size_t word) {
  const auto value = static_cast<std::uint32_t>(word);
  std::memcpy(bytes->data() + at, &value, sizeof(value));
}

/// A third each: any bytes, numbers of the JSON with the chunk lengths made right again, words of
/// the binary chunk.
std::string MutatedGlb(std::string glb, std::mt19937* random) {
  const std::size_t json_size = WordAt(glb, 12);
  switch ((*random)() % 3) {
    case 0:
      MutateBytes(&glb, random);
      return glb;
    case 1: {
      std::string json = glb.substr(20, json_size);
      MutateNumber(&json, random);
      glb.replace(20, json_size, json);
      SetWord(&glb, 12, json.size());
      SetWord(&glb, 8, glb.size());
      return glb;
    }
    default: {
      const std::size_t words = (glb.size() - 28 - json_size) / 4;
      SetWord(&glb, 28 + json_size + 4 * ((*random)() % words), (*random)());
      return glb;
    }
  }
}

/// Counts what became of mutants; fails on anything but a sound model or one clear error.
struct Outcomes {
  int loaded = 0;
  int refused = 0;

  void Try(const fs::path& file, const ImportOptions& options = {}) {
    const auto start = std::chrono::steady_clock::now();
    try {
      ExpectSound(ImportModel(file, options), options);
      ++loaded;
    } catch (const ImportError& error) {
      const std::string what = error.what();
      EXPECT_THAT(what, testing::StartsWith(file.string() + ": "));
      EXPECT_GT(what.size(), file.string().size() + 10) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      ++refused;
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_LT(took.count(), kLongest_s) << file;
  }

  static void ExpectSound(const Model& model, const ImportOptions& options) {
    const std::size_t vertices = model.mesh.positions.size();
    for (const Eigen::Vector3f& p : model.mesh.positions) {
      ASSERT_TRUE(p.cwiseAbs().maxCoeff() <= options.max_reach_m);
    }
    ASSERT_EQ(model.weights.size(), vertices);
    ASSERT_EQ(model.mesh.uvs.size(), vertices);
    for (const auto& triangle : model.mesh.triangles) {
      for (const std::uint32_t corner : triangle) ASSERT_LT(corner, vertices);
    }
    for (const VertexWeights& weights : model.weights) {
      for (const std::uint16_t joint : weights.joints) ASSERT_LT(joint, model.joints.size());
    }
    for (const ModelJoint& joint : model.joints) {
      ASSERT_LT(static_cast<std::size_t>(joint.node), model.nodes.size());
    }
  }
};

long MemoryPeak_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

bool WriteModels(const Scratch& scratch) {
  return std::system(fmt::format("\"{}\" \"{}/tests/support/gltf_models.py\" \"{}\"", AISLE_PYTHON,
                                 AISLE_SOURCE_DIR, scratch.path().string())
                         .c_str()) == 0;
}

/// Runs `count` mutants of one file; both outcomes must occur, or nothing was tried.
template <class Mutate>
void TryMutants(const Scratch& scratch, const std::string& name, const std::string& whole,
                int count, const Mutate& mutate) {
  const long before_kb = MemoryPeak_kb();
  Outcomes outcomes;
  for (int seed = 0; seed < count; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    SCOPED_TRACE(fmt::format("{} with seed {}", name, seed));
    outcomes.Try(scratch.Write(name, mutate(whole, &random)));
  }
  EXPECT_GT(outcomes.loaded, 0) << name;
  EXPECT_GT(outcomes.refused, count / 20) << name;
  EXPECT_LT(MemoryPeak_kb() - before_kb, kMostMemory_kb) << name;
}

TEST(Mutants, OfGlbFilesLoadOrGiveOneError) {
  const Scratch scratch;
  ASSERT_TRUE(WriteModels(scratch));
  for (const std::string name : {"same_names", "splines", "sparse", "quantized", "primitives"}) {
    TryMutants(scratch, name + "_.glb", TextOf(scratch.path() / (name + ".glb")), 200, MutatedGlb);
  }
}

TEST(Mutants, OfGltfFilesLoadOrGiveOneError) {
  const Scratch scratch;
  ASSERT_TRUE(WriteModels(scratch));
  for (const std::string name : {"text_inline", "text_beside"}) {
    TryMutants(scratch, name + "_.gltf", TextOf(scratch.path() / (name + ".gltf")), 200,
               MutatedText);
  }
}

constexpr const char* kObj =
    "mtllib m.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nv 0.5 0.5 1\nvt 0 0\nvt 1 0\n"
    "vt 1 1\nvn 0 0 1\nvn 0 1 0\nusemtl grey\ns 1\nf 1/1/1 2/2/1 3/3/2\nf 1//1 3//1 4//2\n"
    "g other\nusemtl dark\nf 1 2 5\nf -1 -2 -3\nl 1 2\nf 1/1 2/2 3/3 4/1\n";
constexpr const char* kMtl =
    "newmtl grey\nKd 0.25 0.25 0.25\nKe 0 0 0\nNs 10\nd 1\nillum 2\nnewmtl dark\n"
    "Kd 0.1 0.1 0.1\nKs 0.5 0.5 0.5\n";

TEST(Mutants, OfObjFilesLoadOrGiveOneError) {
  const Scratch scratch;
  scratch.Write("m.mtl", kMtl);
  TryMutants(scratch, "m.obj", kObj, 400, MutatedText);
}

TEST(Mutants, OfMaterialLibrariesLoadOrGiveOneError) {
  const Scratch scratch;
  const fs::path model = scratch.Write("m.obj", kObj);
  Outcomes outcomes;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    SCOPED_TRACE(seed);
    scratch.Write("m.mtl", MutatedText(kMtl, &random));
    outcomes.Try(model);
  }
  EXPECT_GT(outcomes.loaded, 50);
}

/// A skinned and animated quad, shown by a node of a library as well.
constexpr const char* kCollada = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
 <source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
  <technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
  <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
 <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
 <polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/>
  <vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_controllers><controller id="c"><skin source="#g">
 <bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
 <source id="j"><Name_array id="ja" count="2">low high</Name_array><technique_common>
  <accessor source="#ja" count="2"><param name="JOINT" type="name"/></accessor></technique_common>
 </source>
 <source id="b"><float_array id="ba" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 1 0 -1 0 0 1 0 0 0 0 1</float_array>
  <technique_common><accessor source="#ba" count="2" stride="16">
  <param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
 <source id="w"><float_array id="wa" count="2">1 0.5</float_array><technique_common>
  <accessor source="#wa" count="2"><param name="WEIGHT" type="float"/></accessor>
  </technique_common></source>
 <joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#b"/></joints>
 <vertex_weights count="4"><input semantic="JOINT" source="#j" offset="0"/>
  <input semantic="WEIGHT" source="#w" offset="1"/><vcount>1 1 2 2</vcount>
  <v>0 0 0 0 0 1 1 1 0 1 1 1</v></vertex_weights>
</skin></controller></library_controllers>
<library_nodes><node id="spare"><instance_geometry url="#g"/></node></library_nodes>
<library_animations><animation id="a">
 <source id="t"><float_array id="ta" count="2">0 1</float_array><technique_common>
  <accessor source="#ta" count="2"><param name="TIME" type="float"/></accessor></technique_common>
 </source>
 <source id="o"><float_array id="oa" count="6">0 1 0 0 2 0</float_array><technique_common>
  <accessor source="#oa" count="2" stride="3"><param name="X" type="float"/>
  <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
 <source id="i"><Name_array id="ia" count="2">LINEAR LINEAR</Name_array><technique_common>
  <accessor source="#ia" count="2"><param name="INTERPOLATION" type="name"/></accessor>
  </technique_common></source>
 <sampler id="s"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#o"/>
  <input semantic="INTERPOLATION" source="#i"/></sampler>
 <channel source="#s" target="high/place"/>
</animation></library_animations>
<library_visual_scenes><visual_scene id="vs">
 <node id="low" sid="low" name="low" type="JOINT"><node id="high" sid="high" name="high" type="JOINT">
  <translate sid="place">0 1 0</translate></node></node>
 <node id="shown"><instance_controller url="#c"><skeleton>#low</skeleton></instance_controller></node>
 <node id="again"><translate>3 0 0</translate><instance_node url="#spare"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene>
</COLLADA>
)";

TEST(Mutants, OfColladaFilesLoadOrGiveOneError) {
  const Scratch scratch;
  const Model whole = ImportModel(scratch.Write("whole.dae", kCollada));
  EXPECT_EQ(whole.mesh.positions.size(), 8u);
  EXPECT_EQ(whole.joints.size(), 3u);
  EXPECT_EQ(whole.clips.size(), 1u);
  TryMutants(scratch, "m.dae", kCollada, 400, MutatedText);
}

TEST(Mutants, AColladaNodeThatContainsItselfIsRefused) {
  const Scratch scratch;
  std::string text = kCollada;
  const std::string inner = "<instance_geometry url=\"#g\"/>";
  text.replace(text.find(inner), inner.size(), "<instance_node url=\"#spare\"/>");
  EXPECT_THAT(ErrorOf(scratch.Write("loop.dae", text)), testing::HasSubstr("contains itself"));
}

}  // namespace
}  // namespace aisle::sim
