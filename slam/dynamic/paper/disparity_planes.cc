#include "slam/dynamic/paper/disparity_planes.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "slam/dynamic/common/counter_random.h"

namespace aisle::slam::dynamic {
namespace {

/// Through three samples; not valid if they are close to a line.
DisparityPlane Through(const DisparitySample& p, const DisparitySample& q,
                       const DisparitySample& r) {
  const double x1 = q.x - p.x, y1 = q.y - p.y, d1 = q.d - p.d;
  const double x2 = r.x - p.x, y2 = r.y - p.y, d2 = r.d - p.d;
  const double area = x1 * y2 - x2 * y1;
  DisparityPlane plane;
  if (std::abs(area) < 1.0) return plane;  // less than a pixel's triangle
  plane.a = (d1 * y2 - d2 * y1) / area;
  plane.b = (x1 * d2 - x2 * d1) / area;
  plane.c = p.d - plane.a * p.x - plane.b * p.y;
  plane.valid = true;
  return plane;
}

bool IsInlier(const DisparityPlane& plane, const DisparitySample& s, double inlier_px) {
  return std::abs(plane.At(s.x, s.y) - s.d) <= inlier_px;
}

int CountInliers(const DisparityPlane& plane, const std::vector<DisparitySample>& samples,
                 double inlier_px) {
  return static_cast<int>(
      std::count_if(samples.begin(), samples.end(),
                    [&](const DisparitySample& s) { return IsInlier(plane, s, inlier_px); }));
}

/// Least squares over the inliers of a plane; the plane itself where they do not span one.
DisparityPlane Refit(const DisparityPlane& plane, const std::vector<DisparitySample>& samples,
                     double inlier_px) {
  const DisparitySample& origin = samples.front();  // keeps the normal equations well scaled
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const DisparitySample& s : samples) {
    if (!IsInlier(plane, s, inlier_px)) continue;
    const Eigen::Vector3d row(s.x - origin.x, s.y - origin.y, 1);
    normal += row * row.transpose();
    right += row * s.d;
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() < 1e-6) return plane;
  const Eigen::Vector3d abc = solver.solve(right);
  DisparityPlane refitted = plane;
  refitted.a = abc[0];
  refitted.b = abc[1];
  refitted.c = abc[2] - abc[0] * origin.x - abc[1] * origin.y;
  return refitted;
}

std::vector<std::vector<DisparitySample>> SamplesBySuperpixel(const Superpixels& superpixels,
                                                              const cv::Mat1f& disparity) {
  std::vector<std::vector<DisparitySample>> samples(superpixels.centres.size());
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) {
      if (disparity(y, x) < 0.0F) continue;
      samples[static_cast<std::size_t>(superpixels.labels(y, x))].push_back(
          {static_cast<double>(x), static_cast<double>(y), disparity(y, x)});
    }
  }
  return samples;
}

}  // namespace

DisparityPlane FitDisparityPlane(const std::vector<DisparitySample>& samples, std::uint64_t stream,
                                 const PlaneOptions& options) {
  const int count = static_cast<int>(samples.size());
  DisparityPlane best;
  if (count < std::max(3, options.min_pixels)) return best;
  CounterRandom random(options.seed, stream);
  for (int k = 0; k < options.iterations; ++k) {
    const auto drawn = random.Distinct<3>(count);
    const auto sample = [&](std::size_t i) -> const DisparitySample& {
      return samples[static_cast<std::size_t>(drawn[i])];
    };
    DisparityPlane plane = Through(sample(0), sample(1), sample(2));
    if (!plane.valid) continue;
    plane.inliers = CountInliers(plane, samples, options.inlier_px);
    if (plane.inliers > best.inliers) best = plane;
  }
  if (!best.valid) return best;
  best = Refit(best, samples, options.inlier_px);
  best.inliers = CountInliers(best, samples, options.inlier_px);
  best.samples = count;
  return best;
}

std::vector<DisparityPlane> FitDisparityPlanes(const Superpixels& superpixels,
                                               const cv::Mat1f& disparity,
                                               const PlaneOptions& options) {
  CV_Assert(disparity.size() == superpixels.labels.size());
  const auto samples = SamplesBySuperpixel(superpixels, disparity);
  std::vector<DisparityPlane> planes(samples.size());
  for (std::size_t j = 0; j < samples.size(); ++j) {
    planes[j] = FitDisparityPlane(samples[j], j, options);
  }
  return planes;
}

}  // namespace aisle::slam::dynamic
