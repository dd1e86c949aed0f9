#include "harness/io/trajectory.h"

#include <algorithm>

#include "harness/io/input_error.h"
#include "harness/io/vslam_lab.h"
#include "tests/fuzz/fuzz.h"

namespace {

/// Stamps and positions to the bit; of a quaternion whose length is rounded anew to its last
/// digits.
bool AreSame(const aisle::Trajectory& a, const aisle::Trajectory& b) {
  constexpr double kRounding = 1e-14;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    const Eigen::Matrix3d turn = one.T_world_rig.linear() - other.T_world_rig.linear();
    return one.stamp_ns == other.stamp_ns &&
           one.T_world_rig.translation() == other.T_world_rig.translation() &&
           turn.cwiseAbs().maxCoeff() < kRounding;
  });
}

}  // namespace

/// A trajectory in every format there is; one that is read is written as TUM's and read again.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  const std::filesystem::path file = fuzz::AsFile(fuzz::Text(data, size), "trajectory.txt");
  const auto attempt = [](const auto& read) {
    try {
      read();
      ++fuzz::taken;
    } catch (const InputError&) {
    }
  };
  for (const auto format :
       {TrajectoryFormat::kTum, TrajectoryFormat::kKitti, TrajectoryFormat::kEuroc}) {
    attempt([&] {
      const Trajectory trajectory = ReadTrajectory(file, format);
      if (format != TrajectoryFormat::kTum) return;
      const std::string text = FormatTrajectory(trajectory, format);
      const Trajectory again = ReadTrajectory(fuzz::AsFile(text, "again.txt"), format);
      fuzz::Hold(AreSame(trajectory, again), "a trajectory reads back as written");
    });
  }
  attempt([&] { GuessTrajectoryFormat(file); });
  attempt([&] { ReadVslamLabTrajectory(file); });
  return 0;
}
