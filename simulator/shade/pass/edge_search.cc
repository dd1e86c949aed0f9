#include "simulator/shade/pass/edge_search.h"

#include <array>
#include <bit>
#include <cstring>
#include <span>

#include "simulator/shade/lanes/wide.h"

namespace aisle::sim {
namespace {

constexpr float kContrast = 0.04f;  // below this an edge cannot be seen in the noise
constexpr float kFaint = 0.1f;      // below this an edge is not worth a ray
constexpr float kFineRate = 0.25f;  // barycentrics a pixel: the triangle is four pixels wide

class Edges {
 public:
  Edges(const ShadingView& shading, const cv::Mat1f& radiance)
      : mesh_(shading.world().statics().mesh),
        view_(shading.view),
        image_(shading.image),
        tables_(shading.tables),
        radiance_(radiance) {}

  /// Goes down columns of eight pixels, because most edges of a hall stand upright and the rays of
  /// neighbours share a packet.
  TileEdges Find(const Tile& tile) const {
    TileEdges found;
    for (int x = tile.x0; x < tile.x1; x += kLanes) {
      for (int y = tile.y0; y < tile.y1; ++y) {
        const Sides sides = Candidates(x, y);
        unsigned left = sides[0] | sides[1] | sides[2] | sides[3];
        for (; left; left &= left - 1) Classify(x, y, std::countr_zero(left), sides, &found);
      }
    }
    return found;
  }

 private:
  static constexpr std::array<PixelAt, 4> kSteps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  /// By step: bits of the pixels among eight that may differ from their neighbour there.
  using Sides = std::array<unsigned, kSteps.size()>;

  /// Few pixels of a row of eight differ from a neighbour, and eight at a time are quickly asked.
  /// At the image's border all may.
  Sides Candidates(int x, int y) const {
    if (x == 0 || y == 0 || y + 1 == image_.height || x + kLanes >= image_.width) {
      const unsigned all = (1u << std::min(kLanes, image_.width - x)) - 1;
      return {all, all, all, all};
    }
    const std::size_t i = image_.Index(x, y);
    const auto stride = static_cast<std::size_t>(image_.stride);
    const I8 geometry = LoadI(&image_.geometry[i]), primitive = LoadI(&image_.primitive[i]);
    const F8 mine = LoadF(&radiance_(y, x));
    const auto differs = [&](std::size_t j, const float* radiance) {
      const F8 other = LoadF(radiance);
      return Bits(
          ((LoadI(&image_.geometry[j]) != geometry) | (LoadI(&image_.primitive[j]) != primitive)) &
          (Abs(mine - other) > kContrast * Max(mine, other)));
    };
    return {differs(i - 1, &radiance_(y, x - 1)), differs(i + 1, &radiance_(y, x + 1)),
            differs(i - stride, &radiance_(y - 1, x)), differs(i + stride, &radiance_(y + 1, x))};
  }

  /// The pixel `lane` to the right of (x, y).
  void Classify(int x, int y, int lane, const Sides& sides, TileEdges* found) const {
    const PixelAt p = {x + lane, y};
    std::array<bool, kSteps.size()> differs{};
    bool any = false;
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      if (!(sides[i] >> lane & 1)) continue;
      const PixelAt q = {p.x + kSteps[i].x, p.y + kSteps[i].y};
      differs[i] =
          q.x >= 0 && q.y >= 0 && q.x < image_.width && q.y < image_.height && Differ(p, q);
      any |= differs[i];
    }
    if (!any) return;
    if (MixFaint(p, differs, found)) return;
    if ((differs[0] && differs[1]) || (differs[2] && differs[3])) {  // a thing one pixel wide
      found->unknown.push_back(p);
      return;
    }
    float share = 0;  // of the pixel that the neighbour's surface covers
    PixelAt other = p;
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      if (!differs[i]) continue;
      const PixelAt q = {p.x + kSteps[i].x, p.y + kSteps[i].y};
      const bool p_is_near = image_.t[Index(p)] <= image_.t[Index(q)];
      const float crossing = p_is_near ? Crossing(p, q) : 1 - Crossing(q, p);
      if (!(crossing >= 0 && crossing <= 1)) {
        found->unknown.push_back(p);
        return;
      }
      if (0.5f - crossing > share) {
        share = 0.5f - crossing;
        other = q;
      }
    }
    if (share <= 0) return;
    const float mine = radiance_(p.y, p.x);
    found->mixed.push_back({p, mine + share * (radiance_(other.y, other.x) - mine)});
  }

  /// Where all sides are nearly as bright, the edge is given the place it has on average: the other
  /// side covers a quarter of the pixel.
  bool MixFaint(PixelAt p, std::span<const bool> differs, TileEdges* found) const {
    const float mine = radiance_(p.y, p.x);
    float sum = 0, count = 0;
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      if (!differs[i]) continue;
      const float other = radiance_(p.y + kSteps[i].y, p.x + kSteps[i].x);
      if (std::abs(other - mine) > kFaint * std::max(other, mine)) return false;
      sum += other;
      count += 1;
    }
    found->mixed.push_back({p, mine + 0.25f * (sum / count - mine)});
    return true;
  }

  std::size_t Index(PixelAt p) const { return image_.Index(p.x, p.y); }

  bool Differ(PixelAt p, PixelAt q) const {
    const std::size_t i = Index(p), j = Index(q);
    if (image_.primitive[i] == image_.primitive[j] && image_.geometry[i] == image_.geometry[j]) {
      return false;
    }
    const float a = radiance_(p.y, p.x), b = radiance_(q.y, q.x);
    if (std::abs(a - b) <= kContrast * std::max(a, b)) return false;
    if (image_.geometry[i] != image_.geometry[j]) return true;
    if (image_.geometry[i] != 0) return std::abs(image_.t[i] - image_.t[j]) > 0.02f * image_.t[i];
    // Two triangles of one flat, plain face are no edge.
    const SurfaceRecord& first = tables_.statics()[image_.primitive[i]];
    const SurfaceRecord& second = tables_.statics()[image_.primitive[j]];
    const Eigen::Map<const Eigen::Vector3f> n(first.normal), m(second.normal);
    return first.texture != second.texture || first.albedo != second.albedo || n.dot(m) < 0.99f ||
           std::abs(image_.t[i] - image_.t[j]) > 0.02f * image_.t[i];
  }

  /// Where on the way from pixel p to its neighbour q (0 to 1) the ray leaves the triangle seen at
  /// p; beyond 1, or -1 where the triangle says little about the outline.
  float Crossing(PixelAt p, PixelAt q) const {
    const std::size_t i = Index(p);
    if (image_.geometry[i] != 0) return -1;
    const PixelRays& rays = *view_.rays;
    const Eigen::Vector2f here_xy = rays.At(p.x, p.y), there_xy = rays.At(q.x, q.y);
    const Eigen::Vector3f d = view_.rotation * here_xy.homogeneous();
    const Eigen::Vector2f turn = there_xy - here_xy;
    const Eigen::Vector3f step = view_.rotation * Eigen::Vector3f(turn.x(), turn.y(), 0);
    const auto& [ia, ib, ic] = mesh_.triangles[image_.primitive[i]];
    const Eigen::Vector3f a = mesh_.positions[ia] - view_.origin;
    const Eigen::Vector3f b = mesh_.positions[ib] - view_.origin;
    const Eigen::Vector3f c = mesh_.positions[ic] - view_.origin;
    // A ray is inside while its products with the three side planes have one sign; they are linear
    // along the image.
    const std::array<Eigen::Vector3f, 3> planes = {b.cross(c), c.cross(a), a.cross(b)};
    std::array<float, 3> here, rate;
    float total = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      here[k] = planes[k].dot(d);
      rate[k] = planes[k].dot(step);
      total += here[k];
    }
    float first = 2;
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(rate[k]) > kFineRate * std::abs(total)) return -1;
      const float leaves = -here[k] / rate[k];
      // Negative: it moves away from this side.
      if (rate[k] * total < 0 && leaves < first) first = std::max(0.0f, leaves);
    }
    return first;
  }

  const TriangleMesh& mesh_;
  const CameraView& view_;
  const HitImage& image_;
  const SurfaceTables& tables_;
  const cv::Mat1f& radiance_;
};

}  // namespace

TileEdges FindEdges(const ShadingView& shading, const cv::Mat1f& radiance, const Tile& tile) {
  return Edges(shading, radiance).Find(tile);
}

}  // namespace aisle::sim
