#include "harness/score/scorecard.h"

namespace aisle {
namespace {

constexpr double kSuspiciousDeg = 5;     ///< smaller constant turns are calibration, not convention
constexpr double kSteadyDeg = 2;         ///< spread of the turn that still counts as constant
constexpr double kPositionShare = 0.05;  ///< of the path's extent: positions agree

double ExtentM(const Trajectory& truth, const std::vector<PoseError>& errors) {
  Eigen::AlignedBox3d box;
  for (const PoseError& error : errors) {
    box.extend(truth[error.pair.truth].T_world_rig.translation());
  }
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// The turn from the estimate's rig axes to the truth's at one pair.
Eigen::Quaterniond Turn(const Trajectory& truth, const Trajectory& estimate, const PosePair& pair,
                        const Alignment& alignment) {
  const Eigen::Isometry3d aligned = Apply(alignment, estimate[pair.estimate].T_world_rig);
  return Eigen::Quaterniond(aligned.linear().transpose() * truth[pair.truth].T_world_rig.linear());
}

/// Root mean square distance of the positions once the whole estimate is turned about its middle,
/// in the truth's world, so that its first orientation agrees.
double ErrorWithTurn(const Trajectory& truth, const Trajectory& estimate,
                     const std::vector<PoseError>& errors, const Alignment& alignment) {
  const auto n = std::ssize(errors);
  Eigen::Matrix3Xd is(3, n), should_be(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PosePair& pair = errors[static_cast<std::size_t>(i)].pair;
    is.col(i) = Apply(alignment, estimate[pair.estimate].T_world_rig).translation();
    should_be.col(i) = truth[pair.truth].T_world_rig.translation();
  }
  const PosePair& first = errors.front().pair;
  const Eigen::Matrix3d turn =
      truth[first.truth].T_world_rig.linear() *
      Apply(alignment, estimate[first.estimate].T_world_rig).linear().transpose();
  is.colwise() -= is.rowwise().mean().eval();
  should_be.colwise() -= should_be.rowwise().mean().eval();
  return std::sqrt((turn * is - should_be).squaredNorm() / static_cast<double>(n));
}

}  // namespace

std::string FrameMismatch(const Trajectory& truth, const Trajectory& estimate,
                          const std::vector<PoseError>& errors, const Alignment& alignment) {
  if (errors.size() < 3 || !alignment.rotation_determined) return {};
  const double extent_m = ExtentM(truth, errors);
  if (Summarize(Translations(errors)).rmse > kPositionShare * extent_m) return {};
  // A drive that is nearly straight leaves the alignment's turn about it to chance: where another
  // alignment agrees with positions and orientations, nothing is wrong with the frames.
  const double turned_m = ErrorWithTurn(truth, estimate, errors, alignment);
  if (turned_m <= kPositionShare * extent_m) return {};
  const Eigen::Quaterniond first = Turn(truth, estimate, errors.front().pair, alignment);
  const Eigen::AngleAxisd turn(first);
  const double turn_deg = RotationAngleDeg(first.toRotationMatrix());
  if (turn_deg < kSuspiciousDeg) return {};
  for (const PoseError& error : errors) {
    const Eigen::Quaterniond here = Turn(truth, estimate, error.pair, alignment);
    if (RotationAngleDeg((first.conjugate() * here).toRotationMatrix()) > kSteadyDeg) return {};
  }
  return fmt::format(
      "positions agree but every orientation is off by the same {:.1f} degrees about ({:.2f}, "
      "{:.2f}, "
      "{:.2f}): truth and estimate name different frames (body and camera?). Rotational and "
      "relative errors mean nothing until they are brought to one frame.",
      turn_deg, turn.axis().x(), turn.axis().y(), turn.axis().z());
}

}  // namespace aisle
