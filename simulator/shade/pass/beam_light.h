#pragma once

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// The direct light of an instant's moving lights, evaluated where it is asked: one shadow ray a
/// point and light, against the static world and the movers alike. Nothing of it is remembered from
/// frame to frame, so that any light may move in any way.
class BeamLight {
 public:
  explicit BeamLight(const Instant& instant);

  /// Irradiance at eight points with unit normals; 0 in lanes that are not valid. What beams give
  /// everywhere after they met a surface is part of it.
  F8 At(const F8x3& position, const F8x3& normal, I8 valid) const;

 private:
  F8 Unshadowed(const Beam& beam, const F8x3& position, const F8x3& normal, F8x3* way,
                F8* share) const;

  const Instant& instant_;
  GeometryMask blockers_;
};

/// Irradiance of the beams at every pixel of a view, rows as in HitImage.
void TraceBeams(const ShadingView& shading, std::vector<float>* irradiance);

/// The same where eight rays hit, by the triangles' own normals.
F8 BeamsAtHits(const ShadingView& shading, const BeamLight& beams, const Rays8& rays,
               const Hits8& hits);

}  // namespace aisle::sim
