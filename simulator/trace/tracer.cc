#include "simulator/trace/tracer.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <mutex>
#include <stdexcept>

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
  const std::string config = isa == "native" ? "" : "isa=" + isa;
  Device device(rtcNewDevice(config.c_str()));
  if (!device) {
    throw std::runtime_error(
        fmt::format("Embree does not start with isa '{}'; try avx2, sse4.2 or native", isa));
  }
  rtcSetDeviceErrorFunction(device.get(), ThrowOnError, nullptr);
  return device;
}

void CopyPositions(std::span<const Eigen::Vector3f> positions, void* to) {
  std::memcpy(to, positions.data(), positions.size() * sizeof(Eigen::Vector3f));
}

/// One mesh, alone in a scene.
Scene BuildScene(RTCDevice device, const TriangleMesh& mesh, bool moves) {
  Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), moves ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE);
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

void Refit(RTCScene scene, std::span<const Eigen::Vector3f> positions) {
  RTCGeometry geometry = rtcGetGeometry(scene, 0);
  CopyPositions(positions, rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
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

constexpr std::size_t kRow = sizeof(float) * kLanes;

void Load(const Rays8& rays, RTCRay8* to) {
  std::memcpy(to->org_x, rays.ox, kRow);
  std::memcpy(to->org_y, rays.oy, kRow);
  std::memcpy(to->org_z, rays.oz, kRow);
  std::memcpy(to->dir_x, rays.dx, kRow);
  std::memcpy(to->dir_y, rays.dy, kRow);
  std::memcpy(to->dir_z, rays.dz, kRow);
  std::memcpy(to->tnear, rays.t_near, kRow);
  std::memcpy(to->tfar, rays.t_far, kRow);
  std::memset(to->time, 0, kRow);
  std::memset(to->mask, 0xff, kRow);
  std::memset(to->flags, 0, kRow);
}

}  // namespace

struct Instant::MoverScenes {
  std::vector<Scene> scenes;
};

struct Tracer::Impl {
  Device device;
  Scene statics;
  const World* world = nullptr;
  std::mutex pool_mutex;  ///< guards `pool`
  std::vector<std::unique_ptr<Instant::MoverScenes>> pool;
};

Tracer::Tracer(const World& world, const TracerOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->device = NewDevice(options.isa);
  impl_->world = &world;
  if (!world.statics().mesh.triangles.empty()) {
    impl_->statics = BuildScene(impl_->device.get(), world.statics().mesh, false);
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
  for (std::size_t i = 0; i < snapshot.movers.size(); ++i) {
    Refit(movers->scenes[i].get(), snapshot.movers[i].positions);
  }
  return Instant(*this, std::move(snapshot), std::move(movers));
}

Instant::Instant(const Tracer& tracer, Snapshot snapshot, std::unique_ptr<MoverScenes> movers)
    : tracer_(&tracer), snapshot_(std::move(snapshot)), movers_(std::move(movers)) {
  for (const MoverState& mover : snapshot_.movers) boxes_.push_back(BoxOf(mover.positions));
}

Instant::Instant(Instant&&) noexcept = default;

Instant::~Instant() {
  if (!movers_) return;
  const std::lock_guard lock(tracer_->impl_->pool_mutex);
  tracer_->impl_->pool.push_back(std::move(movers_));
}

void Instant::Intersect(const Rays8& rays, Coherence coherence, GeometryMask geometries,
                        Hits8* hits) const {
  alignas(32) RTCRayHit8 packet;
  Load(rays, &packet.ray);
  std::memset(packet.hit.geomID, 0xff, kRow);
  alignas(32) std::uint32_t geometry[kLanes];
  std::memset(geometry, 0xff, kRow);
  RTCIntersectContext context = Context(coherence);
  // Every scene holds one mesh, number 0: whose it was is told by the call that set it.
  const auto trace = [&](RTCScene scene, std::uint32_t id) {
    std::memset(packet.hit.geomID, 0xff, kRow);
    rtcIntersect8(rays.valid, scene, &context, &packet);
    for (int k = 0; k < kLanes; ++k) geometry[k] = packet.hit.geomID[k] == 0 ? id : geometry[k];
  };
  if (tracer_->impl_->statics && (geometries & kStaticOnly)) {
    trace(tracer_->impl_->statics.get(), 0);
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (geometries & MoverBit(i)) {
      trace(movers_->scenes[i].get(), static_cast<std::uint32_t>(i + 1));
    }
  }
  for (int k = 0; k < kLanes; ++k) {
    hits->t[k] = geometry[k] == kNoGeometry ? kInfinity : packet.ray.tfar[k];
  }
  std::memcpy(hits->geometry, geometry, kRow);
  std::memcpy(hits->primitive, packet.hit.primID, kRow);
  std::memcpy(hits->u, packet.hit.u, kRow);
  std::memcpy(hits->v, packet.hit.v, kRow);
}

unsigned Instant::Occluded(const Rays8& rays, Coherence coherence, GeometryMask geometries) const {
  alignas(32) RTCRay8 packet;
  Load(rays, &packet);
  alignas(32) std::int32_t open[kLanes];
  std::memcpy(open, rays.valid, kRow);
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
