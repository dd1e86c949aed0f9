#include "simulator/world/plan.h"

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace aisle::sim {
namespace {

constexpr float kCut_m = 2.4f;  ///< what begins higher is not drawn: roofs, lamps, tree tops
constexpr int kShift = 4;       ///< sub-pixel bits of OpenCV's drawing
constexpr std::int64_t kStep_ns = 100'000'000;
constexpr int kMargin_px = 12;

const cv::Scalar kRigWay(40, 40, 210), kActorWay(190, 110, 30), kInk(40, 40, 40);

cv::Scalar ColourOf(ObjectClass object_class) {
  switch (object_class) {
    case ObjectClass::kFloor:
      return {236, 238, 240};
    case ObjectClass::kWall:
      return {120, 124, 130};
    case ObjectClass::kColumn:
      return {60, 170, 230};
    case ObjectClass::kRack:
      return {170, 120, 80};
    case ObjectClass::kGoods:
      return {130, 175, 205};
    case ObjectClass::kPerson:
    case ObjectClass::kCyclist:
      return {60, 150, 60};
    case ObjectClass::kForklift:
    case ObjectClass::kAgv:
    case ObjectClass::kPalletJack:
    case ObjectClass::kCar:
      return {40, 130, 235};
    default:
      return {165, 170, 175};
  }
}

class Plan {
 public:
  Plan(const Eigen::AlignedBox2f& area, double px_per_m)
      : low_(area.min().cast<double>()), scale_(px_per_m) {
    const Eigen::Vector2d size = area.sizes().cast<double>() * px_per_m;
    picture_ = cv::Mat3b(static_cast<int>(size.y()) + 2 * kMargin_px,
                         static_cast<int>(size.x()) + 2 * kMargin_px, cv::Vec3b(255, 255, 255));
  }

  cv::Point At(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d px = (point - low_) * scale_;
    constexpr int kUnit = 1 << kShift;
    return {static_cast<int>((px.x() + kMargin_px) * kUnit),
            static_cast<int>((picture_.rows - kMargin_px - px.y()) * kUnit)};
  }

  /// Triangles from low to high, those over the cut left out.
  template <class ClassOfTriangle>
  void Draw(const TriangleMesh& mesh, const std::vector<Eigen::Vector3f>& positions,
            const ClassOfTriangle& class_of) {
    const auto bottom = [&](std::size_t i) {
      const auto& [a, b, c] = mesh.triangles[i];
      return std::min({positions[a].z(), positions[b].z(), positions[c].z()});
    };
    std::vector<std::size_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t i) {
      return bottom(i) > kCut_m || class_of(i) == ObjectClass::kNone;
    });
    std::ranges::stable_sort(order, {}, bottom);
    for (const std::size_t i : order) {
      std::array<cv::Point, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = At(positions[mesh.triangles[i][k]].head<2>().cast<double>());
      }
      cv::fillConvexPoly(picture_, corners.data(), 3, ColourOf(class_of(i)), cv::LINE_AA, kShift);
    }
  }

  void Way(const std::vector<Eigen::Vector2d>& points, const cv::Scalar& colour, int width) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      cv::line(picture_, At(points[i - 1]), At(points[i]), colour, width, cv::LINE_AA, kShift);
    }
    cv::circle(picture_, At(points.front()), (width + 2) << kShift, colour, cv::FILLED, cv::LINE_AA,
               kShift);
  }

  void Name(const Eigen::Vector2d& point, const std::string& name) {
    const cv::Point at = At(point);
    const cv::Point corner((at.x >> kShift) + 6, (at.y >> kShift) - 4);
    cv::putText(picture_, name, corner, cv::FONT_HERSHEY_SIMPLEX, 0.36, kInk, 1, cv::LINE_AA);
  }

  cv::Mat3b Take() { return std::move(picture_); }

 private:
  Eigen::Vector2d low_;
  double scale_;
  cv::Mat3b picture_;
};

bool Far(const std::vector<Eigen::Vector2d>& way) {
  return std::ranges::any_of(way, [&](const auto& p) { return (p - way.front()).norm() > 0.3; });
}

}  // namespace

cv::Mat3b DrawPlan(const World& world, std::int64_t end_ns, double px_per_m) {
  const StaticWorld& statics = world.statics();
  Eigen::AlignedBox2f area;
  for (const Eigen::Vector3f& position : statics.mesh.positions) area.extend(position.head<2>());
  Plan plan(area, px_per_m);
  plan.Draw(statics.mesh, statics.mesh.positions,
            [&](std::size_t i) { return world.instances()[statics.instances[i]].object_class; });
  const Snapshot first = world.At(0);
  std::vector<Eigen::Vector2d> rig;
  std::vector<std::vector<Eigen::Vector2d>> ways(first.movers.size());
  for (std::int64_t stamp = 0; stamp <= end_ns; stamp += kStep_ns) {
    rig.emplace_back(world.PlannedRigPose(stamp).translation().head<2>());
    const Snapshot now = world.At(stamp);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      ways[i].emplace_back(now.movers[i].T_world_object.translation().head<2>());
    }
  }
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const MoverState& mover = first.movers[i];
    const Instance& actor = world.instances()[mover.instance];
    plan.Draw(world.mover_meshes()[i], mover.positions,
              [&](std::size_t) { return actor.object_class; });
    if (Far(ways[i])) plan.Way(ways[i], kActorWay, 2);
    if (Far(ways[i]) || actor.object_class == ObjectClass::kPerson) {
      plan.Name(ways[i].front(), actor.name);
    }
  }
  plan.Way(rig, kRigWay, 3);
  return plan.Take();
}

}  // namespace aisle::sim
