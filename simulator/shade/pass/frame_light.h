#pragma once

#include <memory>
#include <span>
#include <vector>

#include "simulator/shade/light/static_light.h"
#include "simulator/shade/pass/mover_light.h"
#include "simulator/shade/surface/normal_map.h"
#include "simulator/shade/surface/surface_lanes.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

/// The surfaces of one frame and the light on them, ready to be looked up. The vectors are reused
/// from frame to frame.
struct FrameLight {
  std::shared_ptr<const LightState> statics;
  std::vector<SurfaceRecord> mover_records;  ///< of all movers, one after the other
  std::vector<float> mover_light;            ///< irradiance by slot
};

/// What every frame shares: the static world's records, and the movers' before they are posed.
class SurfaceTables {
 public:
  SurfaceTables(const World& world, const LightGrid& static_grid, float mover_texel_m);

  const std::vector<SurfaceRecord>& statics() const { return statics_; }
  const World& world() const { return *world_; }
  /// Whether anything in the world has a glossy lobe.
  bool glossy() const { return glossy_; }
  bool has_normal_maps() const { return has_normal_maps_; }
  /// Whether anything of a mover shines by itself.
  bool movers_glow() const { return movers_glow_; }
  /// Whether any surface of the static world has one.
  bool statics_have_normal_maps() const { return statics_have_normal_maps_; }
  /// Where a pixel that hit something lies on its mesh.
  MeshPlace PlaceOf(const Instant& instant, const HitImage& image, std::size_t pixel) const;
  /// Index in FrameLight::mover_records of a mover's first triangle.
  std::span<const std::int32_t> mover_bases() const { return mover_bases_; }

  /// Of the movers in their bind poses: materials, not places.
  const std::vector<SurfaceRecord>& mover_records() const { return mover_records_; }

  /// Poses the movers' records and lights what the images of the views show of them, and what the
  /// hits `beyond` do, which are behind clear panes or in mirrors.
  void PrepareFrame(const Instant& instant, std::span<const CameraView> views,
                    std::span<const HitImage> images, std::shared_ptr<const LightState> statics,
                    FrameLight* frame, std::span<const Hits8> beyond = {}) const;

 private:
  const World* world_;
  std::vector<SurfaceRecord> statics_;
  bool glossy_ = false, movers_glow_ = false;
  bool has_normal_maps_ = false, statics_have_normal_maps_ = false;
  std::vector<SurfaceRecord> mover_records_;
  std::vector<std::int32_t> mover_bases_;
  std::vector<std::size_t> slot_bases_;
  std::size_t slot_count_ = 0;
  std::vector<LightGrid> mover_grids_;
  std::unique_ptr<MoverLight> mover_light_;
};

/// Looks up eight neighbouring pixels' (or any eight) hits, whichever family they belong to; lanes
/// that hit nothing give 0.
SurfaceLanes LookUpHits(const SurfaceTables& tables, const FrameLight& frame,
                        const TexturePool& textures, I8 geometry, I8 primitive, HitLanes hits,
                        const RayStep& step);

/// What movers shine by themselves where eight rays met them, radiance; lamps of the static world
/// have theirs in what LookUpHits finds.
F8 GlowOfHits(const SurfaceTables& tables, I8 geometry, I8 primitive);

/// Radiance of what eight rays met, looked up likewise, with what it shines by itself.
F8 RadianceOfHits(const SurfaceTables& tables, const FrameLight& frame, const TexturePool& textures,
                  const F8x3& directions, const Hits8& hits, const RayStep& step);

}  // namespace aisle::sim
