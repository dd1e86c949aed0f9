#include "simulator/common/parallel.h"
#include "simulator/foreign/foreign_scene.h"
#include "simulator/proof/proofs.h"
#include "simulator/shade/reference/reference.h"

namespace aisle::sim {

cv::Mat3f TraceForeignScene(const std::string& file, const ForeignOptions& options) {
  ForeignScene scene = LoadForeignScene(file);
  const PixelRays rays = MakePixelRays(scene.camera);
  const CameraView view(rays, scene.T_world_camera);
  const Arena arena(options.threads);
  std::vector<cv::Mat1f> bgr(3);
  for (std::size_t band = 0; band < 3; ++band) {
    const World world(std::move(scene.bands[band]));
    const Tracer tracer(world, {});
    const TexturePool textures(world.textures());
    arena.Execute([&] {
      bgr[2 - band] =
          Reference(world, textures)
              .Render(tracer.Pose(world.At(0)), view,
                      {.samples = options.samples, .depth = options.depth, .seed = options.seed});
    });
  }
  cv::Mat3f picture;
  cv::merge(bgr, picture);
  return picture;
}

}  // namespace aisle::sim
