#include "simulator/proof/light_proof.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "simulator/shade/reference/light_error.h"
#include "simulator/shade/reference/reference.h"

namespace aisle::sim {
namespace {

/// Refuses what the path tracer does not draw: it would judge a picture by one of another scene.
void ExpectJudgeable(const World& world) {
  const auto refuse = [](const char* what) {
    throw std::runtime_error(fmt::format(
        "the path tracer draws no {}, which this scene has: its light cannot be judged by it",
        what));
  };
  if (world.has_beams()) refuse("beams");
  for (const TriangleMesh& mover : world.mover_meshes()) {
    for (const std::uint16_t material : mover.materials) {
      if (world.materials()[material].transmission > 0) refuse("panes that are seen through");
    }
  }
}

/// The left image's light, in shares of white, `small` being its camera made coarser.
cv::Mat1f Light(const Studio& studio, const Moment& moment, const StereoCamera& small, int reduce) {
  const Instant instant = studio.At(moment);
  const std::array<CameraView, 2> views = studio.Views(moment);
  std::vector<HitImage> hits;
  TraceViews(instant, views, {}, &hits);
  const cv::Mat1f radiance = studio.shader.Shade(instant, views, hits)[0];
  const cv::Rect whole(0, 0, small.width * reduce, small.height * reduce);
  cv::Mat1f light;
  cv::resize(radiance(whole), light, {small.width, small.height}, 0, 0, cv::INTER_AREA);
  light *= studio.exposure;
  return light;
}

/// Two references of the same image, of so many paths each.
std::array<cv::Mat1f, 2> References(const Studio& studio, const Moment& moment,
                                    const StereoCamera& small, int samples) {
  const Instant instant = studio.At(moment);
  const TexturePool textures(studio.world.textures());
  const Reference reference(studio.world, textures);
  const PixelRays rays = MakePixelRays(small);
  const CameraView view(rays, CameraPose(small, moment.T_world_rig, StereoSide::kLeft));
  std::array<cv::Mat1f, 2> halves;
  for (std::size_t i = 0; i < 2; ++i) {
    halves[i] = reference.Render(instant, view, {.samples = samples, .seed = i + 1});
    halves[i] *= studio.exposure;
  }
  return halves;
}

/// 255 where the left image of the coarser camera shows a mover or the next pixel does.
cv::Mat1b MoversIn(const Studio& studio, const Moment& moment, const StereoCamera& small) {
  const PixelRays rays = MakePixelRays(small);
  const std::array view = {
      CameraView(rays, CameraPose(small, moment.T_world_rig, StereoSide::kLeft))};
  std::vector<HitImage> hits;
  TraceViews(studio.At(moment), view, {}, &hits);
  cv::Mat1b movers(small.height, small.width, std::uint8_t{0});
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      const std::uint32_t geometry = hits[0].geometry[hits[0].Index(x, y)];
      if (geometry != 0 && geometry != kNoGeometry) movers(y, x) = 255;
    }
  }
  cv::dilate(movers, movers, cv::Mat1b::ones(3, 3));
  return movers;
}

LightChangeCheck::Part PartOf(const LightChange& change) {
  return {change.pixels,      change.rms_ours,  change.rms_reference,
          change.rms_between, change.rms_noise, change.correlation};
}

}  // namespace

LightCheck CheckLight(const Studio& studio, const Moment& moment, int samples, int reduce) {
  ExpectJudgeable(studio.world);
  const StereoCamera small = Coarser(studio.camera, reduce);
  LightCheck check;
  check.rendered = Light(studio, moment, small, reduce);
  check.halves = References(studio, moment, small, (samples + 1) / 2);
  check.reference = (check.halves[0] + check.halves[1]) / 2;
  const LightError noise = CompareLight(check.halves[0], check.halves[1]);
  check.noise_median_relative = noise.median_relative;
  check.noise_ssim = noise.ssim;
  const LightError error = CompareLight(check.rendered, check.reference);
  check.median_relative_error = error.median_relative;
  check.ssim = error.ssim;
  check.mean_ratio = error.mean_ratio;
  return check;
}

LightChangeCheck CheckLightChange(const Studio& studio, const std::array<Moment, 2>& moments,
                                  int samples, int reduce) {
  const StereoCamera small = Coarser(studio.camera, reduce);
  LightChangeCheck check;
  check.now = CheckLight(studio, moments[0], samples, reduce);
  const LightCheck then = CheckLight(studio, moments[1], samples, reduce);
  cv::Mat1f ours;
  cv::subtract(then.rendered, check.now.rendered, ours);
  std::array<cv::Mat1f, 2> halves;
  for (std::size_t i = 0; i < 2; ++i) {
    cv::subtract(then.halves[i], check.now.halves[i], halves[i]);
  }
  cv::Mat1b movers(ours.size(), std::uint8_t{0});
  for (const Moment& moment : moments) movers |= MoversIn(studio, moment, small);
  check.everywhere = PartOf(CompareChange(ours, halves, cv::Mat1b(ours.size(), std::uint8_t{1})));
  check.on_movers = PartOf(CompareChange(ours, halves, movers));
  return check;
}

}  // namespace aisle::sim
