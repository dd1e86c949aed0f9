/// Posed models against tests/support/gltf_skinning.py, which reads the files by itself and knows
/// nothing of this importer.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "simulator/mesh/pose.h"
#include "tests/simulator/mesh/scratch.h"
#include "tests/support/test_data.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr double kTolerance_m = 1e-5;  ///< for a model of 1 m; larger ones in proportion

struct ReferencePose {
  int clip = -1;
  double time_s = 0;
  std::vector<Eigen::Vector3d> vertices;
};

bool RunPython(const std::string& script, const std::vector<fs::path>& arguments) {
  std::string command =
      fmt::format("\"{}\" \"{}/tests/support/{}\"", AISLE_PYTHON, AISLE_SOURCE_DIR, script);
  for (const fs::path& argument : arguments) command += fmt::format(" \"{}\"", argument.string());
  return std::system(command.c_str()) == 0;
}

std::vector<ReferencePose> ReadPoses(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<ReferencePose> poses;
  const auto read = [&](void* to, std::size_t size) {
    return static_cast<bool>(
        stream.read(static_cast<char*>(to), static_cast<std::streamsize>(size)));
  };
  ReferencePose pose;
  while (read(&pose.clip, 4)) {
    std::int32_t count = 0;
    if (!read(&pose.time_s, 8) || !read(&count, 4)) break;
    pose.vertices.resize(static_cast<std::size_t>(count));
    if (!read(pose.vertices.data(), pose.vertices.size() * sizeof(Eigen::Vector3d))) break;
    poses.push_back(pose);
  }
  return poses;
}

std::vector<Eigen::Vector3f> Posed(const Model& model, const ReferencePose& at) {
  if (at.clip < 0) return model.mesh.positions;
  const PoseLayer layer{at.clip, at.time_s, 1, -1};
  std::vector<Eigen::Vector3f> positions, normals;
  SkinVertices(model, JointMatrices(model, PoseNodes(model, {&layer, 1})), &positions, &normals);
  return positions;
}

/// Compares every vertex of every pose; the number of poses compared.
int ExpectAsReference(const fs::path& file, const fs::path& poses_dir, const fs::path& root) {
  ImportOptions options;
  options.frame = ModelFrame::kAsStored;
  options.root = root;
  const Model model = ImportModel(file, options);
  const std::vector<ReferencePose> poses = ReadPoses(poses_dir / (file.stem().string() + ".poses"));
  EXPECT_EQ(poses.size(), 1 + 3 * model.clips.size()) << file;
  for (const ReferencePose& pose : poses) {
    const std::vector<Eigen::Vector3f> ours = Posed(model, pose);
    EXPECT_EQ(ours.size(), pose.vertices.size()) << file;
    if (ours.size() != pose.vertices.size()) break;
    double worst = 0, size = 1;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      worst = std::max(worst, (ours[i].cast<double>() - pose.vertices[i]).norm());
      size = std::max(size, pose.vertices[i].norm());
    }
    EXPECT_LT(worst, kTolerance_m * size)
        << file << ", clip " << pose.clip << " at " << pose.time_s << " s";
  }
  return static_cast<int>(poses.size());
}

int CompareAll(const std::vector<fs::path>& files, const Scratch& scratch, const fs::path& root) {
  std::vector<fs::path> arguments = {scratch.path()};
  arguments.insert(arguments.end(), files.begin(), files.end());
  EXPECT_TRUE(RunPython("gltf_skinning.py", arguments));
  int poses = 0;
  for (const fs::path& file : files) poses += ExpectAsReference(file, scratch.path(), root);
  return poses;
}

std::vector<fs::path> ModelsBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".glb" || extension == ".gltf") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

TEST(AgainstAnIndependentSkinning, ModelsThatImportersGetWrong) {
  const Scratch scratch;
  ASSERT_TRUE(RunPython("gltf_models.py", {scratch.path()}));
  const std::vector<fs::path> files = ModelsBelow(scratch.path());
  EXPECT_GE(files.size(), 19u);
  EXPECT_GE(CompareAll(files, scratch, scratch.path()), 70);
}

TEST(AgainstAnIndependentSkinning, OurPeopleAndVehicles) {
  const Scratch scratch;
  const fs::path assets = fs::path(AISLE_SOURCE_DIR) / "assets";
  for (const std::string kind : {"people", "vehicles", "kit", "street"}) {
    const std::vector<fs::path> files = ModelsBelow(assets / kind);
    EXPECT_FALSE(files.empty()) << kind;
    CompareAll(files, scratch, assets);
  }
}

TEST(AgainstAnIndependentSkinning, RealModels) {
  const fs::path models = TestData("models");
  if (!fs::exists(models)) GTEST_SKIP() << "no real models at " << models;
  const Scratch scratch;
  const std::vector<fs::path> files = ModelsBelow(models);
  EXPECT_FALSE(files.empty());
  CompareAll(files, scratch, models);
}

/// The normals of a stretched body stay square to its surface and on its outer side.
TEST(AgainstAnIndependentSkinning, NormalsOfStretchedAndMirroredModelsAreThoseOfTheirTriangles) {
  const Scratch scratch;
  ASSERT_TRUE(RunPython("gltf_models.py", {scratch.path()}));
  for (const std::string name : {"stretched.glb", "mirrored.glb", "matrices.glb"}) {
    const Model model = ImportModel(scratch.path() / name);
    int rigid = 0;
    for (const auto& [a, b, c] : model.mesh.triangles) {
      if (model.weights[a].weights[1] > 0) continue;  // blended, thus only nearly so
      const auto& p = model.mesh.positions;
      const Eigen::Vector3f normal = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
      EXPECT_GT(normal.dot(model.mesh.normals[a]), 0.999f) << name;
      ++rigid;
    }
    EXPECT_GT(rigid, 0) << name;
  }
}

}  // namespace
}  // namespace aisle::sim
