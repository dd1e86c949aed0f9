#include "slam/dynamic/paper/boundary_labels.h"

namespace aisle::slam::dynamic {
namespace {

DisparityPlane Gap(const DisparityPlane& i, const DisparityPlane& j) {
  DisparityPlane gap;
  gap.a = i.a - j.a;
  gap.b = i.b - j.b;
  gap.c = i.c - j.c;
  return gap;
}

struct Adjacency {
  std::vector<PixelMoments> superpixels;
  std::map<BoundaryKey, PixelMoments> boundaries;
};

/// Moments of every superpixel and of every boundary; a pixel belongs to each boundary it touches,
/// once.
Adjacency CollectMoments(const cv::Mat1i& labels, std::size_t superpixels) {
  Adjacency adjacency{std::vector<PixelMoments>(superpixels), {}};
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int here = labels(y, x);
      adjacency.superpixels[static_cast<std::size_t>(here)].Add(x, y);
      const std::array<int, 4> around = {y > 0 ? labels(y - 1, x) : here,
                                         x > 0 ? labels(y, x - 1) : here,
                                         x + 1 < labels.cols ? labels(y, x + 1) : here,
                                         y + 1 < labels.rows ? labels(y + 1, x) : here};
      for (std::size_t k = 0; k < 4; ++k) {
        const bool seen = std::find(around.begin(), around.begin() + static_cast<int>(k),
                                    around[k]) != around.begin() + static_cast<int>(k);
        if (around[k] == here || seen) continue;
        adjacency.boundaries[std::minmax(here, around[k])].Add(x, y);
      }
    }
  }
  return adjacency;
}

}  // namespace

void PixelMoments::Add(double px, double py) {
  n += 1;
  x += px;
  y += py;
  xx += px * px;
  xy += px * py;
  yy += py * py;
}

PixelMoments PixelMoments::operator+(const PixelMoments& o) const {
  return {n + o.n, x + o.x, y + o.y, xx + o.xx, xy + o.xy, yy + o.yy};
}

double PixelMoments::SumOf(const DisparityPlane& p) const { return p.a * x + p.b * y + p.c * n; }

double PixelMoments::SumOfSquares(const DisparityPlane& p) const {
  return p.a * p.a * xx + p.b * p.b * yy + p.c * p.c * n +
         2 * (p.a * p.b * xy + p.a * p.c * x + p.b * p.c * y);
}

BoundaryType BoundaryEnergy::Least() const {
  BoundaryType type = BoundaryType::kCoplanar;
  double least = coplanar;
  const auto offer = [&](BoundaryType other, double energy) {
    if (energy >= least) return;
    type = other;
    least = energy;
  };
  offer(BoundaryType::kHinge, hinge);
  offer(BoundaryType::kLeftOcclusion, left_occlusion);
  offer(BoundaryType::kRightOcclusion, right_occlusion);
  return type;
}

BoundaryEnergy EnergyOf(const DisparityPlane& plane_i, const DisparityPlane& plane_j,
                        const PixelMoments& boundary, const PixelMoments& both,
                        const BoundaryOptions& options) {
  const DisparityPlane gap = Gap(plane_i, plane_j);
  const double i_before_j = boundary.SumOf(gap);
  const auto occlusion = [&](double front_minus_back) {  // Equations (10), (11)
    return (front_minus_back < 0 ? options.lambda_penalty : 0) + options.lambda_occlusion;
  };
  BoundaryEnergy energy;  // Equations (9), (11)
  energy.left_occlusion = occlusion(i_before_j);
  energy.right_occlusion = occlusion(-i_before_j);
  energy.hinge = boundary.SumOfSquares(gap) / boundary.n + options.lambda_hinge;
  energy.coplanar = both.SumOfSquares(gap) / both.n;
  return energy;
}

std::map<BoundaryKey, BoundaryType> LabelBoundaries(const cv::Mat1i& labels,
                                                    const std::vector<DisparityPlane>& planes,
                                                    const BoundaryOptions& options) {
  const Adjacency adjacency = CollectMoments(labels, planes.size());
  std::map<BoundaryKey, BoundaryType> types;
  for (const auto& [key, boundary] : adjacency.boundaries) {
    const auto i = static_cast<std::size_t>(key.first), j = static_cast<std::size_t>(key.second);
    const bool known = planes[i].valid && planes[j].valid;
    types[key] = known ? EnergyOf(planes[i], planes[j], boundary,
                                  adjacency.superpixels[i] + adjacency.superpixels[j], options)
                             .Least()
                       : BoundaryType::kUnknown;
  }
  return types;
}

bool IsOcclusion(const std::map<BoundaryKey, BoundaryType>& boundaries, int a, int b) {
  const auto found = boundaries.find(std::minmax(a, b));
  return found != boundaries.end() && (found->second == BoundaryType::kLeftOcclusion ||
                                       found->second == BoundaryType::kRightOcclusion);
}

}  // namespace aisle::slam::dynamic
