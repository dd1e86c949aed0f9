#include "harness/score/conventions.h"

#include <array>

#include "harness/score/pose_error.h"
#include "harness/score/statistics.h"
#include "harness/score/step_difference.h"

namespace aisle {
namespace {

constexpr double kAgrees = 0.05;      ///< of the path's extent, root mean square
constexpr double kSuspiciousDeg = 5;  ///< a smaller turn is an error, no other order of columns

/// How the positions of some poses lie on the truth once they are aligned.
struct Fit {
  double rmse_m = 0;
  double scale = 1;
};

double ExtentM(const Trajectory& truth, const std::vector<PosePair>& pairs) {
  Eigen::AlignedBox3d box;
  for (const PosePair& pair : pairs) box.extend(truth[pair.truth].T_world_rig.translation());
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

Fit FitOf(const Trajectory& truth, const Trajectory& estimate, const std::vector<PosePair>& pairs,
          AlignmentMethod method) {
  const Alignment alignment = Align(truth, estimate, pairs, {.method = method, .first_n = 0});
  const auto errors = AbsoluteErrors(truth, estimate, pairs, alignment);
  return {Summarize(Translations(errors)).rmse, alignment.scale};
}

Trajectory Inverted(Trajectory trajectory) {
  for (StampedPose& pose : trajectory) pose.T_world_rig = pose.T_world_rig.inverse();
  return trajectory;
}

/// The place of qw among the four numbers of a quaternion.
enum class PlaceOfW { kFirst, kLast };

/// As if qw had been at that place of the file, and had been read at the other.
Trajectory Reread(Trajectory trajectory, PlaceOfW place) {
  for (StampedPose& pose : trajectory) {
    const Eigen::Quaterniond q(pose.T_world_rig.linear());
    const Eigen::Quaterniond other = place == PlaceOfW::kFirst
                                         ? Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w())
                                         : Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
    pose.T_world_rig.linear() = other.toRotationMatrix();
  }
  return trajectory;
}

std::string NoteOnInverse(const Trajectory& truth, const Trajectory& estimate,
                          const std::vector<PosePair>& pairs, double agrees_m, const Fit& as_read) {
  const std::pair<const char*, Trajectory> candidates[] = {
      {"", Inverted(estimate)},
      {" and qw read as the first of the four", Inverted(Reread(estimate, PlaceOfW::kFirst))},
      {" and qw read as the last of the four", Inverted(Reread(estimate, PlaceOfW::kLast))}};
  for (const auto& [besides, candidate] : candidates) {
    const Fit fit = FitOf(truth, candidate, pairs, AlignmentMethod::kSim3);
    if (fit.rmse_m > agrees_m) continue;
    return fmt::format(
        "with every pose inverted{} the path lies {:.3g} m from the truth, as read {:.3g} m (root "
        "mean square, scale left free): does the estimate say world to camera, as COLMAP does? "
        "Scores are of poses that say rig to world",
        besides, fit.rmse_m, as_read.rmse_m);
  }
  return {};
}

/// "millimetres" of two files whose lengths differ so; empty where it is no unit's ratio.
std::string UnitOf(double scale) {
  constexpr double kNear = 0.05;
  const double ratio = std::min(scale, 1 / scale);
  for (const auto& [unit, of_metre] :
       {std::pair("millimetres", 1e-3), std::pair("centimetres", 1e-2),
        std::pair("decimetres", 1e-1), std::pair("micrometres", 1e-6)}) {
    if (std::abs(ratio / of_metre - 1) < kNear) return unit;
  }
  return {};
}

std::string NoteOnScale(double rigid_m, const Fit& scaled) {
  const std::string unit = UnitOf(scaled.scale);
  return fmt::format(
      "with its lengths times {:.4g} the estimate lies {:.3g} m from the truth, as read {:.3g} m "
      "(root mean square): {}",
      scaled.scale, scaled.rmse_m, rigid_m,
      unit.empty() ? "its scale is another, as a single camera's is; --align sim3 (align='sim3' in "
                     "Python) leaves it out of the error"
                   : "is one of the files in " + unit + "?");
}

/// Whether the estimate, once aligned by positions, is turned against the truth.
bool IsTurned(const Trajectory& truth, const Trajectory& estimate,
              const std::vector<PosePair>& pairs) {
  const Alignment alignment =
      Align(truth, estimate, pairs, {.method = AlignmentMethod::kSe3, .first_n = 0});
  if (!alignment.rotation_determined) return true;
  const auto errors = AbsoluteErrors(truth, estimate, pairs, alignment);
  return Summarize(Rotations(errors)).rmse > kSuspiciousDeg;
}

std::string NoteOnOrder(const Trajectory& truth, const Trajectory& estimate,
                        const std::vector<PosePair>& pairs) {
  if (!IsTurned(truth, estimate, pairs)) return {};
  for (const auto& [place, word] :
       {std::pair(PlaceOfW::kFirst, "first"), std::pair(PlaceOfW::kLast, "last")}) {
    if (ReadingLikeTruth(truth, estimate, Reread(estimate, place)) != Reading::kSecond) continue;
    return fmt::format(
        "with qw read as the {} of the four numbers the estimate moves as the truth does, as read "
        "it does not: a TUM file has tx ty tz qx qy qz qw, EuRoC's (stamps in nanoseconds) has qw "
        "before qx. Rotational and relative errors mean nothing until it is read so",
        word);
  }
  return {};
}

}  // namespace

std::vector<std::string> NotesOnConventions(const Trajectory& truth, const Trajectory& estimate,
                                            const std::vector<PosePair>& pairs,
                                            AlignmentMethod alignment) {
  constexpr std::size_t kFewest = 4;  // a similarity fits three
  if (pairs.size() < kFewest) return {};
  const double agrees_m = kAgrees * ExtentM(truth, pairs);
  const Fit scaled = FitOf(truth, estimate, pairs, AlignmentMethod::kSim3);
  std::string note;
  if (scaled.rmse_m > agrees_m) {
    note = NoteOnInverse(truth, estimate, pairs, agrees_m, scaled);
    return note.empty() ? std::vector<std::string>() : std::vector{note};
  }
  std::vector<std::string> notes;
  const double rigid_m = FitOf(truth, estimate, pairs, AlignmentMethod::kSe3).rmse_m;
  if (alignment != AlignmentMethod::kSim3 && rigid_m > agrees_m) {
    notes.push_back(NoteOnScale(rigid_m, scaled));
  }
  note = NoteOnOrder(truth, estimate, pairs);
  if (!note.empty()) notes.push_back(note);
  return notes;
}

}  // namespace aisle
