#include "simulator/shade/pass/normal_pass.h"

#include "simulator/shade/surface/normal_map.h"
#include "simulator/trace/tile_grid.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 32, kTileHeight = 16;
constexpr float kMost = 4;  // times brighter: where a lamp only just grazes the surface

float Ratio(float to, float from) { return from > 1e-9f ? std::min(to / from, kMost) : 1.0f; }

/// What all lamps give a normal at a place, were nothing in between, up to a factor.
class OpenLight {
 public:
  OpenLight(const Instant& instant, const World& world, const Eigen::Vector3f& place) {
    for (std::size_t i = 0; i < world.lights().size(); ++i) {
      const AreaLight& light = world.lights()[i];
      const Eigen::Vector3f to = light.center - place;
      const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
      const float there = std::max(0.0f, -to.dot(cross)), squared = to.squaredNorm();
      const float power = light.radiance * instant.snapshot().light_scale[i];
      beams_.push_back(power * there / std::max(squared * squared, 1e-9f) * to);
    }
  }
  float On(const Eigen::Vector3f& normal) const {
    float sum = 0;
    for (const Eigen::Vector3f& beam : beams_) sum += std::max(0.0f, beam.dot(normal));
    return sum;
  }

 private:
  std::vector<Eigen::Vector3f> beams_;
};

}  // namespace

void BendLight(const ShadingView& shading, std::vector<float>* irradiance) {
  const auto& [instant, view, image, tables, frame, textures] = shading;
  if (!tables.has_normal_maps()) return;
  const World& world = tables.world();
  const TileGrid grid{image.width, image.height, kTileWidth, kTileHeight};
  grid.ForEach([&](std::size_t, const Tile& tile) {
    ForRows(tile, 1, [&](int x, int y) {
      const std::size_t i = image.Index(x, y);
      const std::uint32_t geometry = image.geometry[i];
      if (geometry == kNoGeometry) return;
      const MeshPlace place = tables.PlaceOf(instant, image, i);
      const Material& material = world.materials()[place.topology.materials[place.triangle]];
      const bool luminaire = geometry == 0 && material.emission > 0;  // what it emits has no normal
      if (material.normal_texture < 0 || luminaire) return;
      const Eigen::Vector3f ray = view.rotation * view.rays->At(x, y).homogeneous();
      const Eigen::Vector3f position = view.origin + image.t[i] * ray;
      const float pixel_m = image.t[i] * view.rays->step_x;
      const Eigen::Vector3f smooth = SmoothNormal(place);
      const Eigen::Vector3f mapped = MappedNormal(place, material, textures, pixel_m);

      const LightVolume::Node around = frame.statics->volume.At(position);
      float& light = (*irradiance)[i];
      const float direct = geometry == 0 ? ReadLight(tables.statics()[place.triangle].light,
                                                     frame.statics->direct, place.u, place.v)
                                         : std::max(0.0f, light - around.Irradiance(smooth));
      const OpenLight open(instant, world, position);
      light = direct * Ratio(open.On(mapped), open.On(smooth)) +
              std::max(0.0f, light - direct) *
                  Ratio(around.Irradiance(mapped), around.Irradiance(smooth));
    });
  });
}

}  // namespace aisle::sim
