#include "harness/cli/render_bag.h"

#include "harness/bag/beside_bag.h"
#include "harness/bag/drive_bag.h"
#include "harness/cli/terminal.h"
#include "harness/common/seconds.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/plugs/wheel_motion.h"
#include "harness/run/frames_ahead.h"

namespace aisle {

void RenderBag(const SimulationForExport& simulation, const std::vector<FrameRequest>& frames,
               const std::string& scene_file, const std::map<std::string, std::string>& provenance,
               bool with_odometry, const std::filesystem::path& folder) {
  if (simulation.lens.model != "none") {
    throw InputError(scene_file, 0,
                     fmt::format("the scene's lens is {}, but a bag holds rectified images: use "
                                 "--format euroc, or set camera.distortion to none",
                                 simulation.lens.model));
  }
  const Sequence& sequence = *simulation.sequence;
  const std::filesystem::path file = folder / "drive.mcap";
  DriveBag bag(file, sequence.calibration(), {.T_base_rig = simulation.T_base_rig});
  FramesAhead ahead(sequence, frames, 3);
  ProgressLine line;
  OdometryReading wheels;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const SequenceFrame frame = ahead.Next().frame;
    if (i > 0 && frame.images.motion) {
      const double seconds = ToSeconds(frames[i].stamp_ns - frames[i - 1].stamp_ns);
      wheels =
          Reckon(wheels, OfRig(*frame.images.motion, simulation.T_base_rig.inverse()), seconds);
    }
    std::optional<std::array<cv::Mat3b, 2>> colour;
    if (simulation.colour) colour = simulation.colour(frames[i]);
    bag.AddFrame(frame, colour ? &*colour : nullptr, with_odometry ? &wheels : nullptr);
    line.Show(fmt::format("frame {} of {}", i + 1, frames.size()));
  }
  line.Clear();
  bag.AddMetadata("aisle", provenance);
  for (const std::string& text : FilesOfScene(scene_file)) {
    if (!IsAttached(text)) continue;
    bag.Attach(std::filesystem::path(text).filename().string(), "application/yaml", ReadFile(text));
  }
  WriteBesideBag(file, bag.Finish(), {});
  fmt::print("{}: {} frames\n", file.string(), frames.size());
}

}  // namespace aisle
