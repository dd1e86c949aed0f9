#include "simulator/content_hash.h"

#include <xxhash.h>

namespace aisle::sim {
namespace {

/// Each part behind its size, so that no two lists of parts have one hash.
class Hasher {
 public:
  Hasher() : state_(XXH3_createState()) { XXH3_64bits_reset(state_); }
  ~Hasher() { XXH3_freeState(state_); }
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  template <typename T>
  void Add(const std::vector<T>& values) {
    AddBytes(values.data(), values.size() * sizeof(T));
  }
  void Add(const std::string& text) { AddBytes(text.data(), text.size()); }
  void Add(const TriangleMesh& mesh) {
    Add(mesh.positions);
    Add(mesh.normals);
    Add(mesh.uvs);
    Add(mesh.triangles);
    Add(mesh.materials);
  }
  void Add(const cv::Mat& image) {
    Add(fmt::format("{}x{}:{}", image.cols, image.rows, image.type()));
    for (int y = 0; y < image.rows; ++y) {
      AddBytes(image.ptr(y), static_cast<std::size_t>(image.cols) * image.elemSize());
    }
  }
  void Add(const std::vector<Material>& materials, const std::vector<Texture>& textures) {
    for (const Texture& texture : textures) Add(texture.image);
    for (const Material& m : materials) {
      Add(fmt::format("{} {} {} {} {} {} {} {}", m.albedo, m.albedo_texture, m.normal_texture,
                      m.normal_scale, m.specular_f0, m.roughness, m.emission, m.transmission));
    }
  }
  void Add(const AreaLight& light) {
    for (const Eigen::Vector3f& v : {light.center, light.half_u, light.half_v}) {
      Add(fmt::format("{} {} {}", v.x(), v.y(), v.z()));
    }
    Add(fmt::format("{}", light.radiance));
  }
  std::uint64_t Value() const { return XXH3_64bits_digest(state_); }

 private:
  void AddBytes(const void* bytes, std::size_t count) {
    const std::uint64_t size = count;
    XXH3_64bits_update(state_, &size, sizeof(size));
    XXH3_64bits_update(state_, bytes, count);
  }

  XXH3_state_t* state_;
};

}  // namespace

std::uint64_t ContentHash(const std::string& essence, const World& world, std::int64_t end_ns,
                          const SimulatorOptions& options) {
  Hasher hasher;
  hasher.Add(essence);
  hasher.Add(world.statics().mesh);
  for (const TriangleMesh& mesh : world.mover_meshes()) hasher.Add(mesh);
  hasher.Add(world.materials(), world.textures());
  for (const BandSurfaces& band : world.colour()) hasher.Add(band.materials, band.textures);
  for (const AreaLight& light : world.lights()) hasher.Add(light);
  for (const std::int64_t stamp_ns : {std::int64_t{0}, end_ns / 2}) {
    for (const MoverState& mover : world.At(stamp_ns).movers) hasher.Add(mover.positions);
  }
  hasher.Add(fmt::format("{:016x}", world.files_digest()));
  hasher.Add("pair " + options.pair);
  hasher.Add(fmt::format("{} {} {} {}", options.seed, static_cast<int>(options.twin), options.isa,
                         options.light_spacing));
  return hasher.Value();
}

}  // namespace aisle::sim
