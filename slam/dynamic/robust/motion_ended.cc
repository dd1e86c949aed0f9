#include "slam/dynamic/robust/motion_ended.h"

#include "slam/common/parallel.h"
#include "slam/dynamic/robust/information.h"

namespace aisle::slam::dynamic {

EndedMotion TakeOffEndedMotion(const LatestStep& step, int steps, const Texture& texture,
                               const cv::Mat2f& per_step, const cv::Mat1f& log_odds,
                               const EvidenceOptions& options) {
  EndedMotion result{cv::Mat1f(log_odds.size()), cv::Mat1f(log_odds.size())};
  const auto share = static_cast<float>(options.least_speed_share),
             noise = static_cast<float>(options.mover_noise * options.mover_noise),
             limit = static_cast<float>(options.most), way = static_cast<float>(steps);
  ParallelFor(0, log_odds.rows, [&](int y) {
    const float *xx = texture.xx[y], *xy = texture.xy[y], *yy = texture.yy[y];
    const float *residual = step.residual.ptr<float>(y), *velocity = per_step.ptr<float>(y),
                *variance = step.variance[y];
    const float* odds = log_odds[y];
    float *left = result.log_odds[y], *off = result.taken[y];
#pragma GCC ivdep
    for (int x = 0; x < log_odds.cols; ++x) {
      const Information G{xx[x], xy[x], yy[x]};
      const auto [added, determinant] = Weaken(G, Determinant(G), noise * variance[x]);
      const float u = way * velocity[2 * x], v = way * velocity[2 * x + 1];
      const float su = ((G.xx + added) * u + G.xy * v) / determinant,
                  sv = (G.xy * u + (G.yy + added) * v) / determinant;
      const float along = su * residual[2 * x] + sv * residual[2 * x + 1];
      const float against = share * (share * (su * u + sv * v) / 2 - along);
      const float taken = std::min(std::max(against, 0.0F), limit);
      const float less = std::max(std::min(odds[x], limit) - taken, 0.0F);
      off[x] = odds[x] > 0 ? taken : 0.0F;
      left[x] = odds[x] > 0 ? less : odds[x];
    }
  });
  return result;
}

}  // namespace aisle::slam::dynamic
