#include "simulator/shade/pass/clear_pass.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/pass/beam_light.h"
#include "simulator/shade/pass/edge_samples.h"
#include "simulator/shade/pass/mover_blockers.h"
#include "simulator/shade/pass/pixels_around.h"
#include "simulator/shade/pass/shadow_rays.h"

namespace aisle::sim {
namespace {

float TransmissionOf(const World& world, const HitImage& image, std::size_t pixel) {
  const TriangleMesh& mesh = world.mover_meshes()[image.geometry[pixel] - 1];
  return world.materials()[mesh.materials[image.primitive[pixel]]].transmission;
}

/// Neighbouring packets whose shadows are asked for together.
constexpr std::size_t kGroup = ShadowRays::kMostPackets;

/// Shades what rays meet behind clear panes as the picture shades what its pixels show.
class Behind {
 public:
  Behind(const ShadingView& shading, bool mover_shadows)
      : shading_(shading),
        mover_shadows_(mover_shadows),
        beams_(shading.instant),
        planner_(shading),
        shadows_(shading),
        // Half a pixel: the spacing of the samples.
        step_{shading.view.rotation.col(0) * shading.view.rays->step_x * 0.5f,
              shading.view.rotation.col(1) * shading.view.rays->step_y * 0.5f} {}

  void Shade(std::span<const BehindClear> group, std::vector<float>* through) const {
    std::array<SurfaceLanes, kGroup> seen;
    for (std::size_t i = 0; i < group.size(); ++i) seen[i] = See(group[i]);
    if (mover_shadows_) TakeShadows(group, seen);
    for (std::size_t i = 0; i < group.size(); ++i) {
      Write(group[i], RadianceOf(group[i], seen[i]), through);
    }
  }

 private:
  SurfaceLanes See(const BehindClear& one) const {
    return LookUpHits(shading_.tables, shading_.frame, shading_.textures, LoadI(one.hits.geometry),
                      LoadI(one.hits.primitive),
                      {LoadF(one.hits.t), LoadF(one.hits.u), LoadF(one.hits.v), LoadF(one.rays.dx),
                       LoadF(one.rays.dy), LoadF(one.rays.dz), I8{}},
                      step_);
  }

  /// Takes from the static world's irradiance what movers keep away. No filter sees it afterwards:
  /// the samples of a pixel take all rows of the pattern. A sample may so fall below 0.
  void TakeShadows(std::span<const BehindClear> group, std::span<SurfaceLanes> seen) const {
    std::array<ShadowedPoints8, kGroup> packets;
    Eigen::AlignedBox3f box;
    float sum = 0, count = 0;
    for (std::size_t i = 0; i < group.size(); ++i) {
      packets[i] = {LocateHits(shading_.tables, group[i].rays, group[i].hits), seen[i].irradiance};
      const auto& [points, irradiance, row] = packets[i];
      for (int k = 0; k < kLanes; ++k) {
        if (!points.active[k]) continue;
        box.extend(
            Eigen::Vector3f(points.position.x[k], points.position.y[k], points.position.z[k]));
        sum += irradiance[k];
        count += 1;
      }
    }
    if (box.isEmpty()) return;
    const ShadowPlan plan = planner_.Plan(box, sum / count);
    if (plan.empty()) return;
    for (int row = 0; row < ShadowRays::kRows; ++row) {
      for (ShadowedPoints8& packet : packets) packet.row = row;
      std::array<F8, kGroup> lost;
      shadows_.FindLost(std::span(packets).first(group.size()), plan, lost);
      for (std::size_t i = 0; i < group.size(); ++i) {
        seen[i].irradiance -= lost[i] / static_cast<float>(ShadowRays::kRows);
      }
    }
  }

  F8 RadianceOf(const BehindClear& one, const SurfaceLanes& seen) const {
    F8 irradiance = seen.irradiance;
    if (shading_.world().has_beams()) {
      irradiance += BeamsAtHits(shading_, beams_, one.rays, one.hits);
    }
    return seen.reflectance * irradiance * std::numbers::inv_pi_v<float> +
           GlowOfHits(shading_.tables, LoadI(one.hits.geometry), LoadI(one.hits.primitive));
  }

  void Write(const BehindClear& one, F8 radiance, std::vector<float>* through) const {
    for (int p = 0; p < one.count; ++p) {
      float sum = 0;
      for (int k = p * kSamples; k < (p + 1) * kSamples; ++k) sum += radiance[k];
      const std::size_t pixel = one.pixels[static_cast<std::size_t>(p)];
      (*through)[pixel] =
          std::max(0.0f, sum) / kSamples * TransmissionOf(shading_.world(), shading_.image, pixel);
    }
  }

  const ShadingView& shading_;
  bool mover_shadows_;
  BeamLight beams_;
  ShadowPlanner planner_;
  ShadowRays shadows_;
  RayStep step_;
};

}  // namespace

std::vector<BehindClear> TraceBehindClear(const Instant& instant, const CameraView& view,
                                          const HitImage& image) {
  const GeometryMask solid = SolidOf(instant);
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
                      bool mover_shadows, std::vector<float>* through) {
  through->assign(shading.image.t.size(), 0);
  const Behind what_is_behind(shading, mover_shadows);
  const std::size_t groups = (behind.size() + kGroup - 1) / kGroup;
  ParallelFor(std::size_t{0}, groups, [&](std::size_t i) {
    const std::size_t first = i * kGroup;
    what_is_behind.Shade(behind.subspan(first, std::min(kGroup, behind.size() - first)), through);
  });
}

}  // namespace aisle::sim
