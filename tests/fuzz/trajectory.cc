#include "harness/io/trajectory.h"

#include "harness/io/input_error.h"
#include "harness/io/vslam_lab.h"
#include "tests/fuzz/fuzz.h"

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
      fuzz::Hold(FormatTrajectory(again, format) == text, "a trajectory reads back as written");
    });
  }
  attempt([&] { GuessTrajectoryFormat(file); });
  attempt([&] { ReadVslamLabTrajectory(file); });
  return 0;
}
