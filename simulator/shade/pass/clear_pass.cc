#include "simulator/shade/pass/clear_pass.h"

#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/pass/beam_light.h"
#include "simulator/shade/pass/edge_samples.h"
#include "simulator/shade/pass/mover_blockers.h"
#include "simulator/shade/pass/pixels_around.h"

namespace aisle::sim {
namespace {

float TransmissionOf(const World& world, const HitImage& image, std::size_t pixel) {
  const TriangleMesh& mesh = world.mover_meshes()[image.geometry[pixel] - 1];
  return world.materials()[mesh.materials[image.primitive[pixel]]].transmission;
}

}  // namespace

std::vector<BehindClear> TraceBehindClear(const Instant& instant, const CameraView& view,
                                          const HitImage& image) {
  GeometryMask solid = kEverything;
  for (std::size_t m = 0; m < instant.snapshot().movers.size(); ++m) {
    if (!CastsShadow(instant, m)) solid &= ~MoverBit(m);
  }
  if (solid == kEverything) return {};
  std::vector<PixelAt> pixels;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint32_t geometry = image.geometry[image.Index(x, y)];
      if (geometry == 0 || geometry == kNoGeometry) continue;
      if (!CastsShadow(instant, geometry - 1)) pixels.push_back({x, y});
    }
  }
  std::vector<BehindClear> behind((pixels.size() + 1) / 2);
  ParallelFor(std::size_t{0}, behind.size(), [&](std::size_t i) {
    const auto two = std::span<const PixelAt>(pixels).subspan(2 * i).first(
        std::min<std::size_t>(2, pixels.size() - 2 * i));
    BehindClear& one = behind[i];
    one.count = static_cast<int>(two.size());
    for (std::size_t k = 0; k < two.size(); ++k) {
      one.pixels[k] = image.Index(two[k].x, two[k].y);
    }
    one.rays = SampleRays(view, two);
    instant.Intersect(one.rays, Coherence::kCoherent, solid, &one.hits);
  });
  return behind;
}

void ShadeBehindClear(const ShadingView& shading, std::span<const BehindClear> behind,
                      bool has_beams, std::vector<float>* through) {
  through->assign(shading.image.t.size(), 0);
  const BeamLight beams(shading.instant);
  const RayStep step{shading.view.rotation.col(0) * shading.view.rays->step_x * 0.5f,
                     shading.view.rotation.col(1) * shading.view.rays->step_y * 0.5f};
  ParallelFor(std::size_t{0}, behind.size(), [&](std::size_t i) {
    const BehindClear& one = behind[i];
    const SurfaceLanes seen =
        LookUpHits(shading.tables, shading.frame, shading.textures, LoadI(one.hits.geometry),
                   LoadI(one.hits.primitive),
                   {LoadF(one.hits.t), LoadF(one.hits.u), LoadF(one.hits.v), LoadF(one.rays.dx),
                    LoadF(one.rays.dy), LoadF(one.rays.dz), I8{}},
                   step);
    F8 irradiance = seen.irradiance;
    if (has_beams) irradiance += BeamsAtHits(shading, beams, one.rays, one.hits);
    const F8 radiance =
        seen.reflectance * irradiance * std::numbers::inv_pi_v<float> +
        GlowOfHits(shading.tables, LoadI(one.hits.geometry), LoadI(one.hits.primitive));
    for (int p = 0; p < one.count; ++p) {
      float sum = 0;
      for (int k = p * kSamples; k < (p + 1) * kSamples; ++k) sum += radiance[k];
      const std::size_t pixel = one.pixels[static_cast<std::size_t>(p)];
      (*through)[pixel] = sum / kSamples * TransmissionOf(shading.world(), shading.image, pixel);
    }
  });
}

}  // namespace aisle::sim
