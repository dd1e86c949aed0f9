#include "simulator/shade/reference/reference.h"

#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/reference/path_random.h"
#include "simulator/shade/surface/gloss.h"
#include "simulator/shade/surface/luminaires.h"
#include "simulator/shade/surface/normal_map.h"

namespace aisle::sim {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kLift = 1e-4f;     // of the coordinates' size, along the normal
constexpr float kPoint_m = 1e-4f;  // how wide normal maps are averaged
constexpr int kSplit = 4;          // lights that a path's first vertex asks; later ones ask one
constexpr float kRouletteBelow = 0.2f;  // throughput under which a path may end early
constexpr float kLightGuard = 1e-3f;    // share of the way that a shadow ray leaves out at its end

struct Vertex {
  Eigen::Vector3f position;         ///< just above the triangle
  Eigen::Vector3f on_smooth;        ///< above it on the smooth surface
  Eigen::Vector3f geometric;        ///< the triangle's normal; like the others on the path's side
  Eigen::Vector3f smooth, shading;  ///< without and with the normal map
  float albedo = 0, emission = 0;
  Finish finish;
  std::int32_t light = -1;  ///< whose surface this is
};

/// Where the smooth surface that a triangle's normals describe passes over a point of it: the
/// point's projections on the corners' tangent planes, averaged, and never below the triangle
/// (Hanika 2021, "Hacking the Shadow Terminator").
Eigen::Vector3f OnSmoothSurface(const std::array<Eigen::Vector3f, 3>& corners,
                                const std::array<Eigen::Vector3f, 3>& normals,
                                const std::array<float, 3>& weights) {
  Eigen::Vector3f point = Eigen::Vector3f::Zero(), lift = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < 3; ++i) point += weights[i] * corners[i];
  for (std::size_t i = 0; i < 3; ++i) {
    lift -= weights[i] * std::min(0.0f, (point - corners[i]).dot(normals[i])) * normals[i];
  }
  return point + lift;
}

/// Where a ray that leaves a vertex starts. What the triangle hides behind its own plane, but the
/// smooth surface does not, is seen from the latter: no facets where light grazes.
const Eigen::Vector3f& StartOf(const Vertex& vertex, const Eigen::Vector3f& direction) {
  return direction.dot(vertex.geometric) > 0 ? vertex.position : vertex.on_smooth;
}

/// How a vertex scatters towards the camera's side: a diffuse base and a glossy lobe.
class Scattering {
 public:
  Scattering(const Vertex& vertex, const Eigen::Vector3f& to_camera)
      : finish_(vertex.finish), albedo_(vertex.albedo), basis_(BasisAround(vertex.shading)) {
    const Eigen::Vector3f local = basis_.transpose() * to_camera.normalized();
    out_ = {local.x(), local.y(), local.z()};
    if (finish_.f0 <= 0 || out_.z <= 0) {
      finish_ = {};
      return;
    }
    const float share = GlossShare(finish_.f0, finish_.roughness, out_.z);
    albedo_ *= 1 - share;
    gloss_chance_ = share / (share + albedo_);
  }

  /// Brdf times cosine for a unit direction, and the density with which Sample finds it.
  LobeValue Evaluate(const Eigen::Vector3f& direction) const {
    const Eigen::Vector3f local = basis_.transpose() * direction;
    if (local.z() <= 0) return {};
    const float diffuse = local.z() / kPi;
    const LobeValue lobe = EvaluateLobe(finish_, out_, {local.x(), local.y(), local.z()});
    return {albedo_ * diffuse + lobe.reflected,
            (1 - gloss_chance_) * diffuse + gloss_chance_ * lobe.density};
  }

  Eigen::Vector3f Sample(PathRandom* random) const {
    const bool glossy = gloss_chance_ > 0 && random->Next() < gloss_chance_;
    const float r = std::sqrt(random->Next()), phi = 2 * kPi * random->Next();
    if (!glossy) {
      return basis_ * Eigen::Vector3f(r * std::cos(phi), r * std::sin(phi),
                                      std::sqrt(std::max(0.0f, 1 - r * r)));
    }
    const Triple<float> facet =
        SampleFacet(out_, finish_.roughness * finish_.roughness, r, std::cos(phi), std::sin(phi));
    const float twice = 2 * Dot(out_, facet);
    return basis_ * Eigen::Vector3f(twice * facet.x - out_.x, twice * facet.y - out_.y,
                                    twice * facet.z - out_.z);
  }

 private:
  Finish finish_;
  float albedo_;
  float gloss_chance_ = 0;
  Eigen::Matrix3f basis_;
  Triple<float> out_;
};

/// How likely each light is to be picked at a vertex: by what its centre would give unshadowed,
/// with a floor, so that no light that could count is left out.
class LightChoice {
 public:
  LightChoice(std::span<const ReferenceLight> lights, std::span<const float> scale,
              const Vertex& at, std::vector<float>* cumulative)
      : cumulative_(*cumulative) {
    cumulative_.clear();
    float total = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const ReferenceLight& light = lights[i];
      const Eigen::Vector3f to = light.center - at.position;
      const float distance2 = to.squaredNorm();
      const float cosines =
          std::max(0.0f, to.dot(at.shading)) * std::max(0.0f, -to.dot(light.normal));
      // Softened, as a large light may reach around the horizon or very near.
      total += light.power * scale[i] / (distance2 + light.extent2) *
               (0.05f + cosines / std::max(distance2, 1e-12f));
      cumulative_.push_back(total);
    }
  }
  bool empty() const { return cumulative_.empty() || cumulative_.back() <= 0; }
  std::size_t Pick(float random) const {
    const auto found = std::ranges::upper_bound(cumulative_, random * cumulative_.back());
    return std::min(static_cast<std::size_t>(found - cumulative_.begin()), cumulative_.size() - 1);
  }
  float Probability(std::size_t light) const {
    return (cumulative_[light] - (light ? cumulative_[light - 1] : 0)) / cumulative_.back();
  }

 private:
  std::vector<float>& cumulative_;
};

}  // namespace

/// Eight paths, one a pixel, that grow together.
class PathPacket {
 public:
  PathPacket(const Reference& scene, const Instant& instant, const ReferenceOptions& options)
      : scene_(scene), instant_(instant), options_(options) {}

  void Start(int lane, const PathRandom& random, const Eigen::Vector3f& origin,
             const Eigen::Vector3f& direction) {
    const auto k = static_cast<std::size_t>(lane);
    random_[k] = random;
    throughput_[k] = 1;
    radiance_[k] = 0;
    scatter_pdf_[k] = 0;
    SetRay(origin, direction, kInfinity, lane, &rays_);
  }
  void Idle(int lane) { rays_.valid[lane] = 0; }
  PathRandom& random(int lane) { return random_[static_cast<std::size_t>(lane)]; }
  float radiance(int lane) const { return radiance_[static_cast<std::size_t>(lane)]; }

  void Trace() {
    for (int touched = 1; touched <= options_.depth && AnyValid(); ++touched) {
      Hits8 hits;
      instant_.Intersect(rays_, Coherence::kIncoherent, kEverything, &hits);
      const int split = touched == 1 ? kSplit : 1;
      std::array<Aim, kSplit> aims;
      for (Aim& aim : aims) std::ranges::fill(aim.shadow.valid, 0);
      for (int k = 0; k < kLanes; ++k) {
        if (rays_.valid[k]) Touch(k, hits, touched, std::span(aims).first(split));
      }
      for (const Aim& aim : std::span(aims).first(split)) {
        const unsigned blocked = instant_.Occluded(aim.shadow, Coherence::kIncoherent, kEverything);
        for (std::size_t k = 0; k < kLanes; ++k) {
          if (aim.shadow.valid[k] && !(blocked >> k & 1)) radiance_[k] += aim.light[k];
        }
      }
    }
  }

 private:
  /// Eight shadow rays, and what each path receives where its ray arrives.
  struct Aim {
    Rays8 shadow;
    std::array<float, kLanes> light;
  };

  bool AnyValid() const {
    return std::ranges::any_of(rays_.valid, [](int v) { return v != 0; });
  }

  /// One path meets a surface: what it shows by itself, a shadow ray to a light for each of `aims`,
  /// and where the path goes on.
  void Touch(int lane, const Hits8& hits, int touched, std::span<Aim> aims) {
    const auto k = static_cast<std::size_t>(lane);
    rays_.valid[lane] = 0;
    if (hits.geometry[k] == kNoGeometry) return;
    const Eigen::Vector3f origin(rays_.ox[k], rays_.oy[k], rays_.oz[k]);
    const Eigen::Vector3f direction(rays_.dx[k], rays_.dy[k], rays_.dz[k]);
    const Vertex vertex = VertexAt(direction, hits, k);
    radiance_[k] += throughput_[k] * vertex.emission * EmissionWeight(k, origin, vertex);
    if (touched == options_.depth || (vertex.albedo <= 0 && vertex.finish.f0 <= 0)) return;

    const Scattering scattering(vertex, -direction);
    const LightChoice choice(scene_.lights_, instant_.snapshot().light_scale, vertex, &scratch_);
    for (std::size_t i = 0; !choice.empty() && i < aims.size(); ++i) {
      AimAtLight(lane, vertex, scattering, choice, aims.size(), &aims[i]);
    }

    const Eigen::Vector3f next = scattering.Sample(&random_[k]);
    const LobeValue value = scattering.Evaluate(next);
    if (next.dot(vertex.smooth) <= 0 || value.density <= 0) return;
    throughput_[k] *= value.reflected / value.density;
    // Russian roulette: what survives stands for what does not.
    const float survival = std::min(1.0f, throughput_[k] / kRouletteBelow);
    if (touched > 2 && survival < 1) {
      if (random_[k].Next() >= survival) return;
      throughput_[k] /= survival;
    }
    scatter_pdf_[k] = value.density;
    light_samples_[k] = static_cast<float>(aims.size());
    last_[k] = vertex;
    SetRay(StartOf(vertex, next), next, kInfinity, lane, &rays_);
  }

  /// How much the light a path runs into counts beside the light that was aimed at.
  float EmissionWeight(std::size_t k, const Eigen::Vector3f& origin, const Vertex& vertex) {
    if (vertex.emission <= 0 || scatter_pdf_[k] <= 0 || vertex.light < 0) return 1;
    const auto index = static_cast<std::size_t>(vertex.light);
    const ReferenceLight& light = scene_.lights_[index];
    const LightChoice choice(scene_.lights_, instant_.snapshot().light_scale, last_[k], &scratch_);
    const Eigen::Vector3f to = vertex.position - origin;
    const float cosine = std::abs(to.normalized().dot(light.normal));
    const float pdf =
        choice.Probability(index) * to.squaredNorm() / std::max(cosine * light.area, 1e-9f);
    return scatter_pdf_[k] / (scatter_pdf_[k] + light_samples_[k] * pdf);
  }

  void AimAtLight(int lane, const Vertex& vertex, const Scattering& scattering,
                  const LightChoice& choice, std::size_t samples, Aim* aim) {
    const auto k = static_cast<std::size_t>(lane);
    const std::size_t index = choice.Pick(random_[k].Next());
    const AreaLight& rectangle = scene_.world_.lights()[index];
    const ReferenceLight& light = scene_.lights_[index];
    const float a = 2 * random_[k].Next() - 1, b = 2 * random_[k].Next() - 1;
    const Eigen::Vector3f lamp = light.center + a * rectangle.half_u + b * rectangle.half_v;
    const Eigen::Vector3f& start = StartOf(vertex, lamp - vertex.position);
    const Eigen::Vector3f to = lamp - start;
    const float squared = to.squaredNorm(), distance = std::sqrt(squared);
    const float here = to.dot(vertex.shading) / distance;
    const float there = -to.dot(light.normal) / distance;
    if (here <= 0 || there <= 0 || to.dot(vertex.smooth) <= 0) return;
    const auto count = static_cast<float>(samples);
    const float pdf = count * choice.Probability(index) * squared / (there * light.area);
    const LobeValue value = scattering.Evaluate(to / distance);
    const float weight = pdf / (pdf + value.density);
    const float radiance = rectangle.radiance * instant_.snapshot().light_scale[index];
    aim->light[k] = throughput_[k] * value.reflected * radiance / pdf * weight;
    SetRay(start, to, 1 - kLightGuard, lane, &aim->shadow);
  }

  Vertex VertexAt(const Eigen::Vector3f& direction, const Hits8& hits, std::size_t k) const {
    const World& world = scene_.world_;
    const bool is_static = hits.geometry[k] == 0;
    const TriangleMesh& mesh =
        is_static ? world.statics().mesh : world.mover_meshes()[hits.geometry[k] - 1];
    const auto& positions =
        is_static ? mesh.positions : instant_.snapshot().movers[hits.geometry[k] - 1].positions;
    const auto& normals =
        is_static ? mesh.normals : instant_.snapshot().movers[hits.geometry[k] - 1].normals;
    const std::uint32_t triangle = hits.primitive[k];
    const auto& [ia, ib, ic] = mesh.triangles[triangle];
    const float u = hits.u[k], v = hits.v[k], w = 1 - u - v;
    const Material& material = world.materials()[mesh.materials[triangle]];

    const Eigen::Vector3f geometric =
        (positions[ib] - positions[ia]).cross(positions[ic] - positions[ia]).normalized();
    const bool front = geometric.dot(direction) < 0;
    const float side = front ? 1 : -1;
    const MeshPlace place{mesh, positions, normals, triangle, u, v};
    const auto towards_path = [&](const Eigen::Vector3f& normal) -> Eigen::Vector3f {
      return normal.dot(geometric) < 0 ? -side * normal : side * normal;
    };
    Vertex vertex;
    vertex.smooth = towards_path(SmoothNormal(place));
    vertex.shading = towards_path(MappedNormal(place, material, scene_.textures_, kPoint_m));
    vertex.geometric = side * geometric;
    vertex.position = w * positions[ia] + u * positions[ib] + v * positions[ic];
    vertex.on_smooth =
        OnSmoothSurface({positions[ia], positions[ib], positions[ic]},
                        {side * normals[ia], side * normals[ib], side * normals[ic]}, {w, u, v});
    const float size = std::max(1.0f, vertex.position.cwiseAbs().maxCoeff());
    const Eigen::Vector3f lift = kLift * size * vertex.geometric;
    vertex.position += lift;
    vertex.on_smooth += lift;
    const Eigen::Vector2f uv = w * mesh.uvs[ia] + u * mesh.uvs[ib] + v * mesh.uvs[ic];
    vertex.albedo = material.albedo;
    vertex.finish = FinishOf(material);
    if (material.albedo_texture >= 0) {
      vertex.albedo *= scene_.textures_.SampleWide(material.albedo_texture, uv.x(), uv.y(), 1e-5f);
    }
    if (front && material.emission > 0 && is_static) {
      vertex.light = scene_.light_of_triangle_[triangle];
      vertex.emission = material.emission;
      if (vertex.light >= 0) {
        vertex.emission *= instant_.snapshot().light_scale[static_cast<std::size_t>(vertex.light)];
      }
    }
    return vertex;
  }

  const Reference& scene_;
  const Instant& instant_;
  const ReferenceOptions& options_;
  Rays8 rays_{};
  std::array<PathRandom, kLanes> random_;
  std::array<float, kLanes> throughput_{}, radiance_{};
  std::array<float, kLanes> scatter_pdf_{};    ///< of the direction that led here; 0: the camera's
  std::array<float, kLanes> light_samples_{};  ///< that the vertex before took
  std::vector<float> scratch_;
  std::array<Vertex, kLanes> last_;
};

Reference::Reference(const World& world, const TexturePool& textures)
    : world_(world), textures_(textures) {
  for (const AreaLight& light : world.lights()) {
    const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
    const float area = 4 * cross.norm(), extent = light.half_u.norm() + light.half_v.norm();
    lights_.push_back({.center = light.center,
                       .normal = cross.normalized(),
                       .area = area,
                       .power = area * light.radiance,
                       .extent2 = extent * extent});
  }
  const TriangleMesh& mesh = world.statics().mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const bool shines = world.materials()[mesh.materials[i]].emission > 0;
    const auto light = shines ? LightShown(world, i) : std::nullopt;
    light_of_triangle_.push_back(light ? static_cast<std::int32_t>(*light) : -1);
  }
}

cv::Mat1f Reference::Render(const Instant& instant, const CameraView& view,
                            const ReferenceOptions& options) const {
  const PixelRays& rays = *view.rays;
  cv::Mat1f image(rays.height, rays.width, 0.0f);
  ParallelFor(0, rays.height, [&](int y) {
    PathPacket packet(*this, instant, options);
    for (int x0 = 0; x0 < rays.width; x0 += kLanes) {
      for (int sample = 0; sample < options.samples; ++sample) {
        for (int k = 0; k < kLanes; ++k) {
          const int x = x0 + k;
          packet.Idle(k);
          if (x >= rays.width) continue;
          const auto pixel = static_cast<std::size_t>(y * rays.width + x);
          PathRandom random(options.seed, pixel, static_cast<std::uint64_t>(sample));
          const float jx = random.Next() - 0.5f, jy = random.Next() - 0.5f;
          const Eigen::Vector3f direction =
              view.rotation * Eigen::Vector3f(rays.x[pixel] + jx * rays.step_x,
                                              rays.y[pixel] + jy * rays.step_y, 1);
          packet.Start(k, random, view.origin, direction);
        }
        packet.Trace();
        for (int k = 0; k < kLanes && x0 + k < rays.width; ++k) {
          image(y, x0 + k) += packet.radiance(k) / static_cast<float>(options.samples);
        }
      }
    }
  });
  return image;
}

}  // namespace aisle::sim
