#include "simulator/shade/light/light_cache.h"

#include <unistd.h>
#include <xxhash.h>

#include <cstdlib>
#include <fstream>

#include "simulator/shade/light/static_light.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

// Raised whenever the solver or this format changes, so that old files are not read.
constexpr std::uint64_t kVersion = 14;
constexpr const char* kUnfinished = ".begun";

struct Header {
  std::uint64_t magic = 0x746867696c736961;  // "aislight"
  std::uint64_t version = kVersion;
  std::uint64_t key = 0;
  std::uint64_t slots = 0, nodes = 0;
  std::uint64_t checksum = 0;  ///< of the arrays and of where the volume lies
};

std::uint64_t Checksum(const LightState& state) {
  std::uint64_t sum = 0;
  const auto add = [&](const auto& values) {
    sum = XXH3_64bits_withSeed(values.data(), values.size() * sizeof(values[0]), sum);
  };
  add(state.total);
  add(state.direct);
  add(state.volume.nodes());
  add(std::span(&state.volume.shape(), 1));
  return sum;
}

std::uint64_t HashOf(const Texture& texture) {
  const cv::Mat& image = texture.image;
  std::uint64_t hash = 0;
  const auto add = [&](const void* data, std::size_t bytes) {
    hash = XXH3_64bits_withSeed(data, bytes, hash);
  };
  const std::array shape = {image.rows, image.cols, image.type()};
  add(shape.data(), sizeof(shape));
  for (int y = 0; y < image.rows; ++y) {
    add(image.ptr(y), static_cast<std::size_t>(image.cols) * image.elemSize());
  }
  return hash;
}

/// What the solver knows of a material: not its normal map, which shades a pixel only.
std::uint64_t HashOf(const Material& material, std::span<const Texture> textures) {
  struct {
    float albedo, emission, specular_f0, roughness;
    std::uint64_t texture;
  } const known = {material.albedo, material.emission, material.specular_f0, material.roughness,
                   material.albedo_texture < 0
                       ? 0
                       : HashOf(textures[static_cast<std::size_t>(material.albedo_texture)])};
  static_assert(sizeof(known) == 24, "padding would be hashed");
  return XXH3_64bits(&known, sizeof(known));
}

/// What each triangle is made of. By content, not by index: movers bring materials of their own,
/// and which stand before which says nothing of the light.
std::vector<std::uint64_t> SurfacesOf(const World& world) {
  const std::vector<std::uint16_t>& materials = world.statics().mesh.materials;
  std::vector<std::optional<std::uint64_t>> hashes(world.materials().size());
  std::vector<std::uint64_t> surfaces;
  surfaces.reserve(materials.size());
  for (const std::uint16_t material : materials) {
    auto& hash = hashes[material];
    if (!hash) hash = HashOf(world.materials()[material], world.textures());
    surfaces.push_back(*hash);
  }
  return surfaces;
}

fs::path FileOf(const fs::path& folder, std::uint64_t key) {
  return folder / fmt::format("light-{:016x}.bin", key);
}

/// Takes away what others began to write aside of a file and did not finish. One who is still at it
/// (which the lock forbids, but a lock can be lost) only fails to keep what he solved.
void RemoveHalves(const fs::path& file) {
  std::error_code error;
  const std::string begin = file.filename().string() + ".";
  for (const auto& entry : fs::directory_iterator(file.parent_path(), error)) {
    if (!entry.path().filename().string().starts_with(begin)) continue;
    std::error_code stays;
    fs::remove(entry.path(), stays);
  }
}

struct KeptFile {
  fs::path path;
  fs::file_time_type used;
  std::uintmax_t bytes;
};

std::vector<KeptFile> KeptFiles(const fs::path& folder) {
  std::vector<KeptFile> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path name = entry.path().filename();
    const bool is_light = name.extension() == ".bin" || name.extension() == kUnfinished;
    if (!is_light || !name.string().starts_with("light-")) continue;
    std::error_code gone;
    const KeptFile file{entry.path(), entry.last_write_time(gone), entry.file_size(gone)};
    if (!gone) files.push_back(file);
  }
  return files;
}

template <typename T>
void Write(std::ofstream& out, std::span<const T> values) {
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size_bytes()));
}

template <typename T>
bool Read(std::ifstream& in, std::span<T> values) {
  in.read(reinterpret_cast<char*>(values.data()),
          static_cast<std::streamsize>(values.size_bytes()));
  return in.good();
}

/// How large a file with that header is.
std::uintmax_t BytesOf(const Header& header) {
  return sizeof(Header) + sizeof(LightVolume::Shape) + 2 * header.slots * sizeof(float) +
         header.nodes * sizeof(LightVolume::Node);
}

}  // namespace

fs::path DefaultLightCache() {
  if (const char* own = std::getenv("AISLE_CACHE")) return own;
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg) return fs::path(xdg) / "aisle";
  if (const char* home = std::getenv("HOME"); home && *home) {
    return fs::path(home) / ".cache" / "aisle";
  }
  return {};
}

std::uint64_t LightKey(const World& world, const StaticLightOptions& options,
                       std::span<const float> light_scale, bool sky_taken) {
  std::uint64_t key = kVersion;
  const auto add = [&](const void* data, std::size_t bytes) {
    key = XXH3_64bits_withSeed(data, bytes, key);
  };
  const auto add_all = [&](const auto& values) {
    add(values.data(), values.size() * sizeof(values[0]));
  };
  const TriangleMesh& mesh = world.statics().mesh;
  add_all(mesh.positions);
  add_all(mesh.normals);
  add_all(mesh.uvs);
  add_all(mesh.triangles);
  add_all(SurfacesOf(world));
  for (const AreaLight& light : world.lights()) {
    add_all(light.center);
    add_all(light.half_u);
    add_all(light.half_v);
    add(&light.radiance, sizeof(light.radiance));
  }
  add_all(light_scale);
  add_all(fmt::format("{} {} {} {} {} {} {} {} {} {}", options.isa, options.texel_m,
                      options.coarse_texel_m, options.volume_spacing_m, options.volume_height_m,
                      options.directions, options.volume_directions, options.bounces,
                      options.max_points, options.max_nodes));
  if (sky_taken) add(&sky_taken, sizeof(sky_taken));
  return key;
}

bool HasLight(const fs::path& folder, std::uint64_t key) {
  std::error_code error;
  return fs::exists(FileOf(folder, key), error);
}

fs::path LockFileOf(const fs::path& folder, std::uint64_t key) {
  return folder / fmt::format("light-{:016x}.lock", key);
}

fs::path UnfinishedFileOf(const fs::path& folder, std::uint64_t key) {
  fs::path file = FileOf(folder, key);
  file += kUnfinished;
  return file;
}

std::optional<LightState> LoadLight(const fs::path& folder, std::uint64_t key, std::size_t slots) {
  constexpr std::uint64_t kMaxNodes = 100'000'000;
  std::ifstream in(FileOf(folder, key), std::ios::binary);
  const Header expected;
  Header header;
  if (!in || !Read(in, std::span(&header, 1))) return std::nullopt;
  if (header.magic != expected.magic || header.version != kVersion || header.key != key ||
      header.slots != slots || header.nodes > kMaxNodes) {
    return std::nullopt;
  }
  std::error_code error;  // before a damaged header makes room for what is not there
  if (fs::file_size(FileOf(folder, key), error) != BytesOf(header)) return std::nullopt;
  LightVolume::Shape shape;
  std::vector<LightVolume::Node> nodes(header.nodes);
  LightState state;
  state.total.resize(slots);
  state.direct.resize(slots);
  if (!Read(in, std::span(&shape, 1)) || !Read(in, std::span(state.total)) ||
      !Read(in, std::span(state.direct)) || !Read(in, std::span(nodes)) ||
      shape.size() != header.nodes) {
    return std::nullopt;
  }
  state.volume = LightVolume(shape, std::move(nodes));
  if (Checksum(state) != header.checksum) return std::nullopt;
  fs::last_write_time(FileOf(folder, key), fs::file_time_type::clock::now(), error);  // was used
  return state;
}

void ShrinkLight(const fs::path& folder, std::uintmax_t most_bytes) {
  std::vector<KeptFile> kept = KeptFiles(folder);
  std::sort(kept.begin(), kept.end(),
            [](const KeptFile& a, const KeptFile& b) { return a.used > b.used; });
  std::uintmax_t total = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    total += kept[i].bytes;
    std::error_code error;  // another process may have been quicker
    if (i > 0 && total > most_bytes) fs::remove(kept[i].path, error);
  }
}

void SaveLight(const fs::path& folder, std::uint64_t key, const LightState& state) {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path file = FileOf(folder, key);
  RemoveHalves(file);
  fs::path aside = file;
  aside += fmt::format(".{}", getpid());
  Header header;
  header.key = key;
  header.slots = state.total.size();
  header.nodes = state.volume.size();
  header.checksum = Checksum(state);
  {
    std::ofstream out(aside, std::ios::binary);
    Write(out, std::span<const Header>(&header, 1));
    const LightVolume::Shape shape = state.volume.shape();
    Write(out, std::span<const LightVolume::Shape>(&shape, 1));
    Write(out, std::span<const float>(state.total));
    Write(out, std::span<const float>(state.direct));
    Write(out, state.volume.nodes());
    out.flush();
    if (!out) {
      out.close();
      fs::remove(aside, error);
      return;
    }
  }
  fs::rename(aside, file, error);
  if (error) fs::remove(aside, error);
}

}  // namespace aisle::sim
