#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/report/picture/overlay.h"

namespace aisle {

/// Which frames of a run its report can show.
enum class FramesKept {
  kNone,
  kWorst,  ///< two dozen: all over the drive, and around where the system goes wrong
  kAll,    ///< every second one, some 20 MB a minute of driving
};
/// "none", "worst", "all"; the inverse throws InputError naming the three.
std::string Name(FramesKept kept);
FramesKept FramesKeptFromName(const std::string& name);

/// Draws a run's frames while it passes and keeps, when it is over, those that are worth a look:
/// only then is known where it went wrong. Holds them compressed, some 40 KB each, at most two
/// thousand.
class FrameAlbum {
 public:
  explicit FrameAlbum(FramesKept kept = FramesKept::kWorst) : kept_(kept) {}

  /// The picture of the frame, where it was drawn; empty for frames that are passed over.
  cv::Mat3b See(std::size_t index, std::size_t count, const cv::Mat1b& left,
                const FrameTruth* truth, const FrameEstimate& estimate, const FrameFacts& facts);

  /// Writes JPEGs named by frame into `folder`; returns the file names in frame order, those that
  /// lead in something marked by their names ("frame_000123_worst_error.jpg"). `error_m`: by
  /// frame, of the live track; frames without a pose have none.
  std::vector<std::string> Write(const std::filesystem::path& folder,
                                 const std::map<std::size_t, double>& error_m) const;

 private:
  struct Picture {
    std::string jpeg;
    double movers_share = 0;
    double mask_wrong_px = 0;
    double step_error_m = 0;  ///< of the motion since the frame before
  };
  /// Frames that lead in something, by what they lead in.
  std::map<std::string, std::size_t> Leaders(const std::map<std::size_t, double>& error_m) const;

  FramesKept kept_;
  std::map<std::size_t, Picture> pictures_;  ///< by frame
  struct Posed {
    Eigen::Isometry3d T_truth_rig, T_world_rig;
    int map_id = 0;
  };
  std::optional<Posed> previous_;  ///< the frame before, where truth and system have its pose
};

}  // namespace aisle
