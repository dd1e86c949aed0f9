/// Files as they come from anyone: broken in hundreds of ways, each loads or gives one clear error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <random>

#include "tests/simulator/mesh/mutants.h"
#include "tests/simulator/mesh/scratch.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr double kLongest_s = 20;          // for one small file, on a busy machine
constexpr long kMostMemory_kb = 1L << 20;  // that all mutants together may add

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

/// Runs mutants of one file; both outcomes must occur, or nothing was tried.
template <class Mutate>
void TryMutants(const Scratch& scratch, const std::string& name, const std::string& whole,
                int usual, const Mutate& mutate) {
  const long before_kb = MemoryPeak_kb();
  Outcomes outcomes;
  const int count = MutantsWanted(usual);
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
