#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/contract/run.h"
#include "harness/report/picture/overlay.h"

namespace aisle {

/// Picks the frames of a run worth a picture while it passes: evenly spaced ones, and the one in
/// which movers fill the most, the one whose mask is most wrong and the one whose step is.
class SamplePictures {
 public:
  explicit SamplePictures(std::size_t evenly_spaced = 5) : evenly_spaced_(evenly_spaced) {}

  void See(std::size_t index, std::size_t count, const cv::Mat1b& left, const FrameTruth* truth,
           const FrameEstimate& estimate, const FrameFacts& facts);

  /// Writes JPEGs named by frame into `folder`; returns the file names in frame order, those
  /// that lead in something marked by their names.
  std::vector<std::string> Write(const std::filesystem::path& folder) const;

 private:
  struct Sample {
    std::size_t index = 0;
    cv::Mat3b picture;
  };
  std::size_t evenly_spaced_;
  std::vector<Sample> samples_;
  /// The frame that leads in something, and by how much.
  struct Leader {
    std::optional<Sample> sample;
    double value = 0;
  };
  std::map<std::string, Leader> leaders_;  ///< by what they lead in
  std::optional<std::pair<Eigen::Isometry3d, Eigen::Isometry3d>> previous_;  ///< true, estimated
};

}  // namespace aisle
