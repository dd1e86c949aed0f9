#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/report/picture/video.h"

namespace aisle {

/// All stages of a frame side by side, `columns` to a row; empty for none. Throws
/// std::invalid_argument where the pictures differ in size.
cv::Mat3b TileStages(const std::vector<StagePicture>& stages, int columns = 3);

/// Frames with the largest values, at most `count`, none closer than `apart` to one that is worse;
/// in rising order. Frames of value 0 are not bad.
std::vector<std::size_t> WorstFrames(const std::map<std::size_t, double>& value_of_frame,
                                     std::size_t count, std::size_t apart);

struct StageSheetOptions {
  std::filesystem::path folder;  ///< of the run; sheets go to its "stages"
  double rate_hz = 20;
  bool film = true;        ///< "stages.mp4" where there is an ffmpeg
  std::size_t worst = 6;   ///< frames that the report shows
  std::size_t apart = 15;  ///< frames between two of these, at least
};

/// Draws how a system found what moves, a sheet for every frame while the run passes. Whatever goes
/// wrong ends the drawing and not the run.
class StageSheets {
 public:
  explicit StageSheets(StageSheetOptions options);

  void See(std::size_t index, const FrameTruth* truth, const FrameEstimate& estimate,
           const FrameFacts& facts);

  /// Ends the film. What there is to show, as a path below the run's folder: "stages_film", and
  /// "stages_000123" for the frames whose mask is most wrong.
  std::map<std::string, std::string> Finish();

  /// Why the drawing ended early; empty if it did not.
  const std::string& trouble() const { return trouble_; }

 private:
  void Draw(std::size_t index, const FrameTruth* truth, const FrameEstimate& estimate);

  const StageSheetOptions options_;
  std::optional<Video> film_;
  std::map<std::size_t, double> wrong_px_;  ///< by frame that has a sheet
  std::string trouble_;
};

/// Name of a frame's sheet, below the run's folder.
std::string StageSheetName(std::size_t index);

}  // namespace aisle
