#include "slam/dynamic/robust/motion_evidence.h"

#include <opencv2/imgproc.hpp>

#include "slam/common/median.h"
#include "slam/common/parallel.h"
#include "slam/dynamic/robust/earlier_disparity.h"
#include "slam/dynamic/robust/fast_log.h"
#include "slam/dynamic/robust/information.h"
#include "slam/dynamic/robust/monocular.h"
#include "slam/dynamic/robust/residual_flow.h"
#include "slam/dynamic/robust/static_alias.h"
#include "slam/dynamic/robust/unseen_columns.h"

namespace aisle::slam::dynamic {
namespace {

float Squared(double a) { return static_cast<float>(a * a); }

/// See DisplacementLogOdds; of r = (rx, ry). Without branches, so that rows of it are vectorised.
inline float LogOddsOf(const Information& G, float rx, float ry, float static_variance,
                       float mover_variance) {
  const float det = Determinant(G);
  const Weakened still = Weaken(G, det, static_variance),
                 moving = Weaken(G, det, static_variance + mover_variance);
  const float held = rx * (G.xx * rx + G.xy * ry) + ry * (G.xy * rx + G.yy * ry),  // r' G r
      squared = rx * rx + ry * ry;
  const float chi2_static = (held + still.added * squared) / still.determinant;
  const float chi2_moving = (held + moving.added * squared) / moving.determinant;
  return (chi2_static - chi2_moving - FastLog(moving.determinant / still.determinant)) / 2;
}

/// What the earlier frame saw around a place: of the disparities there, the one nearest to those
/// that would make sense; negative if none is known.
float DisparityAround(const cv::Mat1f& disparity, const cv::Vec2f& place,
                      const EarlierDisparity& sensible) {
  const int cx = cvRound(place[0]), cy = cvRound(place[1]);
  float best = -1, least = std::numeric_limits<float>::infinity();
  for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, disparity.rows - 1); ++y) {
    for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, disparity.cols - 1); ++x) {
      const float d = disparity(y, x);
      const float distance = sensible.DistanceTo(d);
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
  const Surroundings& around;
  StaticField expected;
  cv::Mat1f disparity;  // see ExplainMonocular
  cv::Mat1f difference_static, difference_moved;

  float most;                    // log-odds that matter
  float mover_px_per_disparity;  // image speed of a mover over the gap, for each pixel of disparity
  float disparity_change;        // of a mover over the gap, for each squared pixel of disparity
  float depth_per_disparity;     // see AliasViews

  /// Whether something nearer is so close that the flow here is its flow.
  bool IsBesideNearer(int y, int x, float d) const {
    return frames.tolerance.IsNearer(d, around.nearest(y, x));
  }

  /// Whether its disparity is not measured but the one that explains it best.
  bool IsMonocular(int y, int x) const { return frames.now.disparity(y, x) <= 0; }

  /// Whether nothing was known at an earlier place as its surface lay beyond the right image then.
  bool WasBlind(const cv::Vec2f& place, float d, float seen) const {
    return seen <= 0 && place[0] - d < static_cast<float>(kEdgeReach);
  }

  /// Whether earlier frames have said enough; they, too, were asked for other explanations.
  bool WasSure(int y, int x) const {
    return !frames.memory.empty() && frames.memory(y, x) > static_cast<float>(frames.sure);
  }

  /// What of a pixel's log-odds something static with another disparity does not explain.
  float Unexplained(int y, int x, float log_odds) const {
    const SeenMotion seen{{x, y},
                          frames.now.disparity(y, x),
                          frames.flow(y, x),
                          expected.place(y, x),
                          expected.disparity(y, x),
                          expected.per_disparity(y, x)};
    const AliasViews views{frames.now,       frames.then.image,  around.noise.fine,
                           frames.tolerance, frames.disparities, depth_per_disparity};
    return LimitByAlias(views, seen, std::min(log_odds, most), options);
  }

  /// What the flow of each pixel of a row says, whether anything is known of it or not.
  void FlowLogOddsOfRow(int y, float* log_odds, LatestStep& step) const {
    const float *place = expected.place.ptr<float>(y), *per = expected.per_disparity.ptr<float>(y),
                *flow = frames.flow.ptr<float>(y), *now = disparity[y];
    const float *xx = texture.xx[y], *xy = texture.xy[y], *yy = texture.yy[y];
    float *residual = step.residual.ptr<float>(y), *variances = step.variance[y];
    const float of_flow = Squared(frames.flow_noise),
                of_disparity = Squared(frames.tolerance.noise()),
                of_way = Squared(options.noise_per_displacement);
#pragma GCC ivdep
    for (int x = 0; x < frames.flow.cols; ++x) {
      const float u = place[2 * x], v = place[2 * x + 1];
      const float du = u - static_cast<float>(x), dv = v - static_cast<float>(y);
      const float pu = per[2 * x], pv = per[2 * x + 1];
      const float variance =
          of_flow + of_disparity * (pu * pu + pv * pv) + of_way * (du * du + dv * dv);
      const float mover = mover_px_per_disparity * now[x];
      const float ru = flow[2 * x] - u, rv = flow[2 * x + 1] - v;
      log_odds[x] = LogOddsOf({xx[x], xy[x], yy[x]}, ru, rv, variance, mover * mover);
      residual[2 * x] = ru;
      residual[2 * x + 1] = rv;
      variances[x] = variance;
    }
  }

  /// What of log-odds the earlier image confirms: it must agree better where the flow leads.
  float Confirmed(int y, int x, float log_odds) const {
    const float moved = difference_moved(y, x);
    const float gain = (difference_static(y, x) - moved) * GainPerDifference(moved, options);
    return std::clamp(gain, 0.0F, log_odds);
  }

  /// What a pixel says whose flow says `log_odds`.
  float At(int y, int x, float log_odds) const {
    const float d = disparity(y, x), expected_d = expected.disparity(y, x);
    if (d <= 0 || expected_d <= 0) return 0;
    const cv::Point to(cvRound(expected.place(y, x)[0]), cvRound(expected.place(y, x)[1]));
    const cv::Rect inside(1, 1, frames.now.image.cols - 2, frames.now.image.rows - 2);
    if (!inside.contains(to)) return 0;

    const float change = disparity_change * d * d;
    const bool hidden = frames.tolerance.IsNearer(expected_d, frames.then.disparity(to));
    if (log_odds <= 0) return hidden ? 0 : log_odds;
    if (IsMonocular(y, x)) return hidden ? 0 : Confirmed(y, x, log_odds);
    if (IsBesideNearer(y, x, d)) return 0;

    const EarlierDisparity sensible(d, expected_d);
    const float seen = DisparityAround(frames.then.disparity, frames.flow(y, x), sensible);
    const float off = sensible.DistanceTo(seen), same = frames.tolerance.At(d);
    const bool other = seen <= 0 || off >= same + frames.tolerance.sigmas() * change;
    if (other && !WasBlind(frames.flow(y, x), d, seen)) return 0;
    const float moved = difference_moved(y, x);
    if (hidden && (std::abs(seen - d) >= same + change ||
                   moved >= static_cast<float>(options.hidden_difference))) {
      return 0;
    }
    return Confirmed(y, x, log_odds);
  }
};

/// The deviation of the flow of pixels that are well held and that disparity tells little apart, of
/// those where it fits and that belong to nothing known to move; nothing where there are few.
/// `step`: what the comparison has left unexplained.
std::optional<double> MeasureFlowNoise(const Evidence& evidence, const LatestStep& step) {
  constexpr int kEvery = 3, kLeastSamples = 200;
  constexpr float kLeastTexture = 60, kMedianOfTwo = 1.3863F;
  constexpr float kMostOther = 0.0064F;  // of disparity and way, beside the flow's own variance
  const float most_variance = Squared(evidence.frames.flow_noise) + kMostOther;
  std::vector<float> squares;
  const cv::Mat1f& disparity = evidence.frames.now.disparity;
  for (int y = 1; y < disparity.rows; y += kEvery) {
    for (int x = 1; x < disparity.cols; x += kEvery) {
      if (disparity(y, x) <= 0 || evidence.expected.disparity(y, x) <= 0) continue;
      const float xx = evidence.texture.xx(y, x), yy = evidence.texture.yy(y, x),
                  xy = evidence.texture.xy(y, x);
      if (xx * yy - xy * xy < kLeastTexture * (xx + yy)) continue;
      if (step.variance(y, x) > most_variance) continue;
      if (evidence.difference_moved(y, x) > evidence.difference_static(y, x)) continue;
      if (!evidence.frames.regions.empty() && evidence.frames.regions(y, x) > 0) continue;
      const cv::Vec2f& r = step.residual(y, x);
      squares.push_back(r.dot(r));
    }
  }
  if (std::ssize(squares) < kLeastSamples) return std::nullopt;
  return std::sqrt(Median(std::move(squares)) / kMedianOfTwo);
}

/// Asks for static explanations once for each block of pixels, where motion is clearest.
void LimitBlocks(const Evidence& evidence, cv::Mat1f& log_odds) {
  constexpr int kSide = 2;
  ParallelFor(0, (log_odds.rows + kSide - 1) / kSide, [&](int block) {
    const int bottom = std::min((block + 1) * kSide, log_odds.rows);
    for (int left = 0; left < log_odds.cols; left += kSide) {
      const int right = std::min(left + kSide, log_odds.cols);
      float clearest = 0;
      cv::Point at;
      for (int y = block * kSide; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
          if (log_odds(y, x) <= clearest) continue;
          clearest = log_odds(y, x);
          at = {x, y};
        }
      }
      if (clearest <= 0 || evidence.WasSure(at.y, at.x) || evidence.IsMonocular(at.y, at.x))
        continue;
      const float limit = evidence.Unexplained(at.y, at.x, clearest);
      for (int y = block * kSide; y < bottom; ++y) {
        for (int x = left; x < right; ++x) log_odds(y, x) = std::min(log_odds(y, x), limit);
      }
    }
  });
}

}  // namespace

float DisplacementLogOdds(const Eigen::Matrix2f& G, const Eigen::Vector2f& r, float static_variance,
                          float mover_variance) {
  return LogOddsOf({G(0, 0), G(0, 1), G(1, 1)}, r.x(), r.y(), static_variance, mover_variance);
}

Surroundings LookAround(const DenseFrame& frame, const SurfaceOptions& surface,
                        const EvidenceOptions& options) {
  Surroundings around{ExpectDifferences(frame.image, surface), {}};
  cv::dilate(frame.filled, around.nearest,
             cv::Mat::ones(options.edge_window_px, options.edge_window_px, CV_8U));
  return around;
}

MotionEvidence CompareMotion(const Comparison& comparison, const Texture& texture,
                             const Surroundings& around, const StereoCamera& half,
                             const EvidenceOptions& options) {
  const DenseFrame &now = comparison.now, &then = comparison.then;
  const double way_m = std::min(options.mover_mps * comparison.seconds, options.mover_m);
  const double focal_baseline = half.fx * half.baseline_m;
  Evidence evidence{comparison,
                    texture,
                    options,
                    around,
                    WhereStatic(now.filled, comparison.T_then_now, half),
                    {},
                    {},
                    {},
                    static_cast<float>(options.most),
                    static_cast<float>(way_m / half.baseline_m),
                    static_cast<float>(way_m / focal_baseline),
                    static_cast<float>(comparison.T_then_now.translation().z() / focal_baseline)};
  evidence.disparity = comparison.monocular
                           ? ExplainMonocular(now, comparison.flow, texture, &evidence.expected)
                           : now.disparity;
  ParallelInvoke(
      [&] {
        const cv::Mat1b still = SampleAt(then.image, evidence.expected.place);
        evidence.difference_static = SquaredDifference(now.image, still, around.noise);
      },
      [&] {
        const cv::Mat1b moved = SampleAt(then.image, comparison.flow);
        evidence.difference_moved = SquaredDifference(now.image, moved, around.noise);
      });
  const cv::Size size = now.image.size();
  MotionEvidence found{cv::Mat1f(size), {cv::Mat2f(size), cv::Mat1f(size)}, {}};
  ParallelFor(0, now.image.rows, [&](int y) {
    float* log_odds = found.log_odds[y];
    evidence.FlowLogOddsOfRow(y, log_odds, found.step);
    for (int x = 0; x < now.image.cols; ++x) log_odds[x] = evidence.At(y, x, log_odds[x]);
  });
  found.flow_noise = MeasureFlowNoise(evidence, found.step);
  LimitBlocks(evidence, found.log_odds);
  return found;
}

cv::Mat1f CombineGaps(const std::vector<cv::Mat1f>& gaps, double moving,
                      const EvidenceOptions& options) {
  CV_Assert(!gaps.empty());
  const auto others = static_cast<float>(options.others_weight),
             motion_found = static_cast<float>(moving);
  const auto low = static_cast<float>(options.least), high = static_cast<float>(options.most);
  cv::Mat1f combined(gaps[0].size());
  ParallelFor(0, combined.rows, [&](int y) {
    float* sum = combined[y];
    const auto columns = static_cast<std::size_t>(combined.cols);
    std::vector<float> most(columns, 0.0F), against(columns, 0.0F);
    std::fill(sum, sum + columns, 0.0F);
    for (const cv::Mat1f& said : gaps) {
      if (said.empty()) continue;
      const float* gap = said[y];
#pragma GCC ivdep
      for (std::size_t x = 0; x < columns; ++x) {
        const float one = std::min(std::max(gap[x], low), high);
        most[x] = std::max(most[x], one);
        against[x] += std::min(one, 0.0F);
        sum[x] += one;
      }
    }
    for (std::size_t x = 0; x < columns; ++x) {
      if (most[x] > motion_found) sum[x] = most[x] + others * against[x];
    }
  });
  return combined;
}

}  // namespace aisle::slam::dynamic
