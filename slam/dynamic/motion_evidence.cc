#include "slam/dynamic/motion_evidence.h"

#include <tbb/parallel_for.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/median.h"
#include "slam/dynamic/residual_flow.h"

namespace aisle::slam::dynamic {
namespace {

/// Mean squared difference of two images in units of its variance, over small windows and without
/// the local mean: exposure and soft shadows drop out.
cv::Mat1f Misfit(const cv::Mat1b& image, const cv::Mat1b& other, const cv::Mat1f& variance) {
  constexpr int kLocalMean = 11, kWindow = 5;
  cv::Mat1f difference, mean, misfit;
  cv::subtract(image, other, difference, cv::noArray(), CV_32F);
  cv::boxFilter(difference, mean, -1, {kLocalMean, kLocalMean});
  difference -= mean;
  cv::boxFilter(difference.mul(difference) / variance, misfit, -1, {kWindow, kWindow});
  return misfit;
}

float Squared(double a) { return static_cast<float>(a * a); }

/// What the earlier frame saw around a place: of the disparities there, the one nearest to either
/// of those that would make sense; negative if none is known.
float DisparityAround(const cv::Mat1f& disparity, const cv::Vec2f& place, float one, float other) {
  const int cx = cvRound(place[0]), cy = cvRound(place[1]);
  float best = -1, least = std::numeric_limits<float>::infinity();
  for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, disparity.rows - 1); ++y) {
    for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, disparity.cols - 1); ++x) {
      const float d = disparity(y, x);
      const float distance = std::min(std::abs(d - one), std::abs(d - other));
      if (d <= 0 || distance >= least) continue;
      least = distance;
      best = d;
    }
  }
  return best;
}

struct Evidence {
  const Comparison& frames;
  const Texture& texture;
  const EvidenceOptions& options;
  StaticField expected;
  cv::Mat1f variance;  // of the difference of two grey values
  cv::Mat1f misfit_static, misfit_moved;
  cv::Mat1f nearest;  // largest disparity within reach

  float most;                    // log-odds that matter
  float mover_px_per_disparity;  // image speed of a mover over the gap, for each pixel of disparity
  float disparity_change;        // of a mover over the gap, for each squared pixel of disparity

  /// Whether something nearer is so close that the flow here is its flow.
  bool IsBesideNearer(int y, int x, float d) const {
    return nearest(y, x) > d + static_cast<float>(options.edge_step + options.edge_share * d);
  }

  float SameSurface(float d) const {
    return static_cast<float>(options.same_surface + options.same_surface_share * d);
  }

  /// Of a static pixel's flow: what its disparity and the way it has gone add to the flow's own.
  float OtherVariance(int y, int x) const {
    const cv::Vec2f way =
        expected.place(y, x) - cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
    const cv::Vec2f& along = expected.per_disparity(y, x);
    return Squared(options.disparity_noise) * along.dot(along) +
           Squared(options.noise_per_displacement) * way.dot(way);
  }

  Eigen::Matrix2f Information(int y, int x) const {
    Eigen::Matrix2f G;
    G << texture.xx(y, x), texture.xy(y, x), texture.xy(y, x), texture.yy(y, x);
    return G;
  }

  Eigen::Vector2f Residual(int y, int x) const {
    const cv::Vec2f r = frames.flow(y, x) - expected.place(y, x);
    return {r[0], r[1]};
  }

  float StaticVariance(int y, int x) const {
    return Squared(frames.flow_noise) + OtherVariance(y, x);
  }

  float FlowLogOdds(int y, int x, float d, const Eigen::Vector2f& r) const {
    return DisplacementLogOdds(Information(y, x), r, StaticVariance(y, x),
                               Squared(mover_px_per_disparity * d));
  }

  /// The most that a pixel's motion can be borne out by stereo. Were it static and its disparity
  /// another one, that might explain the flow, too: what speaks for motion is what that leaves
  /// unexplained, and how much worse the right image fits there. Along a corrugated wall or a row
  /// of equal bars it fits as well.
  float LimitByStereo(int y, int x, float d, float log_odds) const {
    const cv::Vec2f& e = expected.per_disparity(y, x);
    const Eigen::Vector2f along(e[0], e[1]), r = Residual(y, x);
    const Eigen::Matrix2f G = Information(y, x);
    const Eigen::Matrix2f S =
        (Eigen::Matrix2f::Identity() + StaticVariance(y, x) * G).inverse() * G;
    const float held = along.dot(S * along);
    if (held < 1e-6F) return log_odds;
    const float step = along.dot(S * r) / held;
    const float unexplained = std::max(FlowLogOdds(y, x, d, r - step * along), 0.0F);
    const float asked = std::min(log_odds, most) - unexplained;
    if (asked <= 0) return log_odds;
    const float here = StereoMisfit(y, x, cvRound(d), std::numeric_limits<float>::max());
    const float enough = here + asked / GainPerMisfit(here);
    const float there = BestOther(y, x, d, {d + step, 2 / std::sqrt(held)}, {here, enough});
    if (there >= enough) return log_odds;
    return unexplained + std::max(there - here, 0.0F) * GainPerMisfit(here);
  }

  /// Log-odds of what fits so well against what fits otherwise, for each unit of their difference.
  float GainPerMisfit(float misfit) const {
    return static_cast<float>(options.independent_pixels) / 2 /
           (1 + static_cast<float>(options.misfit_weight) * misfit);
  }

  struct Range {
    float centre, reach;
  };
  struct Misfits {
    float ill_enough, well_enough;  // below the first and above the second nothing matters
  };

  /// The best fit of all disparities in a range that are not that of the pixel.
  float BestOther(int y, int x, float d, Range others, Misfits limits) const {
    constexpr float kMostReach = 16;
    const float reach = std::min(others.reach, kMostReach);
    const int from = std::max(static_cast<int>(std::floor(others.centre - reach)), 0);
    const int to = std::min(static_cast<int>(std::ceil(others.centre + reach)), x);
    float best = limits.well_enough;
    for (int k = from; k <= to && best > limits.ill_enough; ++k) {
      const float apart = std::abs(static_cast<float>(k) - d);
      if (apart < static_cast<float>(options.other_disparity)) continue;
      best = std::min(best, StereoMisfit(y, x, k, best));
    }
    return best;
  }

  /// Mean squared difference, in units of its variance, of the window around a pixel and that of
  /// the right image a disparity away, as far as the half pixel around cannot explain it
  /// (Birchfield and Tomasi, 1998); endless outside. Only the part above `most` is not exact.
  float StereoMisfit(int y, int x, int d, float most) const {
    constexpr int kReach = 3;
    const cv::Mat1b& left = frames.now.image;
    const int top = std::max(y - kReach, 0), bottom = std::min(y + kReach, left.rows - 1);
    const int reach = std::min({kReach, x - d, left.cols - 1 - x});
    if (reach < 1) return std::numeric_limits<float>::max();
    const float unit = static_cast<float>((bottom - top + 1) * (2 * reach + 1)) * variance(y, x);
    int squares = 0;
    for (int v = top; v <= bottom && static_cast<float>(squares) < most * unit; ++v) {
      const unsigned char* seen = left[v] + x - reach;
      const unsigned char* low = frames.now.right_low[v] + x - d - reach;
      const unsigned char* high = frames.now.right_high[v] + x - d - reach;
      for (int u = 0; u <= 2 * reach; ++u) {
        const int off = std::max({0, seen[u] - high[u], low[u] - seen[u]});
        squares += off * off;
      }
    }
    return static_cast<float>(squares) / unit;
  }

  float At(int y, int x) const {
    const float d = frames.now.disparity(y, x), expected_d = expected.disparity(y, x);
    const cv::Point to(cvRound(expected.place(y, x)[0]), cvRound(expected.place(y, x)[1]));
    const cv::Rect inside(1, 1, frames.now.image.cols - 2, frames.now.image.rows - 2);
    if (d <= 0 || expected_d <= 0 || !inside.contains(to)) return 0;

    const float change = disparity_change * d * d;
    const bool hidden =
        frames.then.disparity(to) > expected_d + std::max(0.75F, 0.06F * expected_d);
    const float log_odds = FlowLogOdds(y, x, d, Residual(y, x));
    if (log_odds <= 0) return hidden ? 0 : log_odds;
    if (IsBesideNearer(y, x, d)) return 0;

    const float seen = DisparityAround(frames.then.disparity, frames.flow(y, x), d, expected_d);
    const float off = std::min(std::abs(seen - d), std::abs(seen - expected_d));
    const auto speeds = static_cast<float>(options.same_surface_speeds);
    if (seen <= 0 || off >= SameSurface(d) + speeds * change) return 0;
    const float moved = misfit_moved(y, x);
    if (hidden && (std::abs(seen - d) >= SameSurface(d) + change ||
                   moved >= static_cast<float>(options.hidden_misfit))) {
      return 0;
    }
    const float gain = (misfit_static(y, x) - moved) * GainPerMisfit(moved);
    const float borne_out = std::clamp(gain, 0.0F, log_odds);
    return borne_out > 0 ? LimitByStereo(y, x, d, borne_out) : 0;
  }
};

/// The deviation of the flow of pixels that are well held and that disparity tells little apart, of
/// those where it fits and that belong to nothing known to move; nothing where there are few.
std::optional<double> MeasureFlowNoise(const Evidence& evidence) {
  constexpr int kEvery = 3, kLeastSamples = 200;
  constexpr float kLeastTexture = 60, kMostOther = 0.0064F, kMedianOfTwo = 1.3863F;
  std::vector<float> squares;
  const cv::Mat1f& disparity = evidence.frames.now.disparity;
  for (int y = 1; y < disparity.rows; y += kEvery) {
    for (int x = 1; x < disparity.cols; x += kEvery) {
      if (disparity(y, x) <= 0 || evidence.expected.disparity(y, x) <= 0) continue;
      const float xx = evidence.texture.xx(y, x), yy = evidence.texture.yy(y, x),
                  xy = evidence.texture.xy(y, x);
      if (xx * yy - xy * xy < kLeastTexture * (xx + yy)) continue;
      if (evidence.OtherVariance(y, x) > kMostOther) continue;
      if (evidence.misfit_moved(y, x) > evidence.misfit_static(y, x)) continue;
      if (!evidence.frames.regions.empty() && evidence.frames.regions(y, x) > 0) continue;
      const cv::Vec2f r = evidence.frames.flow(y, x) - evidence.expected.place(y, x);
      squares.push_back(r.dot(r));
    }
  }
  if (std::ssize(squares) < kLeastSamples) return std::nullopt;
  return std::sqrt(Median(std::move(squares)) / kMedianOfTwo);
}

}  // namespace

float DisplacementLogOdds(const Eigen::Matrix2f& G, const Eigen::Vector2f& r, float static_variance,
                          float mover_variance) {
  // The inverse of G^-1 + v I is (I + v G)^-1 G, which G = 0 does not trouble.
  const auto fit = [&](float v, float& determinant) {
    const Eigen::Matrix2f M = Eigen::Matrix2f::Identity() + v * G;
    determinant = M.determinant();
    const Eigen::Vector2f Gr = G * r;
    return (r.x() * (M(1, 1) * Gr.x() - M(0, 1) * Gr.y()) +
            r.y() * (M(0, 0) * Gr.y() - M(1, 0) * Gr.x())) /
           determinant;
  };
  float det_static = 1, det_moving = 1;
  const float chi2_static = fit(static_variance, det_static);
  const float chi2_moving = fit(static_variance + mover_variance, det_moving);
  return (chi2_static - chi2_moving - std::log(det_moving / det_static)) / 2;
}

MotionEvidence CompareMotion(const Comparison& comparison, const Texture& texture,
                             const StereoCamera& half, const SurfaceOptions& surface,
                             const EvidenceOptions& options) {
  const DenseFrame &now = comparison.now, &then = comparison.then;
  const double way_m = options.mover_mps * comparison.seconds;
  const double focal_baseline = half.fx * half.baseline_m;
  Evidence evidence{comparison,
                    texture,
                    options,
                    WhereStatic(now.filled, comparison.T_then_now, half),
                    DifferenceVariance(now.image, surface),
                    {},
                    {},
                    {},
                    static_cast<float>(*std::max_element(options.most.begin(), options.most.end())),
                    static_cast<float>(way_m / half.baseline_m),
                    static_cast<float>(way_m / focal_baseline)};
  const cv::Mat1f& variance = evidence.variance;
  tbb::parallel_for(0, 3, [&](int k) {
    if (k == 0) {
      evidence.misfit_static =
          Misfit(now.image, SampleAt(then.image, evidence.expected.place), variance);
    } else if (k == 1) {
      evidence.misfit_moved = Misfit(now.image, SampleAt(then.image, comparison.flow), variance);
    } else {
      cv::dilate(now.filled, evidence.nearest,
                 cv::Mat::ones(options.edge_window_px, options.edge_window_px, CV_8U));
    }
  });
  MotionEvidence found{cv::Mat1f(now.image.size()), MeasureFlowNoise(evidence)};
  tbb::parallel_for(0, now.image.rows, [&](int y) {
    for (int x = 0; x < now.image.cols; ++x) found.log_odds(y, x) = evidence.At(y, x);
  });
  return found;
}

cv::Mat1f CombineGaps(const std::vector<cv::Mat1f>& gaps, const EvidenceOptions& options) {
  CV_Assert(!gaps.empty() && gaps.size() <= options.least.size());
  cv::Mat1f combined(gaps[0].size());
  for (int i = 0; i < static_cast<int>(combined.total()); ++i) {
    float most = 0, against = 0, sum = 0;
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const float one = std::clamp(gaps[k](i), static_cast<float>(options.least[k]),
                                   static_cast<float>(options.most[k]));
      most = std::max(most, one);
      against += std::min(one, 0.0F);
      sum += one;
    }
    combined(i) = most > static_cast<float>(options.motion_found)
                      ? most + static_cast<float>(options.others_weight) * against
                      : sum;
  }
  return combined;
}

}  // namespace aisle::slam::dynamic
