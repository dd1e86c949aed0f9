#include "slam/dynamic/robust/ego_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <map>
#include <numeric>

#include "slam/common/parallel.h"
#include "slam/dynamic/common/counter_random.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kLeastMatches = 6;
constexpr int kLeastForNoise = 20;
/// 99 % of chi-square: with three degrees of freedom the bound of an inlier, with six how much
/// worse standing still may fit.
constexpr double kInlierChi2 = 11.34, kStandingChi2 = 16.8;
/// What one cubic metre of space may say of that: it takes three to refute it.
constexpr double kMostOfACube = kStandingChi2 / 3;
/// Samples carry the noise of three points: their support is judged with a wider gate.
constexpr double kSampleGate = 4 * kInlierChi2;
/// 99.99 % with six degrees of freedom: beyond it a motion contradicts its prior.
constexpr double kImpossibleChi2 = 27.9;
/// Three static points are among so many samples with 99.97 % if half of the matches are.
constexpr int kHypotheses = 60;
/// Refined before they are compared where no motion has most of the trust.
constexpr std::size_t kContenders = 10;
/// Of re-weighting, each with its Gauss-Newton steps; they end before where nothing changes.
constexpr int kRounds = 3, kIterations = 4;

/// Measurement noise enters twice, before and now; between consecutive frames the map from one to
/// the other is close to identity in (u, v, disparity).
Vector3d InverseDeviation(const MeasurementNoise& noise) {
  return (std::sqrt(2.0) * noise).cwiseInverse();
}

/// A match whose point in space is known: it is asked for under many motions.
struct PlacedMatch {
  Vector3d before;  // metres
  Vector3d now;     // as measured
  double weight;
};

std::vector<PlacedMatch> Placed(const std::vector<StereoMatch>& matches,
                                const StereoCamera& camera) {
  std::vector<PlacedMatch> placed;
  placed.reserve(matches.size());
  for (const StereoMatch& match : matches) {
    placed.push_back({Backproject(camera, match.before), match.now, match.weight});
  }
  return placed;
}

/// Error in units of noise, or nothing behind the camera.
std::optional<Vector3d> WeightedError(const StereoCamera& camera, const Isometry3d& T,
                                      const PlacedMatch& match, const Vector3d& inverse_deviation) {
  const Vector3d point = T * match.before;
  if (point.z() < kNearestVisible_m) return std::nullopt;
  return inverse_deviation.cwiseProduct(Project(camera, point) - match.now);
}

double Chi2(const StereoCamera& camera, const Isometry3d& T, const PlacedMatch& match,
            const Vector3d& inverse_deviation) {
  const auto error = WeightedError(camera, T, match, inverse_deviation);
  return error ? error->squaredNorm() : std::numeric_limits<double>::infinity();
}

/// Horn's closed form on three points; nothing if they are close to a line.
std::optional<Isometry3d> AlignTriangles(const std::array<Vector3d, 3>& from,
                                         const std::array<Vector3d, 3>& to) {
  const Vector3d from_mean = (from[0] + from[1] + from[2]) / 3,
                 to_mean = (to[0] + to[1] + to[2]) / 3;
  const double area = (from[1] - from[0]).cross(from[2] - from[0]).norm();
  if (area < 1e-3) return std::nullopt;
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    correlation += (from[k] - from_mean) * (to[k] - to_mean).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d signs(1, 1, 1);
  signs.z() = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;
  Isometry3d T = Isometry3d::Identity();
  T.linear() = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  T.translation() = to_mean - T.linear() * from_mean;
  return T;
}

/// Trust behind a motion: full for a match on the spot, none beyond the gate.
double Support(const std::vector<PlacedMatch>& matches, const StereoCamera& camera,
               const Isometry3d& T, const Vector3d& inverse_deviation, double gate) {
  double support = 0;
  for (const PlacedMatch& match : matches) {
    const auto error = WeightedError(camera, T, match, inverse_deviation);
    if (error) support += match.weight * std::max(0.0, 1 - error->squaredNorm() / gate);
  }
  return support;
}

/// A prior as one more observation.
struct Expectation {
  Isometry3d T_now_before;
  Matrix6d information;

  double Chi2Of(const Isometry3d& T) const {
    const Vector6d deviation = Difference(T_now_before, T);
    return deviation.dot(information * deviation);
  }
  bool Allows(const Isometry3d& T) const { return Chi2Of(T) < kImpossibleChi2; }
};
using MaybeExpected = std::optional<Expectation>;

MaybeExpected Expected(const std::optional<MotionPrior>& prior) {
  if (!prior) return std::nullopt;
  return Expectation{prior->T_now_before, prior->covariance.inverse()};
}

/// The same where the rig is jolted.
MaybeExpected ExpectedInAJolt(const std::optional<MotionPrior>& prior) {
  if (!prior || prior->jolt.isZero()) return std::nullopt;
  return Expectation{prior->T_now_before, (prior->covariance + prior->jolt).inverse()};
}

/// Between 0 and 1: how well the vehicle could have done this motion.
double Plausibility(const Isometry3d& T, const MaybeExpected& expected) {
  if (!expected) return 1;
  if (!expected->Allows(T)) return 0;
  return 1 / (1 + expected->Chi2Of(T) / 9);  // three deviations halve it
}

/// A match drawn with a probability in proportion to its weight.
std::size_t DrawByWeight(const std::vector<double>& cumulative, CounterRandom& random) {
  const double at = cumulative.back() * (static_cast<double>(random.Below(1 << 30)) / (1 << 30));
  const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), at);
  return std::min(static_cast<std::size_t>(found - cumulative.begin()), cumulative.size() - 1);
}

std::vector<Isometry3d> SampleMotions(const std::vector<StereoMatch>& matches,
                                      const StereoCamera& camera, const EgoMotionOptions& options) {
  std::vector<double> cumulative;
  double sum = 0;
  for (const StereoMatch& match : matches) cumulative.push_back(sum += match.weight);
  std::vector<Isometry3d> motions;
  for (int k = 0; k < kHypotheses && sum > 0; ++k) {
    CounterRandom random(options.seed, static_cast<std::uint64_t>(k));
    std::array<Vector3d, 3> from, to;
    for (std::size_t n = 0; n < 3; ++n) {
      const StereoMatch& match = matches[DrawByWeight(cumulative, random)];
      from[n] = Backproject(camera, match.before);
      to[n] = Backproject(camera, match.now);
    }
    if (const auto T = AlignTriangles(from, to)) motions.push_back(*T);
  }
  return motions;
}

/// Of motions what a jolt may have done, the rest as expected: three points tell little more than
/// how the rig has tilted.
std::vector<Isometry3d> AsJolts(std::vector<Isometry3d> motions, const MotionPrior& prior) {
  const Vector6d may = prior.jolt.diagonal().unaryExpr([](double v) { return v > 0 ? 1.0 : 0.0; });
  for (Isometry3d& T : motions) {
    T = Retract(prior.T_now_before, may.cwiseProduct(Difference(prior.T_now_before, T)));
  }
  return motions;
}

struct NormalEquations {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double support = 0;  // weight within the gate
};

/// Geman-McClure weights with the gate as scale: far errors count for next to nothing.
NormalEquations Linearize(const std::vector<PlacedMatch>& matches, const StereoCamera& camera,
                          const Isometry3d& T, const Vector3d& inverse_deviation, double gate) {
  NormalEquations equations;
  for (const PlacedMatch& match : matches) {
    const Vector3d point = T * match.before;
    if (point.z() < kNearestVisible_m) continue;
    const Vector3d error = inverse_deviation.cwiseProduct(Project(camera, point) - match.now);
    const double chi2 = error.squaredNorm(), fall = gate / (gate + chi2);
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian.leftCols<3>() = inverse_deviation.asDiagonal() * ProjectionJacobian(camera, point);
    jacobian.rightCols<3>() = -jacobian.leftCols<3>() * Skew(point);
    const double weight = match.weight * fall * fall;
    equations.hessian.noalias() += weight * jacobian.transpose() * jacobian;
    equations.gradient.noalias() += weight * jacobian.transpose() * error;
    equations.support += chi2 < gate ? match.weight : 0;
  }
  return equations;
}

std::vector<PlacedMatch> Followers(const std::vector<PlacedMatch>& matches,
                                   const StereoCamera& camera, const Isometry3d& T,
                                   const Vector3d& inverse_deviation, double gate) {
  std::vector<PlacedMatch> followers;
  std::copy_if(matches.begin(), matches.end(), std::back_inserter(followers),
               [&](const PlacedMatch& m) { return Chi2(camera, T, m, inverse_deviation) < gate; });
  return followers;
}

/// A cubic metre of space. The camera's axis runs through the middle of those ahead: whoever fills
/// the view is around it, and would be in four at their corner.
using Cube = std::array<int, 3>;
Cube CubeAround(const Vector3d& point_m) {
  const Vector3d at = (point_m + Vector3d(0.5, 0.5, 0)).cwiseMax(-1000).cwiseMin(1000);
  return {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
          static_cast<int>(std::floor(at.z()))};
}

/// The same matches, no cubic metre of the world with more weight than one: what fills space counts
/// for more than what fills the image, as a person close by does.
std::vector<StereoMatch> WeighedBySpace(std::vector<StereoMatch> matches,
                                        const StereoCamera& camera) {
  std::map<Cube, double> weight_in;
  std::vector<Cube> cubes;
  for (const StereoMatch& match : matches) {
    cubes.push_back(CubeAround(Backproject(camera, match.before)));
    weight_in[cubes.back()] += match.weight;
  }
  for (std::size_t i = 0; i < matches.size(); ++i) {
    matches[i].weight /= std::max(weight_in[cubes[i]], 1.0);
  }
  return matches;
}

/// By how much the matches that follow a motion fit it better than none, in chi-square. The others
/// have no say: movers would vote for whatever leaves them alone. Nor has any cubic metre more than
/// its share: somebody who sways close ahead is seen to move by far more than the noise, in
/// hundreds of matches.
double AgainstStanding(const std::vector<PlacedMatch>& matches, const StereoCamera& camera,
                       const Isometry3d& T_now_before, const Vector3d& inverse_deviation) {
  const auto robust = [](double chi2) {  // as Linearize weighs
    return std::isfinite(chi2) ? chi2 * kInlierChi2 / (kInlierChi2 + chi2) : kInlierChi2;
  };
  std::map<Cube, double> said;
  for (const PlacedMatch& match : matches) {
    const double moving = Chi2(camera, T_now_before, match, inverse_deviation);
    if (!(moving < kInlierChi2)) continue;
    const double still = Chi2(camera, Isometry3d::Identity(), match, inverse_deviation);
    said[CubeAround(match.before)] += match.weight * (robust(still) - robust(moving));
  }
  const auto bounded = [](double sum, const auto& cube) {
    return sum + std::clamp(cube.second, -kMostOfACube, kMostOfACube);
  };
  return std::accumulate(said.begin(), said.end(), 0.0, bounded);
}

std::vector<StereoMatch> Trusted(const std::vector<StereoMatch>& matches) {
  std::vector<StereoMatch> trusted;
  std::copy_if(matches.begin(), matches.end(), std::back_inserter(trusted),
               [](const StereoMatch& match) { return match.weight >= 0.5; });
  return trusted;
}

/// An absolute error and the weight of its match.
using WeightedValue = std::pair<double, double>;

/// The deviation of a normal error whose absolute value lies below three quarters of the weight.
double DeviationOf(std::vector<WeightedValue>& values) {
  std::sort(values.begin(), values.end());
  double whole = 0, below = 0;
  for (const auto& [value, weight] : values) whole += weight;
  for (const auto& [value, weight] : values) {
    below += weight;
    if (below >= 0.75 * whole) return value / 1.1503;
  }
  return values.back().first / 1.1503;
}

void AddExpected(const MaybeExpected& expected, const Isometry3d& T, NormalEquations& equations) {
  if (!expected) return;
  equations.hessian += expected->information;
  equations.gradient += expected->information * Difference(expected->T_now_before, T);
}

/// The expected motion itself, where the images show too little for another.
EgoMotion AsExpected(const MaybeExpected& expected) {
  EgoMotion motion;
  if (!expected) return motion;
  motion.found = true;
  motion.T_now_before = expected->T_now_before;
  motion.covariance = expected->information.inverse();
  return motion;
}

/// The motion that fits `matches` best, sought from one that is close. Whether it is none is asked
/// of `witnesses`, each with the weight that its own measurement has.
EgoMotion Refine(const std::vector<StereoMatch>& matches, const std::vector<StereoMatch>& witnesses,
                 const StereoCamera& camera, const Isometry3d& T_now_before,
                 const MeasurementNoise& noise, int rounds, const MaybeExpected& expected) {
  const Vector3d inverse_deviation = InverseDeviation(noise);
  EgoMotion motion;
  motion.T_now_before = T_now_before;
  if (std::ssize(matches) < kLeastMatches) return AsExpected(expected);
  const std::vector<PlacedMatch> placed = Placed(matches, camera);
  NormalEquations equations;
  for (int round = rounds - 1; round >= 0; --round) {
    const double gate = kInlierChi2 * std::pow(3.0, round);  // from wide to narrow
    for (int k = 0; k < kIterations; ++k) {
      equations = Linearize(placed, camera, motion.T_now_before, inverse_deviation, gate);
      AddExpected(expected, motion.T_now_before, equations);
      const Matrix6d damped =
          equations.hessian + 1e-9 * equations.hessian.trace() * Matrix6d::Identity();
      const Vector6d step = damped.ldlt().solve(-equations.gradient);
      if (!step.allFinite()) return motion;
      motion.T_now_before = Retract(motion.T_now_before, step);
      if (step.norm() < 1e-7) break;
    }
  }
  equations = Linearize(placed, camera, motion.T_now_before, inverse_deviation, kInlierChi2);
  AddExpected(expected, motion.T_now_before, equations);
  double against =
      AgainstStanding(Placed(witnesses, camera), camera, motion.T_now_before, inverse_deviation);
  if (expected) {
    against += expected->Chi2Of(Isometry3d::Identity()) - expected->Chi2Of(motion.T_now_before);
  }
  motion.standing = against < kStandingChi2;
  if (motion.standing) motion.T_now_before = Isometry3d::Identity();
  motion.covariance = equations.hessian.ldlt().solve(Matrix6d::Identity());
  motion.support = equations.support;
  const bool held = equations.support >= kLeastMatches / 2 || expected;
  motion.found = motion.covariance.allFinite() && held;
  return motion;
}

/// A measured motion made better by the matches that agree with it: whoever does not has no vote,
/// however many they are.
EgoMotion RefineMeasured(const std::vector<StereoMatch>& matches, const StereoCamera& camera,
                         const Expectation& measured, const MeasurementNoise& noise) {
  const Vector3d inverse_deviation = InverseDeviation(noise);
  const std::vector<PlacedMatch> placed = Placed(matches, camera);
  std::vector<StereoMatch> agreeing;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double chi2 = Chi2(camera, measured.T_now_before, placed[i], inverse_deviation);
    if (chi2 < kInlierChi2) agreeing.push_back(matches[i]);
  }
  const auto spread = WeighedBySpace(agreeing, camera);
  return Refine(spread, spread, camera, measured.T_now_before, noise, 1, measured);
}

/// Whether most of the trust lies in matches that follow a motion.
bool IsOfMost(const std::vector<StereoMatch>& matches, const StereoCamera& camera,
              const Isometry3d& T_now_before, const MeasurementNoise& noise) {
  const auto trust = [](double sum, const PlacedMatch& match) { return sum + match.weight; };
  const std::vector<PlacedMatch> placed = Placed(matches, camera);
  const auto followers =
      Followers(placed, camera, T_now_before, InverseDeviation(noise), kSampleGate);
  return 2 * std::accumulate(followers.begin(), followers.end(), 0.0, trust) >
         std::accumulate(placed.begin(), placed.end(), 0.0, trust);
}

struct Candidate {
  Isometry3d T_now_before;
  double trust = 0;
};

bool LessTrusted(const Candidate& a, const Candidate& b) { return a.trust < b.trust; }

/// Of the motions, if there are any, the one with most trust behind it, refined; what is expected
/// where none of them is possible. `spread` are the matches weighed by space. Where none has most
/// of the trust, the best are refined before they are compared (locally optimised RANSAC: Chum,
/// Matas and Kittler 2003): standing still is exact for whoever goes along with the rig, a sample
/// of the world has the noise of its three points.
EgoMotion MostTrusted(const std::vector<Isometry3d>& motions,
                      const std::vector<StereoMatch>& spread,
                      const std::vector<StereoMatch>& matches, const StereoCamera& camera,
                      const MeasurementNoise& noise, const MaybeExpected& expected) {
  const Vector3d inverse_deviation = InverseDeviation(noise);
  const std::vector<PlacedMatch> placed = Placed(spread, camera);
  const auto judged = [&](const Isometry3d& T) {
    const double support = Support(placed, camera, T, inverse_deviation, kSampleGate);
    return Candidate{T, support * Plausibility(T, expected)};
  };
  std::vector<Candidate> best(motions.size());
  ParallelFor(std::size_t{0}, best.size(), [&](std::size_t k) { best[k] = judged(motions[k]); });
  std::stable_sort(best.begin(), best.end(),
                   [](const Candidate& a, const Candidate& b) { return LessTrusted(b, a); });
  if (best.empty() || best.front().trust <= 0) return AsExpected(expected);
  const bool of_most = IsOfMost(spread, camera, best.front().T_now_before, noise);
  best.resize(of_most ? 1 : std::min(best.size(), kContenders));
  ParallelFor(std::size_t{0}, best.size(), [&](std::size_t k) {
    const EgoMotion close =
        Refine(spread, spread, camera, best[k].T_now_before, noise, kRounds, expected);
    best[k] = std::max(best[k], judged(close.T_now_before), LessTrusted);
  });
  const Candidate& most = *std::max_element(best.begin(), best.end(), LessTrusted);
  // Who is near and large must not pull: what is far tells how the rig has turned, and leaves it to
  // him how it has moved sideways.
  const EgoMotion found = Refine(spread, matches, camera, most.T_now_before, noise, 1, expected);
  const bool possible = !expected || expected->Allows(found.T_now_before);
  return possible ? found : AsExpected(expected);
}

}  // namespace

double MatchChi2(const StereoCamera& camera, const Isometry3d& T, const StereoMatch& match,
                 const MeasurementNoise& noise) {
  const PlacedMatch placed{Backproject(camera, match.before), match.now, match.weight};
  return Chi2(camera, T, placed, InverseDeviation(noise));
}

bool IsPossible(const Isometry3d& T_now_before, const MotionPrior& prior) {
  return Expected(prior)->Allows(T_now_before);
}

EgoMotion RefineEgoMotion(const std::vector<StereoMatch>& matches, const StereoCamera& camera,
                          const Isometry3d& T_now_before, const MeasurementNoise& noise) {
  return Refine(matches, matches, camera, T_now_before, noise, 1, std::nullopt);
}

EgoMotion EstimateEgoMotion(const std::vector<StereoMatch>& matches, const StereoCamera& camera,
                            const std::optional<MotionPrior>& prior, const MeasurementNoise& noise,
                            const EgoMotionOptions& options) {
  const MaybeExpected expected = Expected(prior);
  if (prior && prior->measured) return RefineMeasured(matches, camera, *expected, noise);
  if (std::ssize(matches) < kLeastMatches) return AsExpected(expected);
  std::vector<Isometry3d> candidates = {Isometry3d::Identity()};
  if (prior) candidates.push_back(prior->T_now_before);
  const auto spread = WeighedBySpace(matches, camera);
  const auto samples = SampleMotions(spread, camera, options);
  candidates.insert(candidates.end(), samples.begin(), samples.end());

  const EgoMotion smooth = MostTrusted(candidates, spread, matches, camera, noise, expected);
  const MaybeExpected jolted = ExpectedInAJolt(prior);
  if (!jolted || IsOfMost(spread, camera, smooth.T_now_before, noise)) return smooth;
  const EgoMotion jolt =
      MostTrusted(AsJolts(samples, *prior), spread, matches, camera, noise, jolted);
  return IsOfMost(spread, camera, jolt.T_now_before, noise) ? jolt : smooth;
}

std::optional<MeasurementNoise> MeasureNoise(const std::vector<StereoMatch>& matches,
                                             const StereoCamera& camera,
                                             const Isometry3d& T_now_before) {
  std::array<std::vector<WeightedValue>, 3> errors;
  for (const StereoMatch& match : WeighedBySpace(Trusted(matches), camera)) {
    const Vector3d point = T_now_before * Backproject(camera, match.before);
    if (point.z() < kNearestVisible_m) continue;
    const Vector3d error = (match.now - Project(camera, point)).cwiseAbs();
    for (std::size_t k = 0; k < 3; ++k) {
      errors[k].emplace_back(error[static_cast<int>(k)], match.weight);
    }
  }
  if (std::ssize(errors[0]) < kLeastForNoise) return std::nullopt;
  MeasurementNoise noise;
  for (std::size_t k = 0; k < 3; ++k) {
    noise[static_cast<int>(k)] = DeviationOf(errors[k]) / std::sqrt(2.0);
  }
  return noise;
}

}  // namespace aisle::slam::dynamic
