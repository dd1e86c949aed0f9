#include "simulator/import_model.h"

#include <numbers>
#include <set>

#include "simulator/mesh/door/read_model.h"
#include "simulator/mesh/kept/kept_model.h"
#include "simulator/mesh/still.h"
#include "simulator/pipeline.h"
#include "simulator/world/actors.h"
#include "simulator/world/shapes.h"

namespace aisle::sim {
namespace {

constexpr float kShownRadius_m = 1.5f;  ///< to which every model is brought, as light has a scale
constexpr int kWidth = 720, kHeight = 540;

/// The power of ten that is nearest below half the model's radius.
double GridOf(double radius_m) { return std::pow(10, std::floor(std::log10(radius_m))); }

/// A sheet of floor with lines along two of its sides.
Texture GridSheet() {
  constexpr int kSide = 256, kLine = 5;
  cv::Mat1b sheet(kSide, kSide, std::uint8_t{190});
  sheet.rowRange(0, kLine) = 90;
  sheet.colRange(0, kLine) = 90;
  return {"grid", sheet};
}

/// The model in a bright room, on a floor with a grid of `grid_m`, scaled by `scale`.
WorldParts StudioFor(const Model& model, const Eigen::AlignedBox3f& box, float scale,
                     double grid_m) {
  WorldParts parts;
  parts.instances.push_back({"room", ObjectClass::kWall, false});
  parts.instances.push_back({"model", ObjectClass::kFurniture, false});
  parts.textures.push_back(GridSheet());
  parts.materials = {{.name = "floor", .albedo = 1, .albedo_texture = 0},
                     {.name = "wall", .albedo = 0.75f},
                     {.name = "lamp", .albedo = 0.5f, .emission = 2}};
  TriangleMesh& mesh = parts.statics.mesh;
  constexpr float kHalf = 9, kHigh = 6, kLamp = 4;
  const float sheet = scale * static_cast<float>(grid_m);
  const UvRect tiled{Eigen::Vector2f::Constant(-kHalf / sheet),
                     Eigen::Vector2f::Constant(2 * kHalf / sheet)};
  const Eigen::Vector3f x(2 * kHalf, 0, 0), y(0, 2 * kHalf, 0), z(0, 0, kHigh);
  AddQuad(&mesh, {-kHalf, kHalf, 0}, x, -y, tiled, 0);
  AddQuad(&mesh, {-kHalf, kHalf, kHigh}, x, -z, {}, 1);
  AddQuad(&mesh, {kHalf, kHalf, kHigh}, -y, -z, {}, 1);
  AddQuad(&mesh, {kHalf, -kHalf, kHigh}, -x, -z, {}, 1);
  AddQuad(&mesh, {-kHalf, -kHalf, kHigh}, y, -z, {}, 1);
  AddQuad(&mesh, {-kHalf, -kHalf, kHigh}, x, y, {}, 1);
  const Eigen::Vector3f lamp(3, -4, kHigh - 0.05f);  // over the photographer
  AddQuad(&mesh, lamp + Eigen::Vector3f(-kLamp, -kLamp, 0), {2 * kLamp, 0, 0}, {0, 2 * kLamp, 0},
          {}, 2);
  parts.lights.push_back({lamp, {kLamp, 0, 0}, {0, -kLamp, 0}, 2});
  parts.statics.instances.resize(mesh.triangles.size(), 1);
  Wardrobe wardrobe(&parts);
  TriangleMesh shown = wardrobe.Wear(std::make_shared<const Model>(model));
  const Eigen::Vector3f foot(box.center().x(), box.center().y(), box.min().z());
  for (Eigen::Vector3f& position : shown.positions) position = scale * (position - foot);
  AddMesh(&mesh, Eigen::Isometry3f::Identity(), shown);
  parts.statics.instances.resize(mesh.triangles.size(), 2);
  return parts;
}

/// A camera at `from` that looks at a point.
Eigen::Isometry3d LookAt(const Eigen::Vector3d& from, const Eigen::Vector3d& at) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d ahead = (at - from).normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  pose.linear() << right, ahead.cross(right), ahead;
  pose.translation() = from;
  return pose;
}

/// From its front right, a little above.
cv::Mat1b Photograph(const Model& model, const Eigen::AlignedBox3f& box, double grid_m) {
  const float radius = std::max(0.5f * box.diagonal().norm(), 1e-4f);
  const float scale = kShownRadius_m / radius;
  StereoCamera camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.fx = camera.fy = 600;
  camera.cx = (kWidth - 1) / 2.0;
  camera.cy = (kHeight - 1) / 2.0;
  PipelineOptions options;
  options.auto_exposure.on = true;
  options.auto_exposure.longest_ms = 60;
  options.sensor.tone = Tone::kCompanded;
  options.sensor.noise = false;
  const Pipeline pipeline(World(StudioFor(model, box, scale, grid_m)), camera, options);
  const Eigen::Vector3d middle(0, 0, 0.5 * scale * box.sizes().z());
  const Eigen::Vector3d from = middle + 3.6 * Eigen::Vector3d(0.75, -0.85, 0.5).normalized() *
                                            static_cast<double>(kShownRadius_m) / 1.5 * 1.15;
  return pipeline.Render(0, 0, LookAt(from, middle)).left;
}

UpAxis UpNamed(char up) {
  return up == 'x'   ? UpAxis::kX
         : up == 'y' ? UpAxis::kY
         : up == 'z' ? UpAxis::kZ
                     : UpAxis::kAsStated;
}

std::vector<std::string> ShownNodes(const Model& model) {
  std::set<int> shown;
  for (const int node : NodesOfTriangles(model)) shown.insert(node);
  std::vector<std::string> names;
  for (const int node : shown) names.push_back(model.nodes[static_cast<std::size_t>(node)].name);
  return names;
}

}  // namespace

ImportedModel ImportUserModel(const ModelImport& request) {
  ImportOptions options;
  options.colour = true;
  options.unit_m = static_cast<float>(request.unit_m);
  options.up = UpNamed(request.up);
  options.must_state = true;
  Model model = ReadModel(request.file, options);
  if (!request.skinned) model = StillOf(std::move(model));
  ModelRecord record;
  record.source = std::filesystem::path(request.file).filename().string();
  record.source_hash = HashOfModelFile(request.file);
  record.licence = request.licence;
  record.unit_m = request.unit_m;
  if (request.up != 0) record.up = std::string(1, request.up);
  record = KeepModel(model, std::move(record), request.output);
  ImportedModel imported;
  imported.low_m = record.low_m;
  imported.high_m = record.high_m;
  imported.triangles = record.triangles;
  imported.materials = model.materials.size();
  imported.textures = model.textures.size();
  imported.nodes = ShownNodes(model);
  for (const Clip& clip : model.clips) imported.clips.push_back(clip.name);
  imported.left_out = model.left_out;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& position : model.mesh.positions) box.extend(position);
  imported.grid_m = GridOf(std::max(0.5 * box.diagonal().norm(), 1e-4));
  imported.picture = Photograph(model, box, imported.grid_m);
  return imported;
}

}  // namespace aisle::sim
