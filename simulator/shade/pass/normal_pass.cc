#include "simulator/shade/pass/normal_pass.h"

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/surface/normal_map.h"
#include "simulator/trace/tile_grid.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 32, kTileHeight = 16;
constexpr float kMost = 4;  // times brighter: where a lamp only just grazes the surface

float Ratio(float to, float from) { return from > 1e-9f ? std::min(to / from, kMost) : 1.0f; }

/// What open lamps, nothing in between, give two normals at a place, up to a factor.
struct OpenLight {
  float smooth = 0, mapped = 0;
};

/// All lamps as eight lanes read them.
class OpenLamps {
 public:
  OpenLamps(const Instant& instant, const World& world) {
    const std::size_t count = (world.lights().size() + 7) / 8 * 8;
    for (std::vector<float>* lanes : {&x_, &y_, &z_, &face_x_, &face_y_, &face_z_}) {
      lanes->assign(count, 0.0f);
    }
    for (std::size_t i = 0; i < world.lights().size(); ++i) {
      const AreaLight& light = world.lights()[i];
      const float power = light.radiance * instant.snapshot().light_scale[i];
      const Eigen::Vector3f face = -power * light.half_u.cross(light.half_v);
      x_[i] = light.center.x(), y_[i] = light.center.y(), z_[i] = light.center.z();
      face_x_[i] = face.x(), face_y_[i] = face.y(), face_z_[i] = face.z();
    }
  }

  OpenLight On(const Eigen::Vector3f& place, const Eigen::Vector3f& smooth,
               const Eigen::Vector3f& mapped) const {
    const F8 zero = Wide(0);
    F8 on_smooth = zero, on_mapped = zero;
    for (std::size_t i = 0; i < x_.size(); i += 8) {
      const F8x3 to = {LoadF(&x_[i]) - place.x(), LoadF(&y_[i]) - place.y(),
                       LoadF(&z_[i]) - place.z()};
      const F8x3 face = {LoadF(&face_x_[i]), LoadF(&face_y_[i]), LoadF(&face_z_[i])};
      const F8 squared = Dot(to, to);
      const F8 beam = Max(Dot(to, face), zero) / Max(squared * squared, Wide(1e-9f));
      on_smooth += beam * Max(to.x * smooth.x() + to.y * smooth.y() + to.z * smooth.z(), zero);
      on_mapped += beam * Max(to.x * mapped.x() + to.y * mapped.y() + to.z * mapped.z(), zero);
    }
    return {Sum(on_smooth), Sum(on_mapped)};
  }

 private:
  std::vector<float> x_, y_, z_, face_x_, face_y_, face_z_;  ///< centres; faces times power
};

/// A pixel that shows a normal map.
struct MappedPixel {
  std::size_t index;
  Eigen::Vector3f position;
  MapAxes axes;
  float scale, direct;  ///< of the map; of the pixel's light, what lamps give
  LightVolume::Node around;
};

/// Pixels of a tile whose maps are read together.
class MappedPixels {
 public:
  MappedPixels(const OpenLamps& lamps, const TexturePool& textures, std::vector<float>* irradiance)
      : lamps_(lamps), textures_(textures), irradiance_(*irradiance) {}

  void Add(const MappedPixel& pixel) {
    points_[count_] = pixel.axes.point;
    pixels_[count_++] = pixel;
    if (count_ == kMapPoints) Bend();
  }

  void Bend() {
    const auto bends = textures_.SampleNormals({points_.data(), count_});
    for (std::size_t k = 0; k < count_; ++k) Bend(pixels_[k], bends[k]);
    count_ = 0;
  }

 private:
  void Bend(const MappedPixel& pixel, const Eigen::Vector2f& bend) const {
    const Eigen::Vector3f& smooth = pixel.axes.smooth;
    const Eigen::Vector3f mapped = BentNormal(pixel.axes, bend, pixel.scale);
    const OpenLight open = lamps_.On(pixel.position, smooth, mapped);
    float& light = irradiance_[pixel.index];
    light = pixel.direct * Ratio(open.mapped, open.smooth) +
            std::max(0.0f, light - pixel.direct) *
                Ratio(pixel.around.Irradiance(mapped), pixel.around.Irradiance(smooth));
  }

  const OpenLamps& lamps_;
  const TexturePool& textures_;
  std::vector<float>& irradiance_;
  std::array<MapPoint, kMapPoints> points_;
  std::array<MappedPixel, kMapPoints> pixels_;
  std::size_t count_ = 0;
};

}  // namespace

void BendLight(const ShadingView& shading, std::vector<float>* irradiance) {
  const auto& [instant, view, image, tables, frame, textures] = shading;
  if (!tables.has_normal_maps()) return;
  const World& world = tables.world();
  const bool plain_statics = !tables.statics_have_normal_maps();
  const OpenLamps lamps(instant, world);
  const TileGrid grid{image.width, image.height, kTileWidth, kTileHeight};
  grid.ForEach([&](std::size_t, const Tile& tile) {
    MappedPixels pixels(lamps, textures, irradiance);
    ForRows(tile, 1, [&](int x, int y) {
      const std::size_t i = image.Index(x, y);
      const std::uint32_t geometry = image.geometry[i];
      if (geometry == kNoGeometry || (geometry == 0 && plain_statics)) return;
      const MeshPlace place = tables.PlaceOf(instant, image, i);
      const Material& material = world.materials()[place.topology.materials[place.triangle]];
      const bool luminaire = geometry == 0 && material.emission > 0;  // what it emits has no normal
      if (luminaire) return;
      const float pixel_m = image.t[i] * view.rays->step_x;
      const std::optional<MapAxes> axes = AxesOfMap(place, material, pixel_m);
      if (!axes) return;
      const Eigen::Vector3f ray = view.rotation * view.rays->At(x, y).homogeneous();
      const Eigen::Vector3f position = view.origin + image.t[i] * ray;
      const LightVolume::Node around = frame.statics->volume.At(position);
      const float direct = geometry == 0
                               ? ReadLight(tables.statics()[place.triangle].light,
                                           frame.statics->direct, place.u, place.v)
                               : std::max(0.0f, (*irradiance)[i] - around.Irradiance(axes->smooth));
      pixels.Add({i, position, *axes, material.normal_scale, direct, around});
    });
    pixels.Bend();
  });
}

}  // namespace aisle::sim
