#include "slam/dynamic/robust/floor_plane.h"

#include <Eigen/LU>
#include <algorithm>

#include "slam/dynamic/common/counter_random.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kEveryRow = 4, kEveryColumn = 6;
constexpr std::size_t kLeastPoints = 100;
constexpr float kLeastArea = 500;     // squared pixels, twice the triangle of a sample
constexpr float kLeastSlope = 0.02F;  // pixels of disparity a row
constexpr float kHorizon = 0.3F;      // disparity below which a floor is too far to be told
constexpr float kMostRoll = 0.25F;   // tangent of its slope across the image: no vehicle leans more
constexpr double kMostPitch = 1;     // tangent of the camera's
constexpr double kLeastShare = 0.1;  // of the points of the lower half
constexpr float kLeastDepth = 1.5F;  // farthest to nearest of nine tenths of what is seen of it
constexpr int kPlanes = 80;          // through three points, that are tried
constexpr std::uint64_t kSeed = 5;

std::vector<Eigen::Vector3f> PointsOfLowerHalf(const cv::Mat1f& disparity) {
  std::vector<Eigen::Vector3f> points;
  for (int y = disparity.rows / 2; y < disparity.rows; y += kEveryRow) {
    for (int x = 0; x < disparity.cols; x += kEveryColumn) {
      if (disparity(y, x) > kHorizon) {
        points.emplace_back(static_cast<float>(x), static_cast<float>(y), disparity(y, x));
      }
    }
  }
  return points;
}

/// Whether a vehicle that stands on the plane could see it so. A plane n X = h has the disparity
/// (b / h) (n_x x + n_y y + n_z f), x and y from the principal point.
bool IsLevel(const FloorPlane& plane, const StereoCamera& camera) {
  if (plane.y_slope < kLeastSlope) return false;
  const double ahead = plane.x_slope * camera.cx + plane.y_slope * camera.cy + plane.offset;
  return std::abs(plane.x_slope) <= kMostRoll * plane.y_slope &&
         std::abs(ahead) <= kMostPitch * camera.fy * plane.y_slope;
}

std::optional<FloorPlane> PlaneThrough(const std::array<Eigen::Vector3f, 3>& points) {
  Eigen::Matrix3f A;
  Eigen::Vector3f d;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f& point = points[static_cast<std::size_t>(k)];
    A.row(k) << point.x(), point.y(), 1;
    d[k] = point.z();
  }
  if (std::abs(A.determinant()) < kLeastArea) return std::nullopt;
  const Eigen::Vector3f plane = A.inverse() * d;
  return FloorPlane{plane.x(), plane.y(), plane.z()};
}

double Support(const FloorPlane& plane, const std::vector<Eigen::Vector3f>& points,
               const DisparityTolerance& tolerance) {
  double support = 0;
  for (const Eigen::Vector3f& point : points) {
    const float floor = plane.At(static_cast<int>(point.x()), static_cast<int>(point.y()));
    if (tolerance.Same(point.z(), floor)) {
      support += 1;
    } else if (point.z() < floor) {
      support -= 1;  // nothing lies below a floor
    }
  }
  return support;
}

/// Whether it is seen over a range of distances, as a floor is and a belly is not.
bool LeadsAway(const FloorPlane& plane, const std::vector<Eigen::Vector3f>& points,
               const DisparityTolerance& tolerance) {
  std::vector<float> disparities;
  for (const Eigen::Vector3f& point : points) {
    const float floor = plane.At(static_cast<int>(point.x()), static_cast<int>(point.y()));
    if (tolerance.Same(point.z(), floor)) disparities.push_back(point.z());
  }
  if (disparities.empty()) return false;
  std::ranges::sort(disparities);
  const std::size_t tail = disparities.size() / 20;
  return disparities[disparities.size() - 1 - tail] >= kLeastDepth * disparities[tail];
}

}  // namespace

std::optional<FloorPlane> FindFloor(const cv::Mat1f& disparity, const StereoCamera& camera,
                                    const DisparityTolerance& tolerance) {
  const std::vector<Eigen::Vector3f> points = PointsOfLowerHalf(disparity);
  if (points.size() < kLeastPoints) return std::nullopt;
  std::optional<FloorPlane> best;
  double most = kLeastShare * static_cast<double>(points.size());
  for (int k = 0; k < kPlanes; ++k) {
    CounterRandom random(kSeed, static_cast<std::uint64_t>(k));
    std::array<Eigen::Vector3f, 3> sample;
    for (Eigen::Vector3f& point : sample) {
      point = points[static_cast<std::size_t>(random.Below(static_cast<int>(points.size())))];
    }
    const auto plane = PlaneThrough(sample);
    const bool possible = plane && IsLevel(*plane, camera);
    const double support = possible ? Support(*plane, points, tolerance) : 0;
    if (support <= most) continue;
    most = support;
    best = plane;
  }
  return best && LeadsAway(*best, points, tolerance) ? best : std::nullopt;
}

cv::Mat1b FloorMask(const cv::Mat1f& filled, const std::optional<FloorPlane>& floor,
                    const DisparityTolerance& tolerance) {
  cv::Mat1b mask(filled.size(), 0);
  if (!floor) return mask;
  for (int y = 0; y < filled.rows; ++y) {
    for (int x = 0; x < filled.cols; ++x) {
      const float d = floor->At(x, y);
      mask(y, x) = d > kHorizon && tolerance.Same(d, filled(y, x)) ? 255 : 0;
    }
  }
  return mask;
}

}  // namespace aisle::slam::dynamic
