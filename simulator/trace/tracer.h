#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulator/trace/meet.h"
#include "simulator/trace/rays.h"
#include "simulator/world/world.h"

namespace aisle::sim {

struct TracerOptions {
  /// Embree's instruction set, as rtcNewDevice takes it; "native" lets Embree choose. Sets with and
  /// without fused multiplication may disagree whether a ray passes an edge, so the set is part of
  /// a result.
  std::string isa = "avx2";
};

/// Which geometries a ray may meet: bit 0 the static world, bit 1 + i mover i. A bit each: what one
/// mover hides and what light it takes is asked of it alone.
using GeometryMask = unsigned __int128;
static_assert(kMostMovers + 1 <= 8 * sizeof(GeometryMask));
inline constexpr GeometryMask kEverything = ~GeometryMask{0};
inline constexpr GeometryMask kStaticOnly = 1;
inline constexpr GeometryMask kMoversOnly = ~GeometryMask{1};
constexpr GeometryMask MoverBit(std::size_t mover) { return GeometryMask{1} << (mover + 1); }

/// Whether neighbouring lanes take like paths; a hint for speed only.
enum class Coherence { kCoherent, kIncoherent };

class Tracer;

/// The world posed at one instant, ready for rays. Made by Tracer::Pose; must not outlive it.
/// Const calls may come from any number of threads.
class Instant {
 public:
  Instant(Instant&&) noexcept;
  Instant& operator=(Instant&&) = delete;
  ~Instant();

  const Snapshot& snapshot() const { return snapshot_; }
  /// World box of each mover, in the snapshot's order.
  std::span<const Eigen::AlignedBox3f> mover_boxes() const { return boxes_; }

  /// Nearest hits. Embree says which triangles; t, u and v follow from these by plain arithmetic,
  /// and where triangles meet a rule chooses: the same bits on every make of processor.
  void Intersect(const Rays8& rays, Coherence coherence, GeometryMask geometries,
                 Hits8* hits) const;
  /// The same for up to kMostPackets packets side by side, which is faster; `hits` has one a
  /// packet.
  void Intersect(std::span<const Rays8> rays, Coherence coherence, GeometryMask geometries,
                 std::span<Hits8> hits) const;
  static constexpr std::size_t kMostPackets = 8;
  /// Where the first four rays meet one of the static world's triangles and the last four another,
  /// whatever may stand before them; `on_rim` is -1 where they pass them by.
  Meetings8 MeetStatic(const Rays8& rays, std::uint32_t of_first_four,
                       std::uint32_t of_last_four) const;
  /// Bit i is set where valid lane i meets anything at all.
  unsigned Occluded(const Rays8& rays, Coherence coherence, GeometryMask geometries) const;
  /// The same for up to kMostPackets packets side by side, which is faster; `blocked` has one a
  /// packet.
  void Occluded(std::span<const Rays8> rays, Coherence coherence, GeometryMask geometries,
                std::span<unsigned> blocked) const;

 private:
  friend class Tracer;
  struct MoverScenes;
  Instant(const Tracer& tracer, Snapshot snapshot, std::vector<Eigen::AlignedBox3f> boxes,
          std::unique_ptr<MoverScenes> movers);

  /// Calls ask(scene, geometry) for every scene that the rays may meet.
  template <typename Ask>
  void ForEachScene(GeometryMask geometries, const Ask& ask) const;
  Corners MoverCorners(std::uint32_t geometry, std::uint32_t primitive) const;
  Corners8 CornersOf(const std::uint32_t* geometry, const std::uint32_t* primitive) const;
  /// Sets t, u and v of hits whose triangles are known; the bits of lanes whose triangle is in
  /// doubt.
  unsigned Place(const Rays8& rays, Hits8* hits) const;
  /// Chooses the triangle of such lanes among all that they meet at the same distance.
  void Settle(const Rays8& rays, GeometryMask geometries, unsigned lanes, Hits8* hits) const;

  const Tracer* tracer_;
  Snapshot snapshot_;
  std::vector<Eigen::AlignedBox3f> boxes_;
  std::unique_ptr<MoverScenes> movers_;
};

/// The only door to Embree: the static world is built once; each mover is a scene of its own,
/// whose tree is built over the bind pose and refitted, so that a pose gives the same tree whatever
/// was posed before it.
class Tracer {
 public:
  /// Throws std::runtime_error if Embree refuses the instruction set or the geometry.
  Tracer(const World& world, const TracerOptions& options);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Poses the movers. Thread-safe; scenes are recycled when an Instant dies.
  Instant Pose(Snapshot snapshot) const;
  const Eigen::AlignedBox3f& static_box() const { return static_box_; }

 private:
  friend class Instant;
  struct Impl;
  std::unique_ptr<Impl> impl_;
  Eigen::AlignedBox3f static_box_;
};

}  // namespace aisle::sim
