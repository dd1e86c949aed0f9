#include "simulator/trace/tracer.h"

#include <embree3/rtcore.h>
#include <immintrin.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "simulator/common/parallel.h"
#include "simulator/trace/meet.h"
#include "simulator/trace/overlaps.h"

namespace aisle::sim {
namespace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using Scene = std::unique_ptr<RTCSceneTy, SceneRelease>;

/// Called by Embree from inside its C++ entry points, which let exceptions pass.
void ThrowOnError(void*, RTCError code, const char* message) {
  throw std::runtime_error(
      fmt::format("Embree error {}: {}", static_cast<int>(code), message ? message : ""));
}

Device NewDevice(const std::string& isa) {
  // Every query is eight rays wide, which Embree has no code for below.
  if (isa != "avx2" && isa != "native") {
    throw std::runtime_error(fmt::format("the tracer has no isa '{}': avx2 or native", isa));
  }
  const std::string config = isa == "native" ? "" : "isa=" + isa;
  Device device(rtcNewDevice(config.c_str()));
  if (!device) {
    if (rtcGetDeviceError(nullptr) == RTC_ERROR_OUT_OF_MEMORY) {
      throw std::system_error(std::make_error_code(std::errc::not_enough_memory),
                              "Embree does not start");
    }
    throw std::runtime_error(fmt::format("Embree does not start with isa '{}'; try native", isa));
  }
  rtcSetDeviceErrorFunction(device.get(), ThrowOnError, nullptr);
  return device;
}

void CopyPositions(std::span<const Eigen::Vector3f> positions, void* to) {
  std::memcpy(to, positions.data(), positions.size() * sizeof(Eigen::Vector3f));
}

/// One mesh, alone in a scene. Robust: boxes are met by true division and with a margin, edges
/// without a gap. Embree's other way begins at the processor's approximate reciprocal, of which
/// each maker has his own, and so whether a ray meets a box that it grazes depends on the maker.
Scene BuildScene(RTCDevice device, const TriangleMesh& mesh, bool moves) {
  Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), (moves ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE) |
                                    RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  rtcSetSceneBuildQuality(scene.get(), moves ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, moves ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_HIGH);
  CopyPositions(mesh.positions,
                rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        sizeof(Eigen::Vector3f), mesh.positions.size()));
  std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                      sizeof(std::array<std::uint32_t, 3>), mesh.triangles.size()),
              mesh.triangles.data(), mesh.triangles.size() * sizeof(std::array<std::uint32_t, 3>));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene.get(), geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  return scene;
}

/// Moves a mover's vertices, unless they are there already.
void Refit(RTCScene scene, std::span<const Eigen::Vector3f> positions) {
  RTCGeometry geometry = rtcGetGeometry(scene, 0);
  void* held = rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  // What is parked is where it was: a street has dozens of such cars.
  if (std::memcmp(held, positions.data(), positions.size() * sizeof(Eigen::Vector3f)) == 0) return;
  CopyPositions(positions, held);
  rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene);
}

Eigen::AlignedBox3f BoxOf(std::span<const Eigen::Vector3f> positions) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& position : positions) box.extend(position);
  return box;
}

RTCIntersectContext Context(Coherence coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (coherence == Coherence::kCoherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// A row in one move: what is written in pieces and read whole has to wait for the memory.
void CopyRow(const void* from, void* to) {
  _mm256_store_si256(static_cast<__m256i*>(to),
                     _mm256_load_si256(static_cast<const __m256i*>(from)));
}

void FillRow(std::int32_t value, void* to) {
  _mm256_store_si256(static_cast<__m256i*>(to), _mm256_set1_epi32(value));
}

void Load(const Rays8& rays, RTCRay8* to) {
  CopyRow(rays.ox, to->org_x);
  CopyRow(rays.oy, to->org_y);
  CopyRow(rays.oz, to->org_z);
  CopyRow(rays.dx, to->dir_x);
  CopyRow(rays.dy, to->dir_y);
  CopyRow(rays.dz, to->dir_z);
  CopyRow(rays.t_near, to->tnear);
  CopyRow(rays.t_far, to->tfar);
  FillRow(0, to->time);
  FillRow(-1, to->mask);
  FillRow(0, to->flags);
}

/// Rays of a stream have no mask: those that end before they begin meet nothing.
void LeaveOut(const std::int32_t* valid, RTCRay8* rays) {
  for (int k = 0; k < kLanes; ++k) rays->tfar[k] = valid[k] ? rays->tfar[k] : -kInfinity;
}

/// Where triangles meet or cover each other, any of them may be said to be hit, as the last bit of
/// a distance has it, and that bit is the maker's too. A hit is in doubt less than this share of a
/// triangle from its edge, and on a triangle that a larger one overlaps. Doubtful ones are settled
/// by a rule of our own ...
constexpr float kNearEdge = 1.0f / 4096;
/// ... among all triangles whose distance is the same but for this share.
constexpr float kSameDistance = 1.0f / (1 << 19);

struct Candidate {
  bool in_doubt = true;
  std::uint32_t geometry = kNoGeometry, primitive = 0;

  /// Rather without doubt, of which there is but one; then the first of the mesh.
  bool operator<(const Candidate& other) const {
    return std::tie(in_doubt, geometry, primitive) <
           std::tie(other.in_doubt, other.geometry, other.primitive);
  }
};

std::vector<Corners> CornersOf(const TriangleMesh& mesh) {
  const std::vector<std::uint8_t> overlapped = FindOverlapped(mesh);
  std::vector<Corners> corners;
  corners.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    constexpr float kAllOfIt = 2;  // no hit is farther in
    const bool doubtful = overlapped[corners.size()] != 0;
    corners.push_back(
        {mesh.positions[a], mesh.positions[b], mesh.positions[c], doubtful ? kAllOfIt : kNearEdge});
  }
  return corners;
}

/// A query that passes all triangles that a ray meets, and keeps the first by the rule.
struct Settling : RTCIntersectContext {
  const Instant* instant = nullptr;
  const Rays8* rays = nullptr;
  std::uint32_t geometry = 0;  ///< whose scene is asked
  std::array<Candidate, kLanes> first;
};

}  // namespace

struct Instant::MoverScenes {
  std::vector<Scene> scenes;
};

struct Tracer::Impl {
  Device device;
  Scene statics;
  std::vector<Corners> corners;  ///< of the static world's triangles
  const World* world = nullptr;
  std::mutex pool_mutex;  ///< guards `pool`
  std::vector<std::unique_ptr<Instant::MoverScenes>> pool;
};

Tracer::Tracer(const World& world, const TracerOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->device = NewDevice(options.isa);
  impl_->world = &world;
  if (!world.statics().mesh.triangles.empty()) {
    impl_->statics = BuildScene(impl_->device.get(), world.statics().mesh, false);
    impl_->corners = CornersOf(world.statics().mesh);
  }
  static_box_ = BoxOf(world.statics().mesh.positions);
}

Tracer::~Tracer() = default;

Instant Tracer::Pose(Snapshot snapshot) const {
  std::unique_ptr<Instant::MoverScenes> movers;
  {
    const std::lock_guard lock(impl_->pool_mutex);
    if (!impl_->pool.empty()) {
      movers = std::move(impl_->pool.back());
      impl_->pool.pop_back();
    }
  }
  if (!movers) {
    movers = std::make_unique<Instant::MoverScenes>();
    for (const TriangleMesh& mesh : impl_->world->mover_meshes()) {
      movers->scenes.push_back(BuildScene(impl_->device.get(), mesh, true));
    }
  }
  std::vector<Eigen::AlignedBox3f> boxes(snapshot.movers.size());
  ParallelFor(std::size_t{0}, boxes.size(), [&](std::size_t i) {
    const std::vector<Eigen::Vector3f>& positions = snapshot.movers[i].positions;
    Refit(movers->scenes[i].get(), positions);
    boxes[i] = BoxOf(positions);
  });
  return Instant(*this, std::move(snapshot), std::move(boxes), std::move(movers));
}

Instant::Instant(const Tracer& tracer, Snapshot snapshot, std::vector<Eigen::AlignedBox3f> boxes,
                 std::unique_ptr<MoverScenes> movers)
    : tracer_(&tracer),
      snapshot_(std::move(snapshot)),
      boxes_(std::move(boxes)),
      movers_(std::move(movers)) {}

Instant::Instant(Instant&&) noexcept = default;

Instant::~Instant() {
  if (!movers_) return;
  const std::lock_guard lock(tracer_->impl_->pool_mutex);
  tracer_->impl_->pool.push_back(std::move(movers_));
}

template <typename Ask>
void Instant::ForEachScene(GeometryMask geometries, const Ask& ask) const {
  if (tracer_->impl_->statics && (geometries & kStaticOnly)) {
    ask(tracer_->impl_->statics.get(), 0u);
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (geometries & MoverBit(i)) {
      ask(movers_->scenes[i].get(), static_cast<std::uint32_t>(i + 1));
    }
  }
}

Corners Instant::MoverCorners(std::uint32_t geometry, std::uint32_t primitive) const {
  const std::vector<Eigen::Vector3f>& at = snapshot_.movers[geometry - 1].positions;
  const auto& [a, b, c] = tracer_->impl_->world->mover_meshes()[geometry - 1].triangles[primitive];
  return {at[a], at[b], at[c], kNearEdge};
}

Corners8 Instant::CornersOf(const std::uint32_t* geometry, const std::uint32_t* primitive) const {
  const Corners* statics = tracer_->impl_->corners.data();
  std::uint32_t others = 0, movers = 0;
  for (int k = 0; k < kLanes; ++k) {
    others |= primitive[k] ^ primitive[0];
    movers |= geometry[k];  // or nothing
  }
  if (movers == 0 && others == 0) return Corners8(statics[primitive[0]]);
  std::array<const Corners*, kLanes> by_lane;
  if (movers == 0) {
    for (std::size_t k = 0; k < kLanes; ++k) by_lane[k] = &statics[primitive[k]];
    return Corners8(by_lane);
  }
  std::array<Corners, kLanes> own;
  for (std::size_t k = 0; k < kLanes; ++k) {
    by_lane[k] = geometry[k] == 0 ? &statics[primitive[k]] : &own[k];
    if (geometry[k] != 0 && geometry[k] != kNoGeometry) {
      own[k] = MoverCorners(geometry[k], primitive[k]);
    }
  }
  return Corners8(by_lane);
}

void Instant::Settle(const Rays8& rays, GeometryMask geometries, unsigned lanes,
                     Hits8* hits) const {
  Settling query;
  rtcInitIntersectContext(&query);
  query.instant = this;
  query.rays = &rays;
  query.filter = [](const RTCFilterFunctionNArguments* args) {
    auto& asked = *static_cast<Settling*>(args->context);
    alignas(32) std::uint32_t geometry[kLanes], primitive[kLanes];
    for (unsigned k = 0; k < kLanes; ++k) {
      geometry[k] = args->valid[k] ? asked.geometry : kNoGeometry;
      primitive[k] = RTCHitN_primID(args->hit, kLanes, k);
    }
    const Meetings8 met = Meet(*asked.rays, asked.instant->CornersOf(geometry, primitive));
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (!args->valid[k]) continue;
      const Candidate candidate{met.on_rim[k] != 0, geometry[k], primitive[k]};
      asked.first[k] = std::min(asked.first[k], candidate);
      args->valid[k] = 0;  // go on
    }
  };
  alignas(32) RTCRayHit8 packet;
  Load(rays, &packet.ray);
  alignas(32) std::int32_t valid[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    valid[k] = lanes >> k & 1 ? -1 : 0;
    packet.ray.tnear[k] = std::max(rays.t_near[k], hits->t[k] * (1 - kSameDistance));
    packet.ray.tfar[k] = std::min(rays.t_far[k], hits->t[k] * (1 + kSameDistance));
  }
  FillRow(-1, packet.hit.geomID);
  ForEachScene(geometries, [&](RTCScene scene, std::uint32_t id) {
    query.geometry = id;
    rtcIntersect8(valid, scene, &query, &packet);
  });
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (query.first[k].geometry == kNoGeometry) continue;
    hits->geometry[k] = query.first[k].geometry;
    hits->primitive[k] = query.first[k].primitive;
  }
}

unsigned Instant::Place(const Rays8& rays, Hits8* hits) const {
  const Meetings8 met = Meet(rays, CornersOf(hits->geometry, hits->primitive));
  unsigned in_doubt = 0;
  for (int k = 0; k < kLanes; ++k) {
    const bool hit = hits->geometry[k] != kNoGeometry;
    hits->t[k] = hit ? met.t[k] : kInfinity;
    hits->u[k] = met.u[k];
    hits->v[k] = met.v[k];
    in_doubt |= hit ? static_cast<unsigned>(met.on_rim[k]) & 1u << k : 0u;
  }
  return in_doubt;
}

void Instant::Intersect(const Rays8& rays, Coherence coherence, GeometryMask geometries,
                        Hits8* hits) const {
  Intersect({&rays, 1}, coherence, geometries, {hits, 1});
}

void Instant::Intersect(std::span<const Rays8> rays, Coherence coherence, GeometryMask geometries,
                        std::span<Hits8> hits) const {
  alignas(32) RTCRayHit8 packets[kMostPackets];
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Load(rays[i], &packets[i].ray);
    LeaveOut(rays[i].valid, &packets[i].ray);
    FillRow(0, packets[i].hit.primID);
    FillRow(-1, hits[i].geometry);
  }
  RTCIntersectContext context = Context(coherence);
  // Every scene holds one mesh, number 0: whose it was is told by the call that set it.
  ForEachScene(geometries, [&](RTCScene scene, std::uint32_t id) {
    for (std::size_t i = 0; i < rays.size(); ++i) FillRow(-1, packets[i].hit.geomID);
    if (rays.size() == 1) {
      rtcIntersect8(rays[0].valid, scene, &context, &packets[0]);
    } else {
      rtcIntersectNM(scene, &context, reinterpret_cast<RTCRayHitN*>(packets), kLanes,
                     static_cast<unsigned>(rays.size()), sizeof(RTCRayHit8));
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      for (int k = 0; k < kLanes; ++k) {
        hits[i].geometry[k] = packets[i].hit.geomID[k] == 0 ? id : hits[i].geometry[k];
      }
    }
  });
  // Which triangle was hit is Embree's answer; where, is computed here.
  for (std::size_t i = 0; i < rays.size(); ++i) {
    CopyRow(packets[i].hit.primID, hits[i].primitive);
    if (const unsigned in_doubt = Place(rays[i], &hits[i]); in_doubt != 0) {
      Settle(rays[i], geometries, in_doubt, &hits[i]);
      Place(rays[i], &hits[i]);
    }
  }
}

Meetings8 Instant::MeetStatic(const Rays8& rays, std::uint32_t of_first_four,
                              std::uint32_t of_last_four) const {
  const std::vector<Corners>& statics = tracer_->impl_->corners;
  Corners8 corners(statics[of_first_four], statics[of_last_four]);
  FillRow(0, corners.rim);
  return Meet(rays, corners);
}

void Instant::Occluded(std::span<const Rays8> rays, Coherence coherence, GeometryMask geometries,
                       std::span<unsigned> blocked) const {
  if (rays.size() == 1) {
    blocked[0] = Occluded(rays[0], coherence, geometries);
    return;
  }
  alignas(32) RTCRay8 packets[kMostPackets];
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Load(rays[i], &packets[i]);
    LeaveOut(rays[i].valid, &packets[i]);
  }
  RTCIntersectContext context = Context(coherence);
  // A ray that was blocked ends before it begins, and so in no further scene.
  ForEachScene(geometries, [&](RTCScene scene, std::uint32_t) {
    rtcOccludedNM(scene, &context, reinterpret_cast<RTCRayN*>(packets), kLanes,
                  static_cast<unsigned>(rays.size()), sizeof(RTCRay8));
  });
  for (std::size_t i = 0; i < rays.size(); ++i) {
    blocked[i] = 0;
    for (int k = 0; k < kLanes; ++k) {
      if (rays[i].valid[k] && packets[i].tfar[k] < 0) blocked[i] |= 1u << k;
    }
  }
}

unsigned Instant::Occluded(const Rays8& rays, Coherence coherence, GeometryMask geometries) const {
  alignas(32) RTCRay8 packet;
  Load(rays, &packet);
  alignas(32) std::int32_t open[kLanes];
  CopyRow(rays.valid, open);
  RTCIntersectContext context = Context(coherence);
  unsigned blocked = 0, valid = 0;
  for (int k = 0; k < kLanes; ++k) valid |= rays.valid[k] ? 1u << k : 0u;
  const auto trace = [&](RTCScene scene) {
    rtcOccluded8(open, scene, &context, &packet);
    for (int k = 0; k < kLanes; ++k) {
      if (open[k] && packet.tfar[k] < 0) {
        blocked |= 1u << k;
        open[k] = 0;
      }
    }
  };
  if (tracer_->impl_->statics && (geometries & kStaticOnly)) {
    trace(tracer_->impl_->statics.get());
  }
  for (std::size_t i = 0; i < boxes_.size() && blocked != valid; ++i) {
    if (geometries & MoverBit(i)) trace(movers_->scenes[i].get());
  }
  return blocked;
}

}  // namespace aisle::sim
