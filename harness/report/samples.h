#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/report/overlay.h"

namespace aisle {

/// Picks the frames of a run worth a picture while it passes: evenly spaced ones, and the one in
/// which movers fill the most.
class SamplePictures {
 public:
  explicit SamplePictures(std::size_t evenly_spaced = 5) : evenly_spaced_(evenly_spaced) {}

  void See(std::size_t index, std::size_t count, const cv::Mat1b& left, const FrameTruth* truth,
           const FrameEstimate& estimate, double movers_share);

  /// Writes JPEGs named by frame into `folder`; returns the file names in frame order, the one with
  /// the most movers marked by its name.
  std::vector<std::string> Write(const std::filesystem::path& folder) const;

 private:
  struct Sample {
    std::size_t index = 0;
    cv::Mat3b picture;
  };
  std::size_t evenly_spaced_;
  std::vector<Sample> samples_;
  std::optional<Sample> most_movers_;
  double most_share_ = 0;
};

}  // namespace aisle
