#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <span>

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/pass/edge_search.h"

namespace aisle::sim {

/// Four samples on a rotated grid in each of two pixels, a packet: offsets from the pixels'
/// centres, pixels. A square turned by atan(1/2), so that rows and columns are distinct for every
/// sample.
inline constexpr int kSamples = 4;
inline constexpr F8 kSampleX = {-0.125f, 0.375f, 0.125f, -0.375f, -0.125f, 0.375f, 0.125f, -0.375f};
inline constexpr F8 kSampleY = {-0.375f, -0.125f, 0.375f, 0.125f, -0.375f, -0.125f, 0.375f, 0.125f};

/// `a` in the lanes of the first pixel, `b` in those of the second.
inline F8 InTurn(float a, float b) { return F8{a, a, a, a, b, b, b, b}; }
inline I8 InTurn(std::uint32_t a, std::uint32_t b) {
  const auto x = static_cast<std::int32_t>(a), y = static_cast<std::int32_t>(b);
  return I8{x, x, x, x, y, y, y, y};
}

/// What the centres of the nine pixels around each of two show, beyond the image those at its
/// border: most samples of these two meet one of these triangles.
class PixelsAround {
 public:
  PixelsAround(const HitImage& image, const cv::Mat1f& radiance, std::span<const PixelAt> pixels);

  /// Whether nothing around moves and nothing is open sky.
  bool all_static() const { return !Any(others_ != 0); }

  /// The nearest of the triangles seen around that each ray meets, where all of them are static;
  /// lanes that meet none have geometry kNoGeometry and t = infinity.
  Hits8 Meet(const Instant& instant, const Rays8& rays) const;

  /// Lanes whose hit lies in a plane before which something is seen around: that may reach into the
  /// ray's way by triangles that no centre shows. `normals` are the hits' planes'; `right` and
  /// `down` how a ray of the view changes from pixel to pixel, world frame.
  I8 BehindSomething(const Rays8& rays, const Hits8& hits, const F8x3& normals,
                     const Eigen::Vector3f& right, const Eigen::Vector3f& down) const;

  /// Radiance of the nearest pixel around that shows the same surface as a sample, on movers of the
  /// nearest in depth, -1 where none does: most samples then need no look-up.
  F8 RadianceOf(const Hits8& hits) const;

 private:
  static constexpr std::size_t kPixels = 9;
  struct Seen {
    I8 geometry, primitive;
    F8 t, radiance;
  };
  std::array<Seen, kPixels> seen_;  ///< the middle first
  std::array<std::array<std::uint32_t, kPixels>, 2> triangles_;
  I8 others_{};  ///< not 0 where not all is static
};

}  // namespace aisle::sim
