#include "simulator/world/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace aisle::sim {
namespace {

constexpr float kCut_m = 2.4f;  ///< what begins higher is not drawn: roofs, lamps, tree tops
constexpr int kShift = 4;       ///< sub-pixel bits of OpenCV's drawing
constexpr std::int64_t kStep_ns = 100'000'000;
/// Around the hall; left of it and below it stand the axes' numbers.
constexpr int kMargin_px = 12, kLeft_px = 40, kBottom_px = 24;
constexpr int kTick_px = 4, kLeastBetweenTicks_px = 55;
constexpr double kFontScale = 0.36;

const cv::Scalar kRigWay(40, 40, 210), kActorWay(190, 110, 30), kInk(40, 40, 40);

/// Metres from one tick to the next: 1, 2 or 5 times a power of ten.
double TickStep(double px_per_m) {
  const double least_m = kLeastBetweenTicks_px / px_per_m;
  const double decade = std::pow(10, std::floor(std::log10(least_m)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least_m) return factor * decade;
  }
  return 10 * decade;
}

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
  Plan(const Eigen::AlignedBox2f& area, int width_px)
      : low_(area.min().cast<double>()), high_(area.max().cast<double>()) {
    const Eigen::Vector2d size = high_ - low_;
    scale_ = std::max(1, width_px - kLeft_px - kMargin_px) / size.x();
    picture_ = cv::Mat3b(static_cast<int>(size.y() * scale_) + kMargin_px + kBottom_px,
                         std::max(width_px, kLeft_px + kMargin_px + 1), cv::Vec3b(255, 255, 255));
  }

  cv::Point At(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d px = (point - low_) * scale_;
    constexpr int kUnit = 1 << kShift;
    return {static_cast<int>((px.x() + kLeft_px) * kUnit),
            static_cast<int>((picture_.rows - kBottom_px - px.y()) * kUnit)};
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
    const cv::Point corner = Pixel(point) + cv::Point(6, -4);
    Write(name, corner);
  }

  /// Ticks along x below and along y on the left, in metres of the world.
  void Axes() {
    const double step_m = TickStep(scale_);
    for (double x = std::ceil(low_.x() / step_m) * step_m; x <= high_.x(); x += step_m) {
      const cv::Point at = Pixel({x, low_.y()});
      cv::line(picture_, at, at + cv::Point(0, kTick_px), kInk);
      const std::string number = Number(x) + (x + step_m > high_.x() ? " m" : "");
      Write(number, at + cv::Point(-WidthOf(number) / 2, kTick_px + 12));
    }
    for (double y = std::ceil(low_.y() / step_m) * step_m; y <= high_.y(); y += step_m) {
      const cv::Point at = Pixel({low_.x(), y});
      cv::line(picture_, at, at - cv::Point(kTick_px, 0), kInk);
      const std::string number = Number(y);
      Write(number, at + cv::Point(-kTick_px - 3 - WidthOf(number), 4));
    }
  }

  PlanPicture Take() {
    const cv::Point2d origin(At({0, 0}));
    return {std::move(picture_), origin / static_cast<double>(1 << kShift), scale_};
  }

 private:
  cv::Point Pixel(const Eigen::Vector2d& point) const {
    const cv::Point fine = At(point);
    return {fine.x >> kShift, fine.y >> kShift};
  }
  static std::string Number(double metres) { return fmt::format("{:g}", metres + 0.0); }
  static int WidthOf(const std::string& text) {
    return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, nullptr).width;
  }
  void Write(const std::string& text, cv::Point corner) {
    corner.x = std::clamp(corner.x, 0, std::max(0, picture_.cols - WidthOf(text)));
    cv::putText(picture_, text, corner, cv::FONT_HERSHEY_SIMPLEX, kFontScale, kInk, 1, cv::LINE_AA);
  }

  Eigen::Vector2d low_, high_;
  double scale_ = 1;
  cv::Mat3b picture_;
};

bool Far(const std::vector<Eigen::Vector2d>& way) {
  return std::ranges::any_of(way, [&](const auto& p) { return (p - way.front()).norm() > 0.3; });
}

}  // namespace

PlanPicture DrawPlan(const World& world, std::int64_t end_ns, int width_px) {
  const StaticWorld& statics = world.statics();
  Eigen::AlignedBox2f area;
  for (const Eigen::Vector3f& position : statics.mesh.positions) area.extend(position.head<2>());
  Plan plan(area, width_px);
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
  plan.Axes();
  return plan.Take();
}

}  // namespace aisle::sim
