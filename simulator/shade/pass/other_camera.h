#pragma once

#include "simulator/shade/lanes/wide.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

/// Where the points that one camera sees lie in the picture of another, of the same instant: what
/// depends on the place and not on who looks need not be traced twice. Pinholes only; through a
/// lens nothing is found.
class OtherCamera {
 public:
  /// Both must outlive this.
  OtherCamera(const CameraView& view, const HitImage& image);

  /// The lanes of `points` (metres, world), on the static triangles `primitive`, whose nearest
  /// pixel in the picture shows the same triangle; `pixels` gets these pixels' indices, as in
  /// HitImage.
  I8 Find(const F8x3& points, I8 primitive, I8 active, I8* pixels) const;

 private:
  const HitImage* image_;
  bool straight_;
  Eigen::Matrix3f to_camera_;
  Eigen::Vector3f origin_;
  float first_x_, first_y_, columns_per_x_, rows_per_y_;
};

}  // namespace aisle::sim
