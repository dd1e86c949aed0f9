#include "simulator/shade/shader.h"

#include <array>
#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/pass/antialias.h"
#include "simulator/shade/pass/beam_light.h"
#include "simulator/shade/pass/clear_pass.h"
#include "simulator/shade/pass/gloss_pass.h"
#include "simulator/shade/pass/mover_shadow.h"
#include "simulator/shade/pass/normal_pass.h"

namespace aisle::sim {
namespace {

constexpr float kInvPi = std::numbers::inv_pi_v<float>;

/// Reflectance and irradiance of every pixel, rows as in HitImage.
void LookUpImage(const ShadingView& shading, std::vector<float>* reflectance,
                 std::vector<float>* irradiance) {
  const auto& [instant, view, image, tables, frame, textures] = shading;
  reflectance->resize(image.t.size());
  irradiance->resize(image.t.size());
  const PixelRays& rays = *view.rays;
  const Eigen::Matrix3f& r = view.rotation;
  const auto step_at = [&](int x, int y) {
    const PixelRays::Step step = rays.StepAt(x, y);
    return RayStep{r.leftCols<2>() * step.right, r.leftCols<2>() * step.down};
  };
  const RayStep everywhere = step_at(0, 0);
  ParallelFor(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; x += kLanes) {
      const std::size_t i = image.Index(x, y);
      // The last packet of a row may reach into the next row's rays; those lanes hit nothing.
      const auto ray = static_cast<std::size_t>(y * rays.width + x);
      const F8 cx = LoadF(&rays.x[ray]), cy = LoadF(&rays.y[ray]);
      const HitLanes hits{LoadF(&image.t[i]),
                          LoadF(&image.u[i]),
                          LoadF(&image.v[i]),
                          r(0, 0) * cx + r(0, 1) * cy + r(0, 2),
                          r(1, 0) * cx + r(1, 1) * cy + r(1, 2),
                          r(2, 0) * cx + r(2, 1) * cy + r(2, 2),
                          I8{}};
      const SurfaceLanes seen =
          LookUpHits(tables, frame, textures, LoadI(&image.geometry[i]), LoadI(&image.primitive[i]),
                     hits, rays.straight ? everywhere : step_at(x, y));
      Store(seen.reflectance, &(*reflectance)[i]);
      Store(seen.irradiance, &(*irradiance)[i]);
    }
  });
}

cv::Mat1f Combine(const HitImage& image, std::span<const float> reflectance,
                  std::span<const float> irradiance, std::span<const float> kept,
                  std::span<const float> mirrored) {
  cv::Mat1f radiance(image.height, image.width);
  ParallelFor(0, image.height, [&](int y) {
    const std::size_t row = image.Index(0, y);
    float* to = radiance[y];
    for (std::size_t x = 0; x < static_cast<std::size_t>(image.width); ++x) {
      to[x] = reflectance[row + x] * irradiance[row + x] * kInvPi;
      if (!kept.empty()) to[x] *= kept[row + x];
      if (!mirrored.empty()) to[x] += mirrored[row + x];
    }
  });
  return radiance;
}

/// What moving lights add to a picture, what movers shine by themselves, and what is seen through
/// clear panes: most worlds have none.
void AddBeams(std::span<const float> reflectance, std::span<const float> beams,
              const HitImage& image, cv::Mat1f* radiance) {
  ParallelFor(0, image.height, [&](int y) {
    const std::size_t row = image.Index(0, y);
    float* to = (*radiance)[y];
    for (std::size_t x = 0; x < static_cast<std::size_t>(image.width); ++x) {
      to[x] += reflectance[row + x] * beams[row + x] * kInvPi;
    }
  });
}

void AddGlow(const SurfaceTables& tables, const HitImage& image, cv::Mat1f* radiance) {
  ParallelFor(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; x += kLanes) {
      const std::size_t i = image.Index(x, y);
      const I8 geometry = LoadI(&image.geometry[i]);
      if (!Any(geometry > 0)) continue;
      const F8 glow = GlowOfHits(tables, geometry, LoadI(&image.primitive[i]));
      for (int k = 0; k < std::min(kLanes, image.width - x); ++k) (*radiance)(y, x + k) += glow[k];
    }
  });
}

void AddThrough(std::span<const float> through, const HitImage& image, cv::Mat1f* radiance) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) (*radiance)(y, x) += through[image.Index(x, y)];
  }
}

}  // namespace

struct Shader::Workspace {
  FrameLight frame;
  std::vector<float> reflectance, irradiance, kept;
  std::vector<float> raw_mirrored, mirrored, beams, through;
  std::vector<Reflections> reflections;        ///< by view
  std::array<std::vector<float>, 2> raw_kept;  ///< of the first view, and of the one at work
};

Shader::Shader(const World& world, const Tracer& tracer, const ShadeOptions& options)
    : options_(options),
      textures_(world.textures()),
      static_light_(world, tracer, textures_, options.statics),
      tables_(world, static_light_.grid(), options.mover_texel_m) {}

Shader::~Shader() = default;

std::vector<cv::Mat1f> Shader::Shade(const Instant& instant, std::span<const CameraView> views,
                                     std::span<const HitImage> images,
                                     const std::function<void(const char*)>& lap) const {
  const auto done = [&](const char* stage) {
    if (lap) lap(stage);
  };
  std::unique_ptr<Workspace> work;
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      work = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!work) work = std::make_unique<Workspace>();

  std::vector<std::vector<BehindClear>> behind;  // by view
  std::vector<Hits8> beyond;
  work->reflections.resize(std::max(work->reflections.size(), views.size()));
  for (std::size_t i = 0; i < views.size(); ++i) {
    behind.push_back(TraceBehindClear(instant, views[i], images[i]));
    for (const BehindClear& one : behind.back()) beyond.push_back(one.hits);
    if (!options_.gloss) continue;
    TraceGloss({instant, views[i], images[i], tables_, work->frame, textures_},
               &work->reflections[i]);
    AddMirroredMovers(work->reflections[i], &beyond);
  }
  done("gloss");
  tables_.PrepareFrame(instant, views, images, static_light_.At(instant.snapshot().light_scale),
                       &work->frame, beyond);
  done("light movers");
  std::vector<cv::Mat1f> radiance;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const HitImage& image = images[i];
    const ShadingView shading{instant, views[i], image, tables_, work->frame, textures_};
    LookUpImage(shading, &work->reflectance, &work->irradiance);
    BendLight(shading, &work->irradiance);
    done("look up");
    if (options_.mover_shadows) {
      const SeenShadows first{views[0], images[0], work->raw_kept[0]};
      TraceMoverShadows(shading, work->irradiance, i > 0 ? &first : nullptr,
                        &work->raw_kept[i > 0 ? 1 : 0], &work->kept);
    } else {
      work->kept.assign(image.t.size(), 1);
    }
    done("mover shadows");
    const bool glossy =
        options_.gloss && ShadeGloss(shading, work->reflections[i], &work->reflectance,
                                     &work->raw_mirrored, &work->mirrored);
    done("gloss");
    radiance.push_back(
        Combine(image, work->reflectance, work->irradiance, work->kept,
                glossy ? std::span<const float>(work->mirrored) : std::span<const float>()));
    if (tables_.world().has_beams()) {
      TraceBeams(shading, &work->beams);
      AddBeams(work->reflectance, work->beams, image, &radiance.back());
      done("beams");
    }
    if (tables_.movers_glow()) AddGlow(tables_, image, &radiance.back());
    if (!behind[i].empty()) {
      ShadeBehindClear(shading, behind[i], options_.mover_shadows, &work->through);
      AddThrough(work->through, image, &radiance.back());
      done("behind clear panes");
    }
    if (options_.antialias) {
      AntialiasEdges(shading, work->kept, &radiance.back());
      done("antialias");
    }
  }
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(work));
  return radiance;
}

}  // namespace aisle::sim
