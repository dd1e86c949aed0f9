#include "simulator/proof/stage_hashes.h"

#include <xxhash.h>

namespace aisle::sim {
namespace {

/// One hash of all that was added, in its order.
struct StageHasher {
  std::uint64_t value = 0;

  template <typename Values>
  StageHasher& Add(const Values& values) {
    value = XXH3_64bits_withSeed(values.data(), values.size() * sizeof(*values.data()), value);
    return *this;
  }
  StageHasher& Add(const cv::Mat1f& image) { return AddRows(image); }
  StageHasher& Add(const cv::Mat1b& image) { return AddRows(image); }

 private:
  StageHasher& AddRows(const cv::Mat& image) {
    for (int y = 0; y < image.rows; ++y) {
      value = XXH3_64bits_withSeed(image.ptr(y),
                                   static_cast<std::size_t>(image.cols) * image.elemSize(), value);
    }
    return *this;
  }
};

}  // namespace

StageHashes HashStages(const Studio& studio, const Moment& moment, const RenderedFrame& frame) {
  const Instant instant = studio.At(moment);
  const std::array<CameraView, 2> views = studio.Views(moment);
  std::vector<HitImage> hits;
  TraceViews(instant, views, {}, &hits);
  const std::vector<cv::Mat1f> radiance = studio.shader.Shade(instant, views, hits);
  StageHasher triangles, points, light, linear, pictures;
  for (std::size_t side = 0; side < 2; ++side) {
    triangles.Add(hits[side].geometry).Add(hits[side].primitive);
    points.Add(hits[side].t).Add(hits[side].u).Add(hits[side].v);
    linear.Add(radiance[side]);
  }
  const auto solved = studio.shader.static_light().At(instant.snapshot().light_scale);
  light.Add(solved->total).Add(solved->direct).Add(solved->volume.nodes());
  pictures.Add(frame.left).Add(frame.right);
  return StageHashes{triangles.value, points.value, light.value, linear.value, pictures.value};
}

}  // namespace aisle::sim
