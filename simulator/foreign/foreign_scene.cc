#include "simulator/foreign/foreign_scene.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "simulator/mesh/door/read_model.h"
#include "simulator/mesh/gltf_value.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr float kReach_m = 10;  // of the farthest coordinate, after scaling
constexpr std::size_t kMaxSide = 16384, kMaxEntities = 60'000;

using Rgb = std::array<float, 3>;
using Names = std::map<std::string, std::size_t>;

/// The one thing that a member names.
std::size_t Find(const GltfValue& value, const char* key, const Names& names, const char* what) {
  const GltfValue name = value.Get(key);
  const auto found = names.find(name.Text());
  if (found == names.end()) name.Fail(fmt::format("there is no {} '{}'", what, name.Text()));
  return found->second;
}

/// Something read that others name.
void Register(const GltfValue& value, Names* names) {
  const GltfValue name = value.Get("name");
  if (!names->try_emplace(name.Text(), names->size()).second) {
    name.Fail(fmt::format("'{}' is there twice", name.Text()));
  }
}

void RequireType(const GltfValue& value, const char* expected) {
  const GltfValue type = value.Get("type");
  if (type.Text() != expected) {
    type.Fail(fmt::format("'{}' is not read, only '{}'", type.Text(), expected));
  }
}

Rgb Colour(const GltfValue& value, const char* key, float most) {
  const GltfValue member = value.Get(key);
  const std::vector<float> numbers = value.Numbers(key, 3);
  for (const float x : numbers) {
    if (x < 0 || x > most) member.Fail(fmt::format("{} is not from 0 to {}", x, most));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

/// A row-major 4 × 4 matrix; identity when it is absent.
Eigen::Affine3f Transform(const GltfValue& value) {
  Eigen::Affine3f transform = Eigen::Affine3f::Identity();
  const std::vector<float> m = value.Numbers("transform", 16);
  if (m.empty()) return transform;
  transform.matrix() = Eigen::Map<const Eigen::Matrix<float, 4, 4, Eigen::RowMajor>>(m.data());
  const GltfValue member = value.Get("transform");
  if (transform.matrix().row(3) != Eigen::RowVector4f(0, 0, 0, 1)) {
    member.Fail("its last row is not 0, 0, 0, 1");
  }
  if (std::abs(transform.linear().determinant()) < 1e-12f) member.Fail("it flattens space");
  return transform;
}

/// Refuses members that nobody reads.
void Allow(const json& object, const std::string& path, std::initializer_list<const char*> known) {
  if (!object.is_object()) return;  // whoever reads it says so
  for (const auto& [key, value] : object.items()) {
    if (std::ranges::none_of(known, [&](const char* name) { return key == name; })) {
      throw ImportError(fmt::format("{}{}: is not read", path, key));
    }
  }
}

void AllowInEach(const json& document, const char* list, std::initializer_list<const char*> known) {
  if (!document.contains(list) || !document[list].is_array()) return;
  for (std::size_t i = 0; i < document[list].size(); ++i) {
    Allow(document[list][i], fmt::format("{}[{}].", list, i), known);
  }
}

void CheckKeys(const json& document) {
  Allow(document, "", {"camera", "film", "textures", "bsdfs", "shapes", "entities", "lights"});
  if (document.contains("camera")) {
    Allow(document["camera"], "camera.", {"type", "transform", "fov", "near_clip", "far_clip"});
  }
  if (document.contains("film")) Allow(document["film"], "film.", {"size"});
  AllowInEach(document, "textures", {});
  AllowInEach(document, "bsdfs", {"name", "type", "reflectance"});
  AllowInEach(document, "shapes", {"name", "type", "filename", "transform"});
  AllowInEach(document, "entities", {"name", "shape", "bsdf"});
  AllowInEach(document, "lights", {"name", "type", "entity", "radiance"});
}

/// The parallelogram that a mesh of two triangles is, shining to the side from which its corners
/// go round counter-clockwise.
std::optional<AreaLight> ParallelogramOf(const TriangleMesh& mesh) {
  if (mesh.triangles.size() != 2) return std::nullopt;
  const auto corner = [&](std::size_t triangle, std::size_t k) {
    return mesh.positions[mesh.triangles[triangle][k % 3]];
  };
  for (std::size_t tip = 0; tip < 3; ++tip) {
    const Eigen::Vector3f at = corner(0, tip), next = corner(0, tip + 1), last = corner(0, tip + 2);
    const float near = 1e-4f * ((next - at).norm() + (last - at).norm());
    const auto is = [near](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
      return (a - b).norm() < near;
    };
    for (std::size_t far = 0; far < 3; ++far) {  // the two share `next` and `last`
      if (is(corner(1, far), next + last - at) && is(corner(1, far + 1), last) &&
          is(corner(1, far + 2), next)) {
        return AreaLight{(next + last) / 2, (next - at) / 2, (last - at) / 2, 0};
      }
    }
  }
  return std::nullopt;
}

/// Reads the document part by part; each keeps what the later ones name.
class Reader {
 public:
  Reader(const json& document, const fs::path& folder) : root_(&document, ""), folder_(folder) {
    CheckKeys(document);
  }

  ForeignScene Read() {
    ReadCamera();
    if (root_.Count("textures") > 0) root_.Get("textures").Fail("textures are not read");
    for (const GltfValue& bsdf : root_.Items("bsdfs")) {
      RequireType(bsdf, "diffuse");
      Register(bsdf, &bsdfs_);
      reflectances_.push_back(Colour(bsdf, "reflectance", 1));
    }
    for (const GltfValue& shape : root_.Items("shapes")) ReadShape(shape);
    if (root_.Count("entities") > kMaxEntities) root_.Get("entities").Fail("they are too many");
    for (const GltfValue& entity : root_.Items("entities")) ReadEntity(entity);
    for (const GltfValue& light : root_.Items("lights")) ReadLight(light);
    if (root_.Count("lights") == 0) throw ImportError("lights: none given");
    Scale();
    for (WorldParts& band : scene_.bands) band.statics = statics_;
    return std::move(scene_);
  }

 private:
  void ReadCamera() {
    const GltfValue camera = root_.Get("camera"), film = root_.Get("film");
    RequireType(camera, "perspective");
    const std::vector<float> size = film.Numbers("size", 2);
    const bool is_size = size.size() == 2 && std::ranges::all_of(size, [](float side) {
                           return side >= 1 && side <= kMaxSide && side == std::floor(side);
                         });
    if (!is_size) film.Get("size").Fail("it is not width and height in whole pixels");
    const GltfValue fov = camera.Get("fov");
    const double degrees = camera.Number("fov", 0);
    if (degrees <= 0 || degrees >= 180) fov.Fail("it is not between 0 and 180 degrees");
    StereoCamera& made = scene_.camera;
    made.width = static_cast<int>(size[0]);
    made.height = static_cast<int>(size[1]);
    made.fx = made.fy = made.width / 2.0 / std::tan(degrees / 2 * std::numbers::pi / 180);
    made.cx = (made.width - 1) / 2.0;
    made.cy = (made.height - 1) / 2.0;

    const Eigen::Affine3f given = Transform(camera);
    const Eigen::Matrix3f turn = given.linear();
    if (!(turn * turn.transpose()).isIdentity(1e-4f) || turn.determinant() < 0) {
      camera.Get("transform").Fail("not a rotation");
    }
    // Theirs has x to the left and y up, ours x to the right and y down.
    scene_.T_world_camera.linear() =
        turn.cast<double>() * Eigen::DiagonalMatrix<double, 3>(-1, -1, 1);
    scene_.T_world_camera.translation() = given.translation().cast<double>();
  }

  void ReadShape(const GltfValue& shape) {
    RequireType(shape, "obj");
    Register(shape, &shapes_);
    const GltfValue name = shape.Get("filename");
    try {
      ImportOptions options;
      options.frame = ModelFrame::kAsStored;
      options.root = folder_;
      TriangleMesh mesh = ReadModel(folder_ / name.Text(), options).mesh;
      const Eigen::Affine3f transform = Transform(shape);
      const Eigen::Matrix3f of_normals = transform.linear().inverse().transpose();
      for (Eigen::Vector3f& p : mesh.positions) p = transform * p;
      for (Eigen::Vector3f& n : mesh.normals) n = (of_normals * n).normalized();
      if (transform.linear().determinant() < 0) {  // a mirror image goes round the other way
        for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
      }
      meshes_.push_back(std::move(mesh));
    } catch (const ImportError& error) {
      name.Fail(error.what());
    }
  }

  /// Appends the entity's mesh, with a material of its own.
  void ReadEntity(const GltfValue& entity) {
    Register(entity, &entities_);
    const std::size_t bsdf = Find(entity, "bsdf", bsdfs_, "bsdf");
    shape_of_.push_back(Find(entity, "shape", shapes_, "shape"));
    const TriangleMesh& mesh = meshes_[shape_of_.back()];
    const auto material = static_cast<std::uint16_t>(scene_.bands[0].materials.size());
    for (std::size_t band = 0; band < 3; ++band) {
      Material made;
      made.name = entity.Text("name", "");
      made.albedo = reflectances_[bsdf][band];
      scene_.bands[band].materials.push_back(std::move(made));
    }
    TriangleMesh& all = statics_.mesh;
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
    all.uvs.insert(all.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
    for (const auto& [a, b, c] : mesh.triangles) {
      all.triangles.push_back({first + a, first + b, first + c});
      all.materials.push_back(material);
      statics_.instances.push_back(0);
    }
  }

  void ReadLight(const GltfValue& light) {
    RequireType(light, "area");
    const std::size_t entity = Find(light, "entity", entities_, "entity");
    std::optional<AreaLight> made = ParallelogramOf(meshes_[shape_of_[entity]]);
    if (!made) light.Get("entity").Fail("its shape is not one parallelogram");
    const Rgb radiance = Colour(light, "radiance", 1e9f);
    for (std::size_t band = 0; band < 3; ++band) {
      made->radiance = scene_.bands[band].materials[entity].emission = radiance[band];
      scene_.bands[band].lights.push_back(*made);
    }
  }

  void Scale() {
    float farthest = scene_.T_world_camera.translation().cast<float>().cwiseAbs().maxCoeff();
    for (const Eigen::Vector3f& p : statics_.mesh.positions) {
      farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
    }
    const float factor = kReach_m / std::max(farthest, 1e-12f);
    scene_.T_world_camera.translation() *= static_cast<double>(factor);
    for (Eigen::Vector3f& p : statics_.mesh.positions) p *= factor;
    for (WorldParts& band : scene_.bands) {
      for (AreaLight& light : band.lights) {
        for (Eigen::Vector3f* v : {&light.center, &light.half_u, &light.half_v}) *v *= factor;
      }
    }
  }

  GltfValue root_;
  fs::path folder_;
  ForeignScene scene_;
  Names bsdfs_, shapes_, entities_;
  std::vector<Rgb> reflectances_;
  std::vector<TriangleMesh> meshes_;   ///< by shape
  std::vector<std::size_t> shape_of_;  ///< by entity
  StaticWorld statics_;
};

}  // namespace

ForeignScene LoadForeignScene(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw ForeignSceneError(fmt::format("{}: there is no such file", file.string()));
  try {
    const json document = json::parse(in);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    return Reader(document, folder).Read();
  } catch (const json::exception& error) {
    throw ForeignSceneError(fmt::format("{}: not JSON: {}", file.string(), error.what()));
  } catch (const ImportError& error) {
    throw ForeignSceneError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace aisle::sim
